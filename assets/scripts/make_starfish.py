#!/usr/bin/env python3
"""Writes ../meshes/starfish.obj: a starfish one metre across, closed, lying around the origin with its back to +y and its
first arm along +x. Each arm is a kite of quads from the middle to its tip, above and below; the halves meet in a rim.
The texture's left half lies on the back, its right half on the belly. Groups: `tip`, the last third of the first arm, and
`star`, the rest."""
import math
import pathlib

from obj_writer import write_obj

ARMS, CELLS = 5, 12  # cells along each side of a kite
REACH, NOTCH = 0.5, 0.15  # radius of the tips, and of the rim between the arms [m]
BACK, BELLY = 0.085, 0.045  # height of the middle above and below the rim [m]
UV_MARGIN = 0.02


def spaced(i):
    """0 to 1, denser towards the rim, where the surface turns."""
    return 1.0 - (1.0 - i / CELLS) ** 1.35


def kite(a, b, arm):
    """A place in the arm's kite, (0, 0) the middle of the star, (1, 1) the tip. The sides bend inwards, arms are slim."""
    left = (NOTCH * math.cos(math.pi / ARMS), NOTCH * math.sin(math.pi / ARMS))
    along = a * (1 - b) * left[0] + b * (1 - a) * left[0] + a * b * REACH
    aside = (a - b) * left[1] * (1 - 0.35 * a * b)
    angle = 2 * math.pi * arm / ARMS
    return along * math.cos(angle) - aside * math.sin(angle), -(along * math.sin(angle) + aside * math.cos(angle))


def height(a, b, top):
    """Elliptic towards the rim; a ridge runs down each arm of the back."""
    bulge = math.sqrt(max(0.0, (1 - a * a) * (1 - b * b)))
    return bulge * (BACK * (1 - 0.15 * abs(a - b)) if top else -BELLY)


class Star:
    def __init__(self):
        self.positions, self.uvs, self._number, self._uv_number = [], [], {}, {}

    def corner(self, arm, i, j, top):
        """(position, uv) of the kite's point; neighbouring arms share a side, both halves the rim."""
        a, b = spaced(i), spaced(j)
        x, z = kite(a, b, arm)
        y = height(a, b, top)
        place = (round(x, 7), round(y, 7), round(z, 7))
        if place not in self._number:
            self._number[place] = len(self.positions)
            self.positions.append((x, y, z))
        u, v = 0.5 + x * (1 - UV_MARGIN), 0.5 - z * (1 - UV_MARGIN)
        uv = (round(0.5 * u + (0.0 if top else 0.5), 6), round(v, 6))
        if uv not in self._uv_number:
            self._uv_number[uv] = len(self.uvs)
            self.uvs.append(uv)
        return self._number[place], self._uv_number[uv]

    def face(self, arm, i, j, top):
        corners = [self.corner(arm, i, j, top), self.corner(arm, i + 1, j, top),
                   self.corner(arm, i + 1, j + 1, top), self.corner(arm, i, j + 1, top)]
        return corners[::-1] if top else corners


def main():
    star = Star()
    groups = {"star": [], "tip": []}
    for top in (True, False):
        for arm in range(ARMS):
            for i in range(CELLS):
                for j in range(CELLS):
                    at_tip = arm == 0 and min(i, j) >= 2 * CELLS // 3
                    groups["tip" if at_tip else "star"].append(star.face(arm, i, j, top))
    path = pathlib.Path(__file__).parent.parent / "meshes" / "starfish.obj"
    write_obj(path, "billow: starfish, made by make_starfish.py", star.positions, star.uvs, list(groups.items()))
    print(f"{len(star.positions)} points, {sum(map(len, groups.values()))} quads")


if __name__ == "__main__":
    main()
