#!/usr/bin/env python3
"""assets/textures/linen_rings.png: a round linen cloth, its rings of waves and its compass rose in cross stitch.

The whole picture lies flat on a disc that touches its four edges.
"""
import math
import pathlib

from png_writer import write_indexed_png
from weave import LEVELS, nearest_level, noise, palette, weave

YARNS = {"flax": "#efe5d0", "light flax": "#f5eddc", "navy": "#1d3d66", "blue": "#3f7fae", "mist": "#9cc3c9",
         "coral": "#e2603f", "gold": "#dba63f"}
THREADS = 384
STITCH = 6  # pixels, two threads
STITCHES = THREADS * 3 // STITCH  # across and down
WAVES, BEADS = 24, 48


def wave_ring(r, angle):
    """Breaking waves between two rings: a crest leans to one side, lighter bands lie in it."""
    turn = WAVES * angle / (2.0 * math.pi)
    t = turn - math.floor(turn)
    crest = 68.0 + 9.0 * (t / 0.72 if t < 0.72 else (1.0 - t) / 0.28) ** 1.6
    if not 62.0 < r < crest:
        return None
    return "navy" if r > crest - 2.0 or r < 64.0 else "blue" if r > crest - 5.0 or r < 67.0 else "mist"


def bead_ring(r, angle):
    """Diamonds, every fourth of them gold."""
    turn = BEADS * angle / (2.0 * math.pi)
    k = math.floor(turn)
    across = (turn - k - 0.5) * 2.0 * math.pi * 53.0 / BEADS
    if abs(across) + abs(r - 53.0) > 2.3:
        return None
    return "gold" if k % 4 == 0 else "coral"


def rose(r, angle):
    """Eight points, each half light and half dark; the four main ones longer."""
    for points, length, width, colours in ((4, 34.0, 8.0, ("navy", "blue")), (8, 23.0, 6.0, ("coral", "gold"))):
        sector = 2.0 * math.pi / points
        offset = angle - sector * round(angle / sector)
        along, aside = r * math.cos(offset), r * math.sin(offset)
        if along > 0.0 and abs(aside) < width * min(1.0 - along / length, along / 7.0):
            return colours[0] if aside > 0.0 else colours[1]
    return None


def stitch_at(x, y):
    """The yarn of the stitch at (x, y), counted from the middle; None is bare linen."""
    r, angle = math.hypot(x, y), math.atan2(y, x)
    for inner, outer, yarn in ((92.0, 97.0, "navy"), (88.5, 90.0, "coral"), (82.0, 83.5, "blue"), (58.5, 60.0, "navy"),
                               (46.0, 47.5, "navy"), (42.5, 43.5, "blue"), (37.0, 38.2, "coral")):
        if inner <= r < outer:
            return yarn
    return wave_ring(r, angle) or bead_ring(r, angle) or rose(r, angle)


def stitch_shade(fx, fy):
    """Light on a cross stitch at pixel (fx, fy) of its cell; None where the linen shows between its arms."""
    half = (STITCH - 1) / 2.0
    rising, falling = (fx - half + fy - half) / 1.4142136, (fx - fy) / 1.4142136  # distances from the two arms
    if abs(rising) < 1.5:
        return 1.06 - 0.18 * rising * rising
    if abs(falling) < 1.5:
        return 0.86 - 0.18 * falling * falling
    return None


def main():
    rows = [bytearray(row) for row in weave(THREADS, warp=lambda column, row: 0, weft=lambda column, row: 1,
                                            warp_on_top=lambda column, row: (column + row) % 2 == 0, irregularity=1.5)]
    names = list(YARNS)
    middle = 0.5 * (STITCHES - 1)
    for j in range(STITCHES):
        for i in range(STITCHES):
            yarn = stitch_at(i - middle, middle - j)
            if yarn is None:
                continue
            tint = 1.0 + 0.12 * (noise(i, j, 7) - 0.5)
            for fy in range(STITCH):
                for fx in range(STITCH):
                    shade = stitch_shade(fx, fy)
                    if shade is not None:
                        rows[j * STITCH + fy][i * STITCH + fx] = names.index(yarn) * LEVELS + nearest_level(shade * tint)
    path = pathlib.Path(__file__).parent.parent / "textures" / "linen_rings.png"
    write_indexed_png(path, [bytes(row) for row in rows], palette(YARNS.values()))


if __name__ == "__main__":
    main()
