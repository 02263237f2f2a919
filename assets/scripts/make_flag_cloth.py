#!/usr/bin/env python3
"""assets/textures/flag.png: make_flag.py's flag, of our own: a coral sun that rises over three waves, on ripstop nylon,
with a hem all around and a white heading with grommets at the pole."""
import math
import pathlib

from make_fish_skin import mix, smooth
from png_writer import write_rgb_png

WIDTH, HEIGHT = 1152, 768  # pixels; u is from 0 to 1.5, v from 0 at the bottom to 1
CREAM, CORAL, GOLD = (245, 234, 210), (226, 92, 60), (240, 178, 66)
WAVES = [  # colour, height, how high and how long its crests are, and where the first one is
    ((126, 186, 190), 0.440, 0.036, 0.500, 0.00),
    ((36, 124, 144), 0.315, 0.036, 0.500, 0.25),
    ((20, 50, 88), 0.180, 0.036, 0.500, 0.50)]
FOAM = 0.013  # the light line along a wave's crest
SUN, SUN_RADIUS, RAYS = (0.75, 0.50), 0.235, 12  # from level to level
HEADING, HEM = 0.065, 0.020
EDGE = 0.8 / HEIGHT  # over which colours pass into one another


def inside(distance):
    """1 where `distance` is well above 0, 0 well below."""
    return smooth(-EDGE, EDGE, distance)


def sun(u, v, colour):
    x, y = u - SUN[0], v - SUN[1]
    r, turn = math.hypot(x, y), math.atan2(y, x) / math.pi * RAYS
    number = round(turn)  # of the nearest ray, 0 and RAYS being level
    beside = (0.25 - abs(turn - number)) * math.pi / RAYS * r  # of the ray's edge, to its inside
    reach = 0.155 if number % 2 == 0 else 0.105
    if 0 < number < RAYS:
        colour = mix(colour, GOLD, inside(min(beside, r - SUN_RADIUS - 0.035, SUN_RADIUS + reach - r)))
    return mix(colour, CORAL, inside(SUN_RADIUS - r))


def crest(u, height, amplitude, length, first):
    """A wave with crests sharper than its troughs (Stokes, to second order)."""
    angle = 2 * math.pi * (u - first) / length
    return height + amplitude * (math.cos(angle) + 0.28 * math.cos(2 * angle))


def waves(u, v, colour):
    for tint, *shape in WAVES:
        depth = crest(u, *shape) - v
        colour = mix(mix(colour, CREAM, inside(depth + FOAM)), tint, inside(depth))
    return colour


def sewn(u, v, colour):
    """Heading, grommets, hem and seams."""
    colour = mix(colour, (250, 248, 242), inside(HEADING - u))
    for y in (0.055, 0.945):
        r = math.hypot(u - 0.5 * HEADING, v - y)
        colour = mix(mix(colour, (184, 142, 70), inside(0.019 - r)), (60, 52, 44), inside(0.010 - r))
    edge = min(v, 1 - v, 1.5 - u)
    shade = 1.0 - 0.10 * inside(HEM - edge) * inside(u - HEADING)
    for seam, along in ((edge - HEM, u if min(v, 1 - v) < 1.5 - u else v), (u - HEADING + 0.006, v)):
        stitch = inside(0.0016 - abs(seam)) * inside(0.30 - abs((along / 0.012) % 1.0 - 0.5))
        shade *= 1.0 - 0.28 * stitch
    return tuple(c * shade for c in colour)


def nylon(column, row):
    """Every eighth thread is a thick one."""
    return 1.0 - 0.045 * (column % 8 == 0) - 0.045 * (row % 8 == 0) + 0.012 * ((column + row) % 2)


def main():
    rows = []
    for row in range(HEIGHT):
        v, line = 1.0 - (row + 0.5) / HEIGHT, bytearray()
        for column in range(WIDTH):
            u = 1.5 * (column + 0.5) / WIDTH
            colour = sewn(u, v, waves(u, v, sun(u, v, CREAM)))
            light = nylon(column, row)
            line += bytes(int(min(max(c * light, 0.0), 255.0) + 0.5) for c in colour)
        rows.append(bytes(line))
    write_rgb_png(pathlib.Path(__file__).parent.parent / "textures" / "flag.png", rows)


if __name__ == "__main__":
    main()
