#!/usr/bin/env python3
"""assets/meshes/funnel.obj: a funnel 1.2 m wide, open above and below, for cloths to fall through.

Its axis is +y; the spout begins at y = 0, ends at y = -0.3 and is 0.32 m wide. It is a sheet, facing outwards, of rings of
points about EDGE apart, with triangles between them. The texture goes once around it, v from the spout's end to the rim.
"""
import math
import pathlib

from obj_writer import write_obj

RIM, SPOUT = 0.6, 0.16  # radii [m]
HEIGHT, LENGTH = 0.55, 0.3  # metres: of the cone, and of the spout
BEND = 0.12  # metres over which the spout turns into the cone
EDGE = 0.025  # metres


def profile():
    """[(radius, y)] from the spout's end to the rim, EDGE apart: a line, a circle's arc, a line."""
    slope = math.atan2(RIM - SPOUT, HEIGHT)  # the cone's, from upright
    arc_radius = BEND / slope
    lead = arc_radius * math.tan(0.5 * slope)  # that the arc takes from both lines
    cone = math.hypot(RIM - SPOUT, HEIGHT) - lead
    total = (LENGTH - lead) + BEND + cone
    points = []
    steps = round(total / EDGE)
    for k in range(steps + 1):
        s = total * k / steps
        if s < LENGTH - lead:
            points.append((SPOUT, s - LENGTH))
        elif s < LENGTH - lead + BEND:
            turn = (s - (LENGTH - lead)) / arc_radius
            points.append((SPOUT + arc_radius * (1.0 - math.cos(turn)), -lead + arc_radius * math.sin(turn)))
        else:
            rest = total - s
            points.append((RIM - rest * math.sin(slope), HEIGHT - rest * math.cos(slope)))
    return points


class Ring:
    """Points around the axis and their uvs, one more than its points: the last repeats the first at u = 1."""

    def __init__(self, radius, y, v, positions, uvs):
        self.points = round(2.0 * math.pi * radius / EDGE)
        self.first, self.first_uv = len(positions), len(uvs)
        for k in range(self.points + 1):
            angle = 2.0 * math.pi * (k / self.points - 0.5)
            if k < self.points:
                positions.append((radius * math.sin(angle), y, radius * math.cos(angle)))
            uvs.append((k / self.points, v))

    def corner(self, k):
        return self.first + k % self.points, self.first_uv + k


def faces_between(lower, upper):
    """Triangles, by going around on both rings at once, on to the nearer of the two next points."""
    faces, i, j = [], 0, 0
    while i < lower.points or j < upper.points:
        if (i + 1) * upper.points <= (j + 1) * lower.points:
            faces.append([lower.corner(i), lower.corner(i + 1), upper.corner(j)])
            i += 1
        else:
            faces.append([lower.corner(i), upper.corner(j + 1), upper.corner(j)])
            j += 1
    return faces


def main():
    positions, uvs = [], []
    outline = profile()
    rings = [Ring(radius, y, k / (len(outline) - 1), positions, uvs) for k, (radius, y) in enumerate(outline)]
    faces = [face for lower, upper in zip(rings, rings[1:]) for face in faces_between(lower, upper)]
    path = pathlib.Path(__file__).parent.parent / "meshes" / "funnel.obj"
    write_obj(path, "billow: open funnel, made by make_funnel.py", positions, uvs, [(None, faces)])
    print(f"{len(positions)} points, {len(faces)} triangles, rings of {[ring.points for ring in rings]}")


if __name__ == "__main__":
    main()
