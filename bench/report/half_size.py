# SPDX-License-Identifier: MIT
"""Halves a picture: half_size.py FROM.png TO.png (8 bits, red green blue)."""
import pathlib
import struct
import sys
import zlib


def read(data):
    """Width, height and the rows of bytes."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed, width, height = 8, b"", 0, 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert (bits, colour, interlaced) == (8, 2, 0)
        if kind == b"IDAT":
            packed += body
        at += size + 12
    raw, rows, before = zlib.decompress(packed), [], bytes(3 * width)
    for y in range(height):
        begin = y * (3 * width + 1)
        method, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + 3 * width])
        for k in range(3 * width if method else 0):
            left, up, corner = (row[k - 3] if k > 2 else 0), before[k], (before[k - 3] if k > 2 else 0)
            if method == 4:
                guess = left + up - corner
                best = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            else:
                best = (0, left, up, (left + up) // 2)[method]
            row[k] = (row[k] + best) & 255
        rows.append(bytes(row))
        before = row
    return width, height, rows


def write(width, height, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    raw = b""
    for k, row in enumerate(rows):  # differences to the row above pack better
        above = rows[k - 1] if k else bytes(len(row))
        raw += b"\2" + bytes((a - b) & 255 for a, b in zip(row, above))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def half(width, height, rows):
    """Means of two by two, to 32 steps of each colour."""
    small = []
    for y in range(0, height - 1, 2):
        a, b = rows[y], rows[y + 1]
        small.append(bytes(min(255, (a[k] + a[k + 3] + b[k] + b[k + 3] + 16) // 32 * 8)
                           for x in range(width // 2) for k in range(6 * x, 6 * x + 3)))
    return width // 2, height // 2, small


if __name__ == "__main__":
    pathlib.Path(sys.argv[2]).write_bytes(write(*half(*read(pathlib.Path(sys.argv[1]).read_bytes()))))
