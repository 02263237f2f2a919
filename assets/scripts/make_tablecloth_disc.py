#!/usr/bin/env python3
"""assets/meshes/tablecloth_disc.obj: a round cloth without a hole, 1.2 m across, of even triangles.

It lies flat at y = 0 around the origin, facing +y. The k-th ring around the middle has 6 k points, so that rings are as
far apart as the points on them, within 5 %. The texture lies flat on it, the whole picture around the whole disc.
Group: hem, the faces along the rim.
"""
import math
import pathlib

from obj_writer import write_obj

RADIUS = 0.6  # metres
RINGS = 40


def number_of(ring, k):
    """Of the k-th point of a ring, counted from the middle of the disc."""
    return 0 if ring == 0 else 1 + 3 * ring * (ring - 1) + k % (6 * ring)


def faces_outside(ring):
    """Triangles between a ring and the next: in each of six sectors, the rows of a triangular lattice."""
    faces = []
    for sector in range(6):
        inner, outer = ring * sector, (ring + 1) * sector
        for k in range(ring + 1):
            faces.append((number_of(ring, inner + k), number_of(ring + 1, outer + k), number_of(ring + 1, outer + k + 1)))
            if k < ring:
                faces.append((number_of(ring, inner + k), number_of(ring + 1, outer + k + 1), number_of(ring, inner + k + 1)))
    return [[(p, p) for p in face] for face in faces]


def main():
    flat = [(0.0, 0.0)]  # (x, -z): as seen from above
    for ring in range(1, RINGS + 1):
        for k in range(6 * ring):
            angle = 2.0 * math.pi * k / (6 * ring)
            flat.append((RADIUS * ring / RINGS * math.cos(angle), RADIUS * ring / RINGS * math.sin(angle)))
    strips = [faces_outside(ring) for ring in range(RINGS)]
    groups = [("linen", [face for strip in strips[:-1] for face in strip]), ("hem", strips[-1])]
    path = pathlib.Path(__file__).parent.parent / "meshes" / "tablecloth_disc.obj"
    write_obj(path, "billow: round cloth of even triangles, made by make_tablecloth_disc.py",
              [(x, 0.0, -y) for x, y in flat],
              [(0.5 + 0.5 * x / RADIUS, 0.5 + 0.5 * y / RADIUS) for x, y in flat], groups)
    print(f"{len(flat)} points, {sum(map(len, strips))} triangles")


if __name__ == "__main__":
    main()
