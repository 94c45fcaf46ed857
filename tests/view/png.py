"""Reads a screenshot: PNG of eight bits a channel, RGB or RGBA, not interlaced. https://www.w3.org/TR/png"""

import struct
import zlib


def _paeth(a: int, b: int, c: int) -> int:
    estimate = a + b - c
    return min((a, b, c), key=lambda value: abs(estimate - value))


def _unfiltered(kind: int, line: bytearray, above: bytearray, size: int) -> bytearray:
    for i in range(len(line)):
        left = line[i - size] if i >= size else 0
        corner = above[i - size] if i >= size else 0
        predicted = [0, left, above[i], (left + above[i]) // 2, _paeth(left, above[i], corner)][kind]
        line[i] = (line[i] + predicted) & 255
    return line


def pixels(png: bytes) -> list[list[tuple[int, int, int]]]:
    """The rows of the picture, with red, green and blue per pixel."""
    width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", png[16:29])
    if depth != 8 or colour not in (2, 6) or interlaced:
        raise ValueError(f"a PNG of another kind: {depth} bits, colour type {colour}")
    size = 3 if colour == 2 else 4
    packed, at = b"", 8
    while at < len(png):
        length, name = struct.unpack(">I4s", png[at : at + 8])
        packed += png[at + 8 : at + 8 + length] if name == b"IDAT" else b""
        at += length + 12
    data, rows = zlib.decompress(packed), []
    above = bytearray(width * size)
    for y in range(height):
        start = y * (width * size + 1)
        above = _unfiltered(data[start], bytearray(data[start + 1 : start + 1 + width * size]), above, size)
        rows.append([tuple(above[x : x + 3]) for x in range(0, width * size, size)])
    return rows
