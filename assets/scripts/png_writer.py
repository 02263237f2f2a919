"""Writes sRGB PNG files whose bytes depend on nothing but the picture (and zlib)."""
import struct
import zlib


def chunk(kind, data):
    body = kind + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))


def write_png(path, size, depth_and_colour, palette, rows):
    """rows: scan lines with the filter's byte in front."""
    header = struct.pack(">IIBBBBB", *size, *depth_and_colour, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"sRGB", b"\0") + palette
                   + chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


def write_indexed_png(path, rows, palette):
    """rows: one bytes object of palette indices per line, top line first; palette: up to 256 (r, g, b) in 0..255."""
    colours = chunk(b"PLTE", bytes(c for colour in palette for c in colour))
    write_png(path, (len(rows[0]), len(rows)), (8, 3), colours, [b"\0" + row for row in rows])


def differences(rows):
    """Each byte as its difference from the one above it, which compresses pictures without large even areas."""
    above = bytes(len(rows[0]))
    for row in rows:
        yield b"\2" + bytes((a - b) & 255 for a, b in zip(row, above))
        above = row


def write_rgb_png(path, rows):
    """rows: one bytes object of r, g, b per pixel for each line, top line first."""
    write_png(path, (len(rows[0]) // 3, len(rows)), (8, 2), b"", list(differences(rows)))


def write_rgba_png(path, rows):
    """rows: one bytes object of r, g, b, a per pixel for each line, top line first."""
    write_png(path, (len(rows[0]) // 4, len(rows)), (8, 6), b"", list(differences(rows)))
