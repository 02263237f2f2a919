#!/usr/bin/env python3
"""Writes ../meshes/fish.obj: a yellowtail of length 1 in the axes of billow's fish (snout at x = 0.5, back to +y, right
side to +z). Every part is a closed surface; left and right are mirror images that share their texture."""
import math
import os

from obj_writer import write_obj

# Outline of the body: distance behind the snout, top, bottom, half width.
PROFILE = [(0.000, 0.000, -0.004, 0.000), (0.008, 0.014, -0.016, 0.011), (0.030, 0.032, -0.030, 0.023),
           (0.070, 0.057, -0.049, 0.038), (0.120, 0.080, -0.068, 0.050), (0.200, 0.105, -0.090, 0.061),
           (0.290, 0.119, -0.104, 0.066), (0.380, 0.120, -0.105, 0.065), (0.480, 0.109, -0.095, 0.058),
           (0.580, 0.088, -0.077, 0.047), (0.680, 0.061, -0.053, 0.033), (0.760, 0.041, -0.037, 0.022),
           (0.820, 0.032, -0.030, 0.014), (0.860, 0.030, -0.029, 0.008), (0.885, 0.022, -0.022, 0.003),
           (0.893, 0.000, 0.000, 0.000)]
RINGS, SPOKES = 54, 28
# Where the parts lie in the texture: u and v of the lower left corner, width, height.
BODY_UV = (0.0, 0.40, 1.0, 0.60)
CAUDAL_UV = (0.01, 0.02, 0.28, 0.34)
DORSAL_UV = (0.31, 0.02, 0.30, 0.15)
ANAL_UV = (0.31, 0.21, 0.30, 0.15)
PAIRED_UV = (0.63, 0.02, 0.17, 0.34)
EYE_UV = (0.83, 0.03, 0.16, 0.24)


def monotone_slopes(xs, ys):
    """Fritsch and Carlson 1980: a cubic through the points that never overshoots them."""
    steps = [(y2 - y1) / (x2 - x1) for x1, x2, y1, y2 in zip(xs, xs[1:], ys, ys[1:])]
    slopes = [steps[0]] + [0.0 if a * b <= 0 else 2 * a * b / (a + b) for a, b in zip(steps, steps[1:])] + [steps[-1]]
    return slopes


def curve(column):
    xs, ys = [row[0] for row in PROFILE], [row[column] for row in PROFILE]
    slopes = monotone_slopes(xs, ys)

    def value(x):
        i = max(k for k in range(len(xs) - 1) if xs[k] <= x or k == 0)
        h = xs[i + 1] - xs[i]
        t = min(max((x - xs[i]) / h, 0.0), 1.0)
        return (ys[i] * (1 + 2 * t) * (1 - t) ** 2 + slopes[i] * h * t * (1 - t) ** 2
                + ys[i + 1] * t * t * (3 - 2 * t) + slopes[i + 1] * h * t * t * (t - 1))
    return value


top, bottom, half_width = curve(1), curve(2), curve(3)


class Mesh:
    def __init__(self):
        self.positions, self.uvs, self.groups = [], [], []
        self._uv_number = {}

    def point(self, behind, y, z):
        self.positions.append((0.5 - behind, y, z))
        return len(self.positions) - 1

    def uv(self, place, u, v):
        key = (place[0] + u * place[2], place[1] + v * place[3])
        if key not in self._uv_number:
            self._uv_number[key] = len(self.uvs)
            self.uvs.append(key)
        return self._uv_number[key]


