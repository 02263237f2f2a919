#!/usr/bin/env python3
"""Writes ../textures/starfish.png, the skin of make_starfish.py's starfish: on the left its back, coral with rows of pale
knobs that grow towards the middle; on the right its belly, cream with a groove down each arm."""
import math
import pathlib

from make_fish_skin import bump, mix, noise, smooth
from make_starfish import ARMS, REACH
from png_writer import write_rgb_png

SIZE = 768  # of each half
CORAL, RUST, KNOB, CREAM, GROOVE = (226, 92, 48), (140, 38, 30), (255, 214, 150), (243, 226, 196), (190, 134, 96)
ROWS, KNOB_STEP = (-2, -1, 0, 1, 2), 0.030  # rows of knobs beside an arm's axis; metres between knobs of a row


def along_arm(x, z):
    """(distance along, distance beside the axis) of the nearest arm [m]."""
    sector = 2 * math.pi / ARMS
    angle = math.atan2(-z, x)
    turned = angle - sector * round(angle / sector)
    radius = math.hypot(x, z)
    return radius * math.cos(turned), radius * math.sin(turned)


def back(x, z):
    s, t = along_arm(x, z)
    share = min(s / REACH, 1.0)
    spread = 0.030 * (1.15 - share)
    colour = mix(CORAL, RUST, 0.55 * smooth(0.35, 1.0, abs(t) / (0.10 * (1.2 - share))))
    colour = mix(colour, RUST, 0.35 * noise(60 * x + 40, 60 * z + 40))
    for row in ROWS:
        k = round(s / KNOB_STEP - 0.5 * (row % 2)) + 0.5 * (row % 2)
        size = 0.010 * (1.1 - 0.75 * share) * (1.0 if row == 0 else 0.75)
        distance = math.hypot(s - k * KNOB_STEP, t - row * spread)
        if s > 0.02:
            colour = mix(mix(colour, RUST, 0.6 * smooth(1.5, 1.0, distance / size)), KNOB,
                         smooth(1.0, 0.7, distance / size)) if distance < 1.5 * size else colour
    return colour


def belly(x, z):
    s, t = along_arm(x, z)
    groove = bump(t, 0.0, 0.012)
    feet = 0.5 + 0.5 * math.cos(2 * math.pi * s / 0.016)
    colour = mix(CREAM, CORAL, 0.45 * smooth(0.03, 0.09, abs(t)))
    colour = mix(colour, GROOVE, 0.7 * groove)
    return mix(colour, KNOB, 0.6 * feet * bump(abs(t), 0.020, 0.007))


def main():
    rows = []
    for j in range(SIZE):
        z = (j + 0.5) / SIZE / 0.98 - 0.5 / 0.98
        row = bytearray()
        for paint in (back, belly):
            for i in range(SIZE):
                x = (i + 0.5) / SIZE / 0.98 - 0.5 / 0.98
                row += bytes(int(min(max(c, 0), 255) + 0.5) for c in paint(x, z))
        rows.append(bytes(row))
    write_rgb_png(pathlib.Path(__file__).parent.parent / "textures" / "starfish.png", rows)


if __name__ == "__main__":
    main()
