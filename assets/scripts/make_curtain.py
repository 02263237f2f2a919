#!/usr/bin/env python3
"""assets/meshes/curtain.obj: half of a curtain, closed: 1 m of rail, 1.6 m high, hanging in eight pleats.

The upper edge runs along x from 0 to 1 at y = 0, the lower one is at y = -1.6; the front faces +z. A pleat is one wave of a
sine in z, its points evenly apart along the cloth, of which there is half as much again as of the rail. Vertices run along
rows, the upper edge first, POINTS to a pleat: the hooks of the rail are vertices 0, POINTS, 2 POINTS and so on, where the
waves cross the rail going forwards.
"""
import math
import pathlib

from obj_writer import write_obj

WIDTH, HEIGHT = 1.0, 1.6  # metres, closed
PLEATS, POINTS = 8, 10  # of the width, particles of each
FULLNESS = 1.5  # cloth over rail
ROWS = 65


def arc(amplitude, pieces=4000):
    """[(length, x)] along one wave of z = amplitude sin(2 pi x), x from 0 to 1."""
    way, before = [(0.0, 0.0)], (0.0, 0.0)
    for k in range(1, pieces + 1):
        x = k / pieces
        now = (x, amplitude * math.sin(2.0 * math.pi * x))
        way.append((way[-1][0] + math.dist(before, now), x))
        before = now
    return way


def amplitude_of(fullness):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if arc(middle)[-1][0] < fullness else (low, middle)
    return 0.5 * (low + high)


def wave():
    """[(x, z)] of the POINTS points of one pleat, in pleats."""
    amplitude = amplitude_of(FULLNESS)
    way, points, k = arc(amplitude), [], 0
    for p in range(POINTS):
        wanted = way[-1][0] * p / POINTS
        while way[k + 1][0] < wanted:
            k += 1
        (l0, x0), (l1, x1) = way[k], way[k + 1]
        x = x0 + (x1 - x0) * (wanted - l0) / (l1 - l0)
        points.append((x, amplitude * math.sin(2.0 * math.pi * x)))
    return points


def write_curtain():
    pleat, columns, size = wave(), PLEATS * POINTS + 1, WIDTH / PLEATS
    positions, uvs = [], []
    for row in range(ROWS):
        for column in range(columns):
            x, z = pleat[column % POINTS]
            positions.append(((column // POINTS + x) * size, -HEIGHT * row / (ROWS - 1), z * size))
            uvs.append((column / (columns - 1), 1.0 - row / (ROWS - 1)))

    faces = []
    for row in range(ROWS - 1):
        for column in range(columns - 1):
            k = row * columns + column
            faces.append([(corner, corner) for corner in (k, k + columns, k + columns + 1, k + 1)])  # facing +z

    path = pathlib.Path(__file__).parent.parent / "meshes" / "curtain.obj"
    comment = f"billow: half a curtain, {columns} x {ROWS} particles, {PLEATS} pleats, made by make_curtain.py"
    write_obj(path, comment, positions, uvs, [(None, faces)])


if __name__ == "__main__":
    write_curtain()
