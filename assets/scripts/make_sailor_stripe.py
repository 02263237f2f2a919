#!/usr/bin/env python3
"""assets/textures/sailor_stripe.png: navy and coral stripes on cream, a 3/1 twill (ticking). It tiles."""
import pathlib

from png_writer import write_indexed_png
from weave import palette, weave

YARNS = {"cream": "#f1e9d8", "navy": "#22406b", "coral": "#dd6247"}
# One period across the warp: (yarn, threads).
STRIPES = [("cream", 22), ("navy", 20), ("cream", 6), ("coral", 2), ("cream", 2), ("coral", 2), ("cream", 6),
           ("navy", 20), ("cream", 16)]
THREADS = 384


def main():
    period = [yarn for yarn, count in STRIPES for _ in range(count)]
    assert THREADS % len(period) == 0, len(period)
    names = list(YARNS)
    rows = weave(THREADS,
                 warp=lambda column, row: names.index(period[column % len(period)]),
                 weft=lambda column, row: names.index("cream"),
                 warp_on_top=lambda column, row: (column + row) % 4 != 3)
    path = pathlib.Path(__file__).parent.parent / "textures" / "sailor_stripe.png"
    write_indexed_png(path, rows, palette(YARNS.values()))


if __name__ == "__main__":
    main()
