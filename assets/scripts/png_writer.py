"""Writes indexed sRGB PNG files whose bytes depend on nothing but the picture (and zlib)."""
import struct
import zlib


def write_indexed_png(path, rows, palette):
    """rows: one bytes object of palette indices per line, top line first; palette: up to 256 (r, g, b) in 0..255."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 3, 0, 0, 0)
    pixels = b"".join(b"\0" + row for row in rows)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"sRGB", b"\0")
                   + chunk(b"PLTE", bytes(c for colour in palette for c in colour))
                   + chunk(b"IDAT", zlib.compress(pixels, 9)) + chunk(b"IEND", b""))
