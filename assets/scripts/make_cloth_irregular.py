#!/usr/bin/env python3
"""assets/meshes/cloth_irregular.obj: a 1 m x 1 m cloth of triangles, three times finer at the pinned corners than afar.

The size and pose of cloth_50.obj. Points are thrown with a distance that varies over the cloth, then moved to the
centres of their surroundings (Lloyd) until the triangles are good.
"""
import math
import pathlib
import random

from delaunay import triangulate
from obj_writer import write_obj

FINE, COARSE = 0.0105, 0.0315  # metres between points at the pinned corners, and far from them
REACH = 1.0  # metres over which the distance grows
ROUNDS = 30
BANDS = 25


def spacing(point):
    """Wanted distance [m] between points around (x, down), both in [0, 1]; the pinned corners are (0, 0) and (1, 0)."""
    x, down = point
    t = min(1.0, min(math.hypot(x, down), math.hypot(1.0 - x, down)) / REACH)
    return FINE + (COARSE - FINE) * t


def along_edge(start, end):
    """Points from start to before end, in steps of the wanted distance, stretched a little so that they come out even."""
    length = math.dist(start, end)
    at = lambda s: (start[0] + (end[0] - start[0]) * s / length, start[1] + (end[1] - start[1]) * s / length)
    marks = [0.0]
    while marks[-1] < length:
        marks.append(marks[-1] + spacing(at(marks[-1])))
    return [at(s * length / marks[-1]) for s in marks[:-1]]


def thrown(border, rng):
    """Points inside, none nearer to another than about 0.75 of the wanted distance there (Poisson discs, by darts)."""
    size = 0.75 * FINE / math.sqrt(2.0)
    cells, inside, misses = {}, [], 0

    def remember(p):
        cells.setdefault((int(p[0] / size), int(p[1] / size)), []).append(p)

    def is_free(p):
        radius = 0.75 * spacing(p)
        reach = int(radius / size) + 1
        i, j = int(p[0] / size), int(p[1] / size)
        return all(math.dist(p, q) >= radius for a in range(i - reach, i + reach + 1)
                   for b in range(j - reach, j + reach + 1) for q in cells.get((a, b), ()))

    for p in border:
        remember(p)
    while misses < 3000:
        p = (rng.random(), rng.random())
        if is_free(p):
            remember(p)
            inside.append(p)
            misses = 0
        else:
            misses += 1
    return inside


def relaxed(points, fixed):
    """Every point from `fixed` on moved to the centre of its triangles, weighted so that the wanted density holds."""
    weight = [0.0] * len(points)
    sum_x, sum_y = [0.0] * len(points), [0.0] * len(points)
    for triangle in triangulate(points):
        (ax, ay), (bx, by), (cx, cy) = (points[k] for k in triangle)
        x, y = (ax + bx + cx) / 3.0, (ay + by + cy) / 3.0
        w = ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / spacing((x, y)) ** 4
        for k in triangle:
            weight[k] += w
            sum_x[k] += w * x
            sum_y[k] += w * y
    return points[:fixed] + [(sum_x[k] / weight[k], sum_y[k] / weight[k]) for k in range(fixed, len(points))]


def smallest_angle(points, triangles):
    """In degrees, over all corners of all triangles."""
    smallest = 180.0
    for t in triangles:
        for k in range(3):
            p, q, r = (points[t[(k + j) % 3]] for j in range(3))
            turn = math.atan2(q[1] - p[1], q[0] - p[0]) - math.atan2(r[1] - p[1], r[0] - p[0])
            smallest = min(smallest, abs(math.degrees(math.remainder(turn, 2.0 * math.pi))))
    return smallest


def main():
    corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    border = [p for k in range(4) for p in along_edge(corners[k], corners[(k + 1) % 4])]
    points = border + thrown(border, random.Random(2007))
    for _ in range(ROUNDS):
        points = relaxed(points, len(border))
    points = sorted(((round(x, 6), round(y, 6)) for x, y in points),
                    key=lambda p: (int(p[1] * BANDS), p[0], p[1]))  # neighbours in space are near in memory
    triangles = triangulate(points)
    print(f"{len(points)} points, {len(triangles)} triangles, smallest angle {smallest_angle(points, triangles):.1f}")

    # (x, down) -> (x, 0, z): seen from +y this turns counter-clockwise into clockwise.
    faces = [[(k, k) for k in (a, c, b)] for a, b, c in triangles]
    path = pathlib.Path(__file__).parent.parent / "meshes" / "cloth_irregular.obj"
    write_obj(path, "billow: irregular cloth, 1 m x 1 m, made by make_cloth_irregular.py",
              [(x - 0.5, 0.0, down) for x, down in points], [(x, 1.0 - down) for x, down in points], [(None, faces)])


if __name__ == "__main__":
    main()
