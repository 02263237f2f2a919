#!/usr/bin/env python3
"""assets/textures/linen_sea.png: linen with fish and waves in cross stitch, the border of a tablecloth along the top.

It tiles from left to right; the top is the hem (v = 1), the bottom the edge of a hole or the middle of a cloth (v = 0).
"""
import pathlib

from png_writer import write_indexed_png
from weave import LEVELS, nearest_level, noise, palette, weave

YARNS = {"flax": "#efe5d0", "light flax": "#f5eddc", "navy": "#1d3d66", "blue": "#3f7fae", "mist": "#9cc3c9",
         "coral": "#e2603f", "gold": "#dba63f"}
THREADS = 384
STITCH = 12  # pixels, four threads
STITCHES = 96  # across and down

INK = {"n": "navy", "b": "blue", "m": "mist", "c": "coral", "g": "gold"}

WAVES = """
......nnnn......
....nnnnnnnn....
...nnnbbbbnnn...
..nnnb.....nn...
..nnb...nn..nn..
.nnnb...nnnnnn..
.nnbb....nnnn...
nnnbb..........n
nnnbbb........nn
nnnnbbbb...bbnnn
nnnnnnbbbbbbnnnn
nnnnnnnnnnnnnnnn
"""

FISH = """
................................
............ccccc...............
............cccccc..........c...
.......ccccccccccccc......ccc...
.....cccccgcccgcccccc....cccc...
...cccccccgcccgcccgcccc.cccc....
..ccnccccccgcccgcccgccccccc.....
.cccccccccccgcccgcccgcccccc.....
..ccccccccccgcccgcccgcccccc.....
...ccccccccgcccgcccgccc.cccc....
.....cccccgcccgcccccc....cccc...
.......ccccccccccccc......ccc...
...........cccc.............c...
............cc..................
................................
"""

BUBBLES = """
................
.......bb.......
......b..b......
......b..b....b.
..b....bb.......
................
"""

SPRAY = """
................
.......m........
......mbm.......
.......m........
................
"""

# From the top: (motif or yarn letter, rows of stitches). '.' is bare linen.
BORDER = ["n", "n", ".", "c", ".", WAVES, ".", FISH, BUBBLES, "b", ".", "b", "."]
HOLE = [".", "b", ".", "b", ".", "c", "c", ".", "n", "n"]


def stitched():
    """The letters of all stitches, line by line."""
    def lines(parts):
        return [line for part in parts for line in (part.split() if len(part) > 1 else [part])]

    top, bottom = lines(BORDER), lines(HOLE)
    field = STITCHES - len(top) - len(bottom)
    middle = []
    while len(middle) < field:
        shift = 8 * (len(middle) // 12 % 2)
        middle += [line[shift:] + line[:shift] for line in SPRAY.split()] + ["."] * 7
    return [line * (STITCHES // len(line)) for line in top + middle[:field] + bottom]


def stitch_shade(fx, fy):
    """Light on a cross stitch at pixel (fx, fy) of its cell; None where the linen shows between its arms."""
    half = (STITCH - 1) / 2.0
    rising, falling = (fx - half + fy - half) / 1.4142136, (fx - fy) / 1.4142136  # distances from the two arms
    if abs(rising) < 2.9:
        return 1.06 - 0.05 * rising * rising
    if abs(falling) < 2.9:
        return 0.86 - 0.05 * falling * falling
    return None


def embroider(rows, letters):
    names = list(YARNS)
    cell = [[stitch_shade(fx, fy) for fx in range(STITCH)] for fy in range(STITCH)]
    for y, row in enumerate(rows):
        row = bytearray(row)
        for x in range(len(row)):
            letter = letters[y // STITCH][x // STITCH]
            shade = None if letter == "." else cell[y % STITCH][x % STITCH]
            if shade is not None:
                tint = 1.0 + 0.10 * (noise(x // STITCH, y // STITCH, 7) - 0.5) + 0.06 * (noise(x, y, 8) - 0.5)
                row[x] = names.index(INK[letter]) * LEVELS + nearest_level(shade * tint)
        rows[y] = bytes(row)


def main():
    rows = weave(THREADS, warp=lambda column, row: 0, weft=lambda column, row: 1,
                 warp_on_top=lambda column, row: (column + row) % 2 == 0, irregularity=1.5)
    embroider(rows, stitched())
    path = pathlib.Path(__file__).parent.parent / "textures" / "linen_sea.png"
    write_indexed_png(path, rows, palette(YARNS.values()))


if __name__ == "__main__":
    main()