def body(mesh):
    """Rings of ellipses between the tip of the snout and a point inside the tail fin. v runs from belly to back."""
    faces = []
    first, last = PROFILE[0][0], PROFILE[-1][0]

    def uv(behind, angle):
        return mesh.uv(BODY_UV, 0.02 + 0.96 * behind / last, 0.02 + 0.96 * angle)

    rings = []
    for i in range(1, RINGS):
        t = i / RINGS
        behind = first + (last - first) * (t - 0.55 * math.sin(2 * math.pi * t) / (2 * math.pi))
        high, low, wide = top(behind), bottom(behind), half_width(behind)
        ring = []
        for k in range(SPOKES):  # from the belly up the right side, over the back, down the left
            a = 2 * math.pi * k / SPOKES - math.pi / 2
            share = 1.0 - abs((k / SPOKES) * 2 - 1.0)  # 0 belly, 1 back, on both sides
            y = 0.5 * (high + low) + 0.5 * (high - low) * math.sin(a)
            z = wide * math.copysign(abs(math.cos(a)) ** 0.92, math.cos(a)) if abs(math.cos(a)) > 1e-9 else 0.0
            ring.append((mesh.point(behind, y, z), uv(behind, share)))
        rings.append(ring)
    for front, back in zip(rings, rings[1:]):
        for k in range(SPOKES):
            n = (k + 1) % SPOKES
            faces.append([front[k], front[n], back[n], back[k]])
    nose, end = mesh.point(first, -0.002, 0.0), mesh.point(last, 0.0, 0.0)
    for k in range(SPOKES):
        n = (k + 1) % SPOKES
        middle = 0.5 * (1.0 - abs((k / SPOKES) * 2 - 1.0) + 1.0 - abs((n / SPOKES) * 2 - 1.0) if n else 1 / SPOKES)
        faces.append([(nose, uv(first, middle)), rings[0][n], rings[0][k]])
        faces.append([(end, uv(last, middle)), rings[-1][k], rings[-1][n]])
    mesh.groups.append(("body", faces))


def fin(mesh, name, place, size, shape, normal, thickness, outward, mirrored=False):
    """A lens: shape(u, v) is the fin's middle surface, u from root to rim, v along it; both sides meet on the rim.
    outward: 1 where u x v of the shape points along the normal, else -1."""
    n, m = size
    sign = -1 if mirrored else 1
    sides = {}
    for i in range(n + 1):
        for j in range(m + 1):
            u, v = i / n, j / m
            s, y, z = shape(u, v)
            half = thickness * (1 - u) * math.sqrt(max(4 * v * (1 - v), 0.0)) + thickness * 0.12
            rim = i in (0, n) or j in (0, m)
            for side in (1, -1):
                if rim and side == -1:
                    sides[i, j, -1] = sides[i, j, 1]
                    continue
                offset = 0.0 if rim else side * half
                p = mesh.point(s - normal[0] * offset, y + normal[1] * offset, sign * (z + normal[2] * offset))
                sides[i, j, side] = (p, mesh.uv(place, u, v))
    faces = []
    for i in range(n):
        for j in range(m):
            for side in (1, -1):
                quad = [sides[i, j, side], sides[i + 1, j, side], sides[i + 1, j + 1, side], sides[i, j + 1, side]]
                faces.append(quad if side * sign * outward == 1 else quad[::-1])
    mesh.groups.append((name, faces))


def smooth(x):
    x = min(max(x, 0.0), 1.0)
    return x * x * (3 - 2 * x)


def caudal(u, v):
    """Forked: rays fan out from the root to the trailing edge."""
    span = 2 * v - 1
    far = abs(span)
    root = (0.845, 0.027 * span)
    tip = (0.915 + 0.085 * far ** 1.7, 0.150 * math.copysign(far ** 1.15, span))
    bow = 0.012 * math.sin(math.pi * u) * far * math.copysign(1, span)
    return root[0] + u * (tip[0] - root[0]), root[1] + u * (tip[1] - root[1]) - bow, 0.0


def dorsal(u, v):
    s = 0.27 + 0.43 * v
    height = 0.062 * smooth(v / 0.16) * (1.0 - 0.62 * smooth((v - 0.12) / 0.6)) + 0.012
    sweep = 0.055 * u * (0.4 + 0.6 * v)
    return s + sweep, top(s) - 0.016 + u * (height + 0.016), 0.0


