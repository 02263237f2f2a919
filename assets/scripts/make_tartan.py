#!/usr/bin/env python3
"""assets/textures/tartan.png: a tartan of our own in the sea's colours, woven as a 2/2 twill. It tiles."""
import pathlib

from png_writer import write_indexed_png
from weave import palette, weave

YARNS = {"teal": "#23808a", "navy": "#1a2c4a", "cream": "#efe4cb", "coral": "#e2603f", "mist": "#8fb4ad"}
# Half a sett, pivot to pivot: (yarn, threads). The half in between is its mirror image.
HALF_SETT = [("coral", 4), ("navy", 13), ("mist", 2), ("navy", 13), ("teal", 24), ("cream", 3), ("teal", 5)]
THREADS = 384


def sett():
    """One period: pivots are laid once, everything else there and back."""
    half = [yarn for yarn, count in HALF_SETT for _ in range(count)]
    return half + half[::-1]


def main():
    period = sett()
    assert THREADS % len(period) == 0, len(period)
    names = list(YARNS)
    yarn = [names.index(period[k % len(period)]) for k in range(THREADS)]
    rows = weave(THREADS,
                 warp=lambda column, row: yarn[column],
                 weft=lambda column, row: yarn[row],
                 warp_on_top=lambda column, row: (column + row) % 4 < 2)
    path = pathlib.Path(__file__).parent.parent / "textures" / "tartan.png"
    write_indexed_png(path, rows, palette(YARNS.values()))


if __name__ == "__main__":
    main()
