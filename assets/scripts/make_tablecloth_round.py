#!/usr/bin/env python3
"""assets/meshes/tablecloth_round.obj: a round tablecloth with scallops, 1.2 m across, and a hole for a parasol.

It lies flat at y = 0 around the origin, facing +y. Rings of quads; where the circumference has doubled, a ring of
triangles doubles the number of points. The texture is laid around the hole: u goes around REPEATS times, v from the hole
(0) to the rim (1). So there is a true seam, where u = 0 meets u = REPEATS: the file has every uv of the seam twice and
every position once. Groups: hole_rim, the faces around the hole, and hem, the faces along the scallops.
"""
import math
import pathlib

from obj_writer import write_obj

HOLE, RIM = 0.05, 0.6  # radii [m], the rim's without scallops
SCALLOPS, SCALLOP_DEPTH = 16, 0.02
REPEATS = 8  # of the texture, around
POINTS_AT_HOLE = 24
FINEST = 0.019  # metres between rings; as many points again where those of a ring are twice as far apart


def ring_sizes():
    """[(radius, points)] from the hole outwards; points only ever double."""
    rings, radius, points = [], HOLE, POINTS_AT_HOLE
    while radius < RIM - 0.5 * FINEST:
        rings.append((radius, points))
        if 2.0 * math.pi * radius / points > 1.55 * FINEST:
            points *= 2
        radius += 2.0 * math.pi * radius / points
    stretch = (RIM - HOLE) / (radius - HOLE)
    return [(HOLE + (r - HOLE) * stretch, n) for r, n in rings] + [(RIM, points)]


def scalloped(radius, angle):
    """The rim's scallops fade out towards the middle of the cloth."""
    depth = SCALLOP_DEPTH * max(0.0, (radius - 0.45) / (RIM - 0.45)) ** 2
    return radius - depth * (1.0 - abs(math.sin(0.5 * SCALLOPS * angle)))


class Ring:
    """A circle of points, its uvs one more than its points: the last repeats the first point at u = REPEATS."""

    def __init__(self, radius, points, positions, uvs):
        self.points, self.first, self.first_uv = points, len(positions), len(uvs)
        v = (radius - HOLE) / (RIM - HOLE)
        for k in range(points + 1):
            angle = 2.0 * math.pi * k / points
            if k < points:
                r = scalloped(radius, angle)
                positions.append((r * math.cos(angle), 0.0, -r * math.sin(angle)))
            uvs.append((REPEATS * k / points, v))

    def corner(self, k):
        """Position and uv of the k-th point, k = points being the first one again on the seam's other side."""
        return self.first + k % self.points, self.first_uv + k


def faces_between(inner, outer):
    if inner.points == outer.points:
        return [[inner.corner(k), outer.corner(k), outer.corner(k + 1), inner.corner(k + 1)]
                for k in range(inner.points)]
    faces = []
    for k in range(inner.points):
        a, b = inner.corner(k), inner.corner(k + 1)
        left, middle, right = (outer.corner(2 * k + j) for j in range(3))
        faces += [[a, left, middle], [a, middle, b], [b, middle, right]]
    return faces


def main():
    positions, uvs = [], []
    rings = [Ring(radius, points, positions, uvs) for radius, points in ring_sizes()]
    strips = [faces_between(inner, outer) for inner, outer in zip(rings, rings[1:])]
    groups = [("hole_rim", strips[0]), ("linen", [f for strip in strips[1:-1] for f in strip]), ("hem", strips[-1])]
    path = pathlib.Path(__file__).parent.parent / "meshes" / "tablecloth_round.obj"
    write_obj(path, "billow: round tablecloth with a hole, made by make_tablecloth_round.py", positions, uvs, groups)
    print(f"{len(positions)} points, {len(uvs)} uvs, rings of {[ring.points for ring in rings]}")


if __name__ == "__main__":
    main()
