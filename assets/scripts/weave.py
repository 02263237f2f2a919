"""Woven cloth, thread by thread: which thread lies on top, and how the light catches it.

A picture is a square of `threads` x `threads` crossings, PITCH pixels each. It tiles: every pattern and every
irregularity comes back after `threads`. Shades are computed in linear light and stored as levels of a palette, so that
a picture of a few yarns stays an indexed PNG.
"""
import math

PITCH = 3  # pixels per thread
LEVELS = 28  # shades of each yarn
DARKEST, BRIGHTEST = 0.36, 1.08  # linear factor on a yarn's colour


def weave(threads, warp, weft, warp_on_top, irregularity=1.0):
    """Rows of palette indices, yarn * LEVELS + level.

    warp(column, row) and weft(column, row) name the yarn of the upright and the level thread at a crossing;
    warp_on_top(column, row) says which of them covers the other. irregularity scales how much hand-spun yarn varies.
    """
    upright, level = Yarns(threads, 1), Yarns(threads, 2)
    rows = []
    for y in range(threads * PITCH):
        row, fy = divmod(y, PITCH)
        line = bytearray()
        for column in range(threads):
            warp_covers = warp_on_top(column, row)
            yarn = warp(column, row) if warp_covers else weft(column, row)
            # How far the covering thread goes on before it dives: the float bulges in its middle.
            if warp_covers:
                before = 1 if warp_on_top(column, (row - 1) % threads) else 0
                after = 1 if warp_on_top(column, (row + 1) % threads) else 0
            else:
                before = 0 if warp_on_top((column - 1) % threads, row) else 1
                after = 0 if warp_on_top((column + 1) % threads, row) else 1
            for fx in range(PITCH):
                across, along = (fx, fy) if warp_covers else (fy, fx)
                shade = ACROSS[across] * FLOAT[before][after][along]
                if warp_covers:
                    shade *= 1.0 + irregularity * upright.variation(column, y)
                else:
                    shade *= 0.94 * (1.0 + irregularity * level.variation(row, column * PITCH + fx))
                shade *= 1.0 + 0.05 * irregularity * (noise(column * PITCH + fx, y, 3) - 0.5)
                line.append(yarn * LEVELS + nearest_level(shade))
        rows.append(bytes(line))
    return rows


class Yarns:
    """One direction's threads: each a little lighter or darker than its neighbours, and thicker here and there."""

    def __init__(self, threads, seed):
        self.length = threads * PITCH
        self.tint = [0.10 * (noise(k, 0, seed) - 0.5) for k in range(threads)]
        self.slub = [[0.09 * (noise(k, s, seed + 10) - 0.5) for s in range(16)] for k in range(threads)]

    def variation(self, thread, along):
        position = along * 16 / self.length
        first = int(position)
        t = position - first
        t = t * t * (3.0 - 2.0 * t)
        slub = self.slub[thread]
        return self.tint[thread] + slub[first] * (1.0 - t) + slub[(first + 1) % 16] * t


def round_profile(steepness):
    """Brightness across a round thread at the pixels' centres: 1 in the middle, falling off towards the edges."""
    offsets = [(2 * k + 1) / PITCH - 1.0 for k in range(PITCH)]
    return [1.0 - steepness * offset * offset for offset in offsets]


def float_profile(before, after):
    """Brightness along one crossing of a float: it falls towards an end where the thread dives under the next one."""
    values = []
    for k in range(PITCH):
        s = (k + 0.5) / PITCH
        start = 1.0 if before else 0.72 + 0.28 * math.sqrt(min(1.0, 1.6 * s))
        end = 1.0 if after else 0.72 + 0.28 * math.sqrt(min(1.0, 1.6 * (1.0 - s)))
        values.append(start * end)
    return values


def noise(x, y, seed):
    """A number in [0, 1) that looks random and is the same everywhere."""
    h = (x * 374761393 + y * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    h = ((h ^ (h >> 15)) * 2246822519) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFFFF) / 0x1000000


def nearest_level(shade):
    level = (shade - DARKEST) / (BRIGHTEST - DARKEST) * (LEVELS - 1)
    return max(0, min(LEVELS - 1, int(level + 0.5)))


def palette(yarns):
    """The colours of all levels of all yarns; yarns are sRGB '#rrggbb'."""
    colours = []
    for yarn in yarns:
        linear = [to_linear(int(yarn[k:k + 2], 16) / 255) for k in (1, 3, 5)]
        for level in range(LEVELS):
            factor = DARKEST + (BRIGHTEST - DARKEST) * level / (LEVELS - 1)
            colours.append(tuple(int(to_srgb(min(1.0, c * factor)) * 255 + 0.5) for c in linear))
    return colours


def to_linear(c):
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


def to_srgb(c):
    return 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055


ACROSS = round_profile(0.42)
FLOAT = [[float_profile(before, after) for after in (0, 1)] for before in (0, 1)]