def anal(u, v):
    s = 0.60 + 0.17 * v
    height = 0.050 * smooth(v / 0.2) * (1.0 - 0.66 * smooth((v - 0.15) / 0.7)) + 0.010
    return s + 0.05 * u * (0.5 + 0.5 * v), bottom(s) + 0.014 - u * (height + 0.014), 0.0


def leaf(v):
    return 0.36 + 0.64 * math.sin(math.pi * min(max(v, 0.0), 1.0) ** 0.8) ** 0.8


def pectoral(u, v):
    """A leaf that leans back along the flank, a little away from it."""
    reach = u * (0.115 * leaf(v))
    across = (v - 0.5) * (0.026 + 0.030 * u)
    s = 0.238 + 0.93 * reach + 0.20 * across
    y = -0.034 - 0.30 * reach + across
    return s, y, half_width(0.238) * 0.90 + 0.42 * reach


def pelvic(u, v):
    reach = u * (0.075 * leaf(v))
    across = (v - 0.5) * (0.030 + 0.012 * u)
    s = 0.36 + 0.80 * reach + across
    return s, bottom(0.36) * 0.93 - 0.48 * reach, 0.026 + 0.30 * reach


def eye(mesh, mirrored):
    """A flat ball that stands out of the head; seen from the side it shows the whole of its square of the texture."""
    s0, y0, radius, bulge = 0.088, 0.022, 0.0185, 0.010
    height = 0.5 * (top(s0) - bottom(s0))
    z0 = half_width(s0) * math.sqrt(1 - ((y0 - 0.5 * (top(s0) + bottom(s0))) / height) ** 2) - 0.0035
    sign = -1 if mirrored else 1
    rows, around = 6, 16

    def uv(x, y):
        return mesh.uv(EYE_UV, 0.5 + 0.5 * x, 0.5 + 0.5 * y)

    rings = []
    for i in range(1, 2 * rows):
        polar = math.pi * i / (2 * rows)
        ring = []
        for k in range(around):
            a = 2 * math.pi * k / around
            x, y = math.sin(polar) * math.cos(a), math.sin(polar) * math.sin(a)
            ring.append((mesh.point(s0 + radius * x, y0 + radius * y, sign * (z0 + bulge * math.cos(polar))), uv(x, y)))
        rings.append(ring)
    out, inner = [(mesh.point(s0, y0, sign * (z0 + d)), uv(0, 0)) for d in (bulge, -bulge)]
    faces = []
    for k in range(around):
        n = (k + 1) % around
        faces.append([out, rings[0][n], rings[0][k]])
        faces.append([inner, rings[-1][k], rings[-1][n]])
        for a, b in zip(rings, rings[1:]):
            faces.append([a[k], a[n], b[n], b[k]])
    mesh.groups.append(("eyes", [f if not mirrored else f[::-1] for f in faces]))


def main():
    mesh = Mesh()
    body(mesh)
    fin(mesh, "caudal_fin", CAUDAL_UV, (9, 18), caudal, (0, 0, 1), 0.007, -1)
    fin(mesh, "dorsal_fin", DORSAL_UV, (5, 22), dorsal, (0, 0, 1), 0.006, 1)
    fin(mesh, "anal_fin", ANAL_UV, (5, 10), anal, (0, 0, 1), 0.005, -1)
    for mirrored in (False, True):
        fin(mesh, "pectoral_fins", PAIRED_UV, (7, 8), pectoral, (0.41, 0.0, 0.91), 0.004, -1, mirrored)
        fin(mesh, "pelvic_fins", PAIRED_UV, (5, 6), pelvic, (0.0, 0.53, 0.85), 0.004, -1, mirrored)
        eye(mesh, mirrored)
    here = os.path.dirname(os.path.abspath(__file__))
    write_obj(os.path.join(here, "..", "meshes", "fish.obj"),
              "fish: a yellowtail of length 1, looking along +x, back to +y; made by make_fish.py",
              mesh.positions, mesh.uvs, mesh.groups)


if __name__ == "__main__":
    main()
