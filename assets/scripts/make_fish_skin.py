#!/usr/bin/env python3
"""Writes ../textures/fish.png, the skin of make_fish.py's yellowtail: dark above and pale below, a golden stripe into a
golden tail, scales that overlap like roof tiles, fins with rays, an eye."""
import math
import os

import make_fish
from png_writer import write_rgb_png

WIDTH, HEIGHT = 1536, 1024
BACK, FLANK, SILVER, BELLY = (16, 42, 74), (52, 112, 156), (196, 208, 214), (244, 241, 234)
GOLD, AMBER, BLUSH = (250, 196, 50), (226, 134, 28), (226, 190, 186)
SCALE_ROWS, SCALE_STEP = 34, 0.0135  # rows from belly to back; distance between scales along the body


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def smooth(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def bump(x, centre, width):
    return math.exp(-((x - centre) / width) ** 2)


def hashed(i, j):
    """Evenly spread in [0, 1), the same on every machine."""
    n = (i * 374761393 + j * 668265263) & 0xFFFFFFFF
    n = ((n ^ (n >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((n ^ (n >> 16)) & 0xFFFFFF) / 0x1000000


def noise(x, y):
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    low = hashed(i, j) * (1 - u) + hashed(i + 1, j) * u
    high = hashed(i, j + 1) * (1 - u) + hashed(i + 1, j + 1) * u
    return low * (1 - v) + high * v


def scale(s, share):
    """The scale that shows at a place: its number, and how far the place is from its middle (0) to its edge (1)."""
    x, y = s / SCALE_STEP, share * SCALE_ROWS
    best = (0, 0, 1.0)
    for column in range(math.floor(x) - 2, math.floor(x) + 2):
        shift = 0.5 * (column % 2)
        row = round(y - shift)
        r = math.hypot((x - column - 0.1) / 1.28, (y - row - shift) / 0.80)
        if r < 1.0:  # the scale farthest in front lies on top
            return column, row, r
    return best


def ground(s, share):
    """Countershading and the stripe, without scales."""
    back = smooth(0.55, 0.93, share)
    colour = mix(BELLY, SILVER, smooth(0.06, 0.36, share))
    colour = mix(colour, BLUSH, 0.35 * bump(share, 0.34, 0.12) * smooth(0.1, 0.4, s))
    colour = mix(colour, FLANK, smooth(0.40, 0.66, share))
    colour = mix(colour, BACK, back)
    middle = 0.565 + 0.02 * math.sin(5 * s)
    width = 0.022 + 0.040 * smooth(0.05, 0.5, s) + 0.45 * smooth(0.62, 0.86, s) ** 2
    stripe = bump(share, middle + 0.20 * smooth(0.6, 0.86, s), width) * smooth(0.02, 0.11, s)
    return mix(colour, mix(GOLD, AMBER, 0.35 * back), min(stripe * 1.15, 1.0))


def freckles(s, share, colour):
    spots = smooth(0.66, 0.78, noise(110 * s + 3, 40 * share)) * smooth(0.62, 0.78, share) * smooth(0.16, 0.3, s)
    return mix(colour, GOLD, 0.75 * spots)


def head(s, share, colour):
    mouth = bump(share, 0.47 - 1.6 * s, 0.013) * (1 - smooth(0.035, 0.05, s))
    colour = mix(colour, (70, 52, 56), 0.75 * mouth)
    edge = 0.178 + 0.052 * math.sqrt(max(1 - ((share - 0.46) / 0.37) ** 2, 0.0)) - s  # in front of the gill's edge
    if abs(share - 0.46) < 0.37:
        colour = mix(colour, (30, 40, 52), 0.70 * bump(edge, 0.0, 0.0032))
        colour = mix(colour, (255, 252, 240), 0.30 * bump(edge, 0.009, 0.006))
        colour = mix(colour, (40, 54, 66), 0.25 * bump(edge, 0.040, 0.003) * bump(share, 0.44, 0.2))
    sheen = noise(60 * s, 24 * share) - 0.5
    return tuple(c * (1 + 0.05 * sheen) for c in colour)


def body(u, v):
    s = (u - 0.02) / 0.96 * 0.893
    share = min(max((v - 0.02) / 0.96, 0.0), 1.0)
    gill = 0.178 + 0.052 * math.sqrt(max(1 - ((share - 0.46) / 0.37) ** 2, 0.0))
    scaly = smooth(gill, gill + 0.012, s) * (1 - 0.5 * smooth(0.84, 0.88, s))
    if scaly <= 0.0:
        return head(s, share, ground(s, share))
    column, row, r = scale(s, share)
    here = freckles(s, share, ground(s, share))
    tone = 1.0 + 0.10 * (hashed(column, row) - 0.5) + 0.10 * (1 - r) - 0.30 * smooth(0.72, 1.0, r) ** 2
    glint = 0.16 * bump(r, 0.62, 0.16) * (0.4 + 0.6 * hashed(row, column)) * (1 - smooth(0.8, 1.0, share))
    lateral = 0.30 * bump(share, 0.66 - 0.08 * smooth(0.2, 0.6, s), 0.006) * (1 if column % 2 else 0.4)
    scaled = mix(mix(tuple(c * tone for c in here), (255, 255, 250), glint), (28, 44, 62), lateral)
    return mix(head(s, share, here), scaled, scaly)


def rays(u, v, count, splits):
    """Dark lines between the rays; a ray splits in two at each u of `splits`."""
    lines = 0.0
    for start in (0.0, *splits):
        wave = abs(math.sin(math.pi * count * v))
        lines = max(lines, (1 - smooth(0.0, 0.34, wave)) * smooth(start, start + 0.12, u) if start else
                    1 - smooth(0.0, 0.34, wave))
        count *= 2
    return lines


def caudal(u, v):
    colour = mix(mix(AMBER, GOLD, smooth(0.0, 0.45, u)), (255, 222, 120), 0.7 * smooth(0.5, 1.0, u))
    colour = mix(colour, AMBER, 0.55 * (bump(v, 0.0, 0.06) + bump(v, 1.0, 0.06)))
    return mix(colour, (170, 98, 22), 0.40 * rays(u, v, 14, (0.45,)))


def dorsal(u, v):
    colour = mix(mix(BACK, FLANK, 0.5), mix(GOLD, (210, 200, 130), 0.3), smooth(0.15, 0.95, u))
    return mix(colour, (26, 44, 58), 0.50 * rays(u, v, 22, (0.6,)))


def anal(u, v):
    colour = mix(SILVER, GOLD, smooth(0.1, 0.9, u))
    return mix(colour, (150, 112, 60), 0.38 * rays(u, v, 13, (0.55,)))


def paired(u, v):
    colour = mix(mix(SILVER, BLUSH, 0.4), (250, 226, 160), smooth(0.1, 0.9, u))
    return mix(colour, (160, 128, 90), 0.36 * rays(u, v, 9, (0.5,)))


def eye(u, v):
    x, y = 2 * u - 1, 2 * v - 1
    r, angle = math.hypot(x, y), math.atan2(y, x)
    iris = mix(GOLD, AMBER, 0.6 * noise(9 * angle, 6 * r) + 0.3 * smooth(0.6, 0.85, r))
    colour = mix((9, 12, 18), iris, smooth(0.50, 0.55, r))
    colour = mix(colour, (36, 34, 36), smooth(0.84, 0.90, r))
    colour = mix(colour, mix(FLANK, SILVER, 0.5), smooth(0.95, 1.0, r))
    return mix(colour, (255, 255, 255), 0.9 * (1 - smooth(0.10, 0.17, math.hypot(x - 0.20, y - 0.26))))


PARTS = [(make_fish.BODY_UV, body), (make_fish.CAUDAL_UV, caudal), (make_fish.DORSAL_UV, dorsal),
         (make_fish.ANAL_UV, anal), (make_fish.PAIRED_UV, paired), (make_fish.EYE_UV, eye)]


def pixel(u, v):
    """The part whose rectangle is nearest, so that filtering across its border finds its own colours."""
    def distance(place):
        x, y, w, h = place
        return max(x - u, u - x - w, 0.0) + max(y - v, v - y - h, 0.0)
    place, paint = min(PARTS, key=lambda part: distance(part[0]))
    local = [min(max((t - low) / size, 0.0), 1.0) for t, low, size in ((u, place[0], place[2]), (v, place[1], place[3]))]
    return paint(*local)


def main():
    rows = []
    for j in range(HEIGHT):
        v = 1 - (j + 0.5) / HEIGHT
        row = bytearray()
        for i in range(WIDTH):
            row += bytes(min(max(round(c), 0), 255) for c in pixel((i + 0.5) / WIDTH, v))
        rows.append(bytes(row))
    here = os.path.dirname(os.path.abspath(__file__))
    write_rgb_png(os.path.join(here, "..", "textures", "fish.png"), rows)


if __name__ == "__main__":
    main()
