#!/usr/bin/env python3
"""assets/meshes/cloth_50.obj: the paper's cloth, a regular grid of 50 x 50 particles, 1 m x 1 m.

It lies flat at y = 0, ready to fall: the edge to be pinned at z = 0 (v = 1), the free edge at z = 1 towards the camera,
centred in x. Vertices run along rows, the pinned row first, so vertices 0 and 49 are its corners.
"""
import pathlib

from obj_writer import write_obj

SIDE = 50  # particles


def main():
    positions, uvs = [], []
    for row in range(SIDE):
        for column in range(SIDE):
            u, down = column / (SIDE - 1), row / (SIDE - 1)
            positions.append((u - 0.5, 0.0, down))
            uvs.append((u, 1.0 - down))

    faces = []
    for row in range(SIDE - 1):
        for column in range(SIDE - 1):
            k = row * SIDE + column
            faces.append([(corner, corner) for corner in (k, k + SIDE, k + SIDE + 1, k + 1)])  # facing +y

    path = pathlib.Path(__file__).parent.parent / "meshes" / "cloth_50.obj"
    write_obj(path, "billow: regular cloth, 50 x 50 particles, 1 m x 1 m, made by make_cloth_50.py", positions, uvs,
              [(None, faces)])


if __name__ == "__main__":
    main()
