#!/usr/bin/env python3
"""assets/textures/lace.png: bobbin lace, white thread on nothing: a net, roses in it, scallops all around.

The holes are holes in the alpha; what colour they have is the thread's.
"""
import math
import pathlib

from png_writer import write_rgba_png

SIZE = 1024
MESH = 16.0  # pixels between the net's threads
EDGE = 64.0  # pixels, the height of a scallop
FIELD = EDGE + 8.0  # pixels from the edge to the net
ROSE = (SIZE - 2.0 * FIELD) / 4.0  # pixels between roses
SCALLOPS = 16  # along a side
THREAD = (246, 242, 232)


def thread(distance, width):
    """How much of a pixel a thread of this width covers, its middle `distance` away."""
    return min(1.0, max(0.0, 0.5 * width + 0.5 - abs(distance)))


def to_nearest(x, spacing):
    return x - spacing * round(x / spacing)


def net(x, y):
    """Two slanting families of threads."""
    a, b = to_nearest(x + 0.6 * y, MESH), to_nearest(x - 0.6 * y, MESH)
    return max(thread(0.857 * a, 2.6), thread(0.857 * b, 2.6))


def rose(x, y):
    """Eight woven petals in a ring of loops, at the middle of its square; and whether the net gives way to them."""
    px, py = to_nearest(x - FIELD - 0.5 * ROSE, ROSE), to_nearest(y - FIELD - 0.5 * ROSE, ROSE)
    r, angle = math.hypot(px, py), math.atan2(py, px)
    lobe = abs(math.cos(4.0 * angle))
    cover = thread(r - 14.0, 5.0)
    petal = 22.0 + 42.0 * lobe ** 0.5
    if 20.0 < r < petal:
        vein = abs(to_nearest(r, 7.0))
        cover = max(cover, 1.0 if vein < 2.3 and lobe > 0.25 else thread(r - petal, 6.0))
    cover = max(cover, thread(r - petal, 5.0) if r > 18.0 else 0.0)
    ring = thread(r - 84.0, 5.0)
    loop = thread(math.hypot(r - 76.0, 84.0 * math.sin(8.0 * to_nearest(angle, math.pi / 8.0)) / 8.0) - 7.0, 3.0)
    return max(cover, ring, loop), r < 84.0


def border(x, y):
    """Cover near the edge; None well inside."""
    inside = min(x, y, SIZE - x, SIZE - y)
    if inside > FIELD:
        return None
    along = y if min(x, SIZE - x) < min(y, SIZE - y) else x
    period = SIZE / SCALLOPS
    t = to_nearest(along - 0.5 * period, period) / (0.5 * period)
    rim = EDGE * (1.0 - math.sqrt(max(0.0, 1.0 - t * t))) * 0.75 + 5.0
    if inside < rim - 3.0:
        return 0.0
    cover = max(thread(inside - rim, 7.0), thread(inside - EDGE, 9.0), thread(inside - EDGE - 6.0, 3.0))
    fan = thread(to_nearest(math.atan2(t * 0.5 * period, EDGE - inside + 1e-9), math.pi / 12.0) * max(EDGE - inside, 4.0), 3.0)
    return max(cover, fan if inside < EDGE else 0.0)


def pixel(x, y):
    edge = border(x, y)
    if edge is not None and min(x, y, SIZE - x, SIZE - y) < EDGE:
        return edge
    cover, filled = rose(x, y)
    return max(cover, 0.0 if filled else net(x, y), edge or 0.0)


def main():
    rows = []
    for j in range(SIZE):
        row = bytearray()
        for i in range(SIZE):
            cover = pixel(i + 0.5, j + 0.5)
            twist = 1.0 - 0.10 * (math.sin(0.9 * i + 1.7 * j) ** 2)
            row += bytes(round(c * twist) for c in THREAD) + bytes([round(255 * cover)])
        rows.append(bytes(row))
    write_rgba_png(pathlib.Path(__file__).parent.parent / "textures" / "lace.png", rows)


if __name__ == "__main__":
    main()
