#!/usr/bin/env python3
"""assets/meshes/flag.obj: a flag of 1.5 m x 1 m, a regular grid of 61 x 41 particles.

It stands in the plane z = 0 and faces +z: the hoist, the edge at the pole, along x = 0 from y = 0 to y = 1, the fly at
x = 1.5. Vertices run along rows, the top row first, so vertex 0 is the hoist's upper end.
"""
import pathlib

from obj_writer import write_obj

LENGTH, HEIGHT = 1.5, 1.0  # metres
COLUMNS, ROWS = 61, 41


def main():
    positions, uvs = [], []
    for row in range(ROWS):
        for column in range(COLUMNS):
            u, down = column / (COLUMNS - 1), row / (ROWS - 1)
            positions.append((LENGTH * u, HEIGHT * (1.0 - down), 0.0))
            uvs.append((u, 1.0 - down))
    faces = []
    for row in range(ROWS - 1):
        for column in range(COLUMNS - 1):
            k = row * COLUMNS + column
            faces.append([(corner, corner) for corner in (k, k + COLUMNS, k + COLUMNS + 1, k + 1)])  # facing +z
    path = pathlib.Path(__file__).parent.parent / "meshes" / "flag.obj"
    write_obj(path, f"billow: flag, {COLUMNS} x {ROWS} particles, 1.5 m x 1 m, made by make_flag.py", positions, uvs,
              [(None, faces)])


if __name__ == "__main__":
    main()
