#!/usr/bin/env python3
"""assets/meshes/cloth_{20,32,50,71,100}.obj: the paper's cloth, regular grids of that many particles a side, 1 m x 1 m.

They lie flat at y = 0, ready to fall: the edge to be pinned at z = 0 (v = 1), the free edge at z = 1 towards the camera,
centred in x. Vertices run along rows, the pinned row first, so vertices 0 and SIDE - 1 are its corners.
"""
import pathlib

from obj_writer import write_obj

SIDES = (20, 32, 50, 71, 100)  # particles; from one to the next, about twice as many in all


def write_grid(side):
    positions, uvs = [], []
    for row in range(side):
        for column in range(side):
            u, down = column / (side - 1), row / (side - 1)
            positions.append((u - 0.5, 0.0, down))
            uvs.append((u, 1.0 - down))

    faces = []
    for row in range(side - 1):
        for column in range(side - 1):
            k = row * side + column
            faces.append([(corner, corner) for corner in (k, k + side, k + side + 1, k + 1)])  # facing +y

    path = pathlib.Path(__file__).parent.parent / "meshes" / f"cloth_{side}.obj"
    comment = f"billow: regular cloth, {side} x {side} particles, 1 m x 1 m, made by make_cloth_grids.py"
    write_obj(path, comment, positions, uvs, [(None, faces)])


if __name__ == "__main__":
    for side in SIDES:
        write_grid(side)
