"""Writes Wavefront OBJ files whose bytes depend on nothing but the mesh."""


def write_obj(path, comment, positions, uvs, groups):
    """positions: (x, y, z) in metres; uvs: (u, v), v up; groups: [(name or None, faces)], where a face is a list of
    (position, uv) index pairs counted from 0, counter-clockwise seen from outside."""
    lines = [f"# {comment}"]
    lines += ["v " + " ".join(number(c) for c in p) for p in positions]
    lines += ["vt " + " ".join(number(c) for c in uv) for uv in uvs]
    for name, faces in groups:
        if name:
            lines.append(f"g {name}")
        lines += ["f " + " ".join(f"{p + 1}/{t + 1}" for p, t in face) for face in faces]
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write("\n".join(lines) + "\n")


def number(value):
    """Eight decimals keep a regular grid regular in single precision; no trailing zeros, no minus in front of a zero."""
    text = f"{value:.8f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
