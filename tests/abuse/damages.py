"""Ways to damage a file. Each takes a source of random numbers, the file, and another whole file of the same format."""

import json
import random
import re
import struct
import zipfile
from collections.abc import Callable
from io import BytesIO

from meshes import glb_of, zip_of

Damage = Callable[[random.Random, bytes, bytes], bytes]

DEEP = 30_000  # brackets
LONGEST = 2_000_000  # bytes, so that no file is slow for its length alone

# The lengths are bounded, so that a search takes no more than linear time.
NUMBER = re.compile(rb"(?<![\w.#])[+-]?(?:\d{1,30}(?:\.\d{0,30})?|\.\d{1,30})(?:[eE][+-]?\d{1,4})?(?![\w.])")
NUMBERS = b"""1e308 -1e308 1e309 nan -nan inf -inf -0 -1 0 1e-320 5e-324 0.1e 1e 1e400 2147483647 2147483648 -2147483649
4294967295 4294967296 9223372036854775807 18446744073709551616 99999999999999999999999999
0x10 1_000 1,5 --1 +1 .5 5. 1e-30 1e30 1e154""".split()
BRACKETS = [b"[", b'{"a":', b"<a>", b"(", b"<node>", b"- ", b"{", b"[[", b'<link name="a">', b"&a [", b"/*", b"<!--"]
TOKENS = [bytes([byte]) for byte in b"<>{}[]\"'\n\r \t,;#&\0\xff\\:"]
KEY = re.compile(rb'"[^"\\\n]{1,40}"\s*:\s*')
ATTRIBUTE = re.compile(rb'\s[\w:]{1,40}="[^"]{0,200}"')


def place(rng: random.Random, whole: bytes) -> int:
    return rng.randrange(len(whole) + 1)


def block(rng: random.Random, whole: bytes, longest: int = 200) -> bytes:
    begin = place(rng, whole)
    return whole[begin : begin + rng.randint(1, longest)]


def put(whole: bytes, at: int, text: bytes, instead_of: int = 0) -> bytes:
    return whole[:at] + text + whole[at + instead_of :]


def truncated(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    return whole[: place(rng, whole)]


def bits_flipped(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    changed = bytearray(whole)
    for _ in range(rng.choice([1, 1, 2, 8])):
        if changed:
            changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def bytes_lost(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    return put(whole, place(rng, whole), b"", rng.randint(1, 60))


def bytes_added(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    return put(whole, place(rng, whole), rng.randbytes(rng.randint(1, 16)))


def token_added(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    return put(whole, place(rng, whole), rng.choice(TOKENS), rng.randint(0, 1))


def spliced(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    return whole[: place(rng, whole)] + other[place(rng, other) :]


def block_repeated(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    repeated = block(rng, whole) * rng.choice([1, 2, 10, 1000])
    return put(whole, place(rng, whole), repeated)


def line_repeated(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    lines = whole.splitlines(keepends=True) or [b""]
    lines.insert(rng.randint(0, len(lines)), rng.choice(lines))
    return b"".join(lines)


def lines_swapped(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    lines = whole.splitlines(keepends=True) or [b""]
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[i], lines[j] = lines[j], lines[i]
    return b"".join(lines)


def number_replaced(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    found = list(NUMBER.finditer(whole))
    if not found:
        return bytes_added(rng, whole, other)
    number = rng.choice(NUMBERS)
    if rng.random() < 0.1:  # all of them
        return NUMBER.sub(number, whole)
    match = rng.choice(found)
    return put(whole, match.start(), number, match.end() - match.start())


def number_nudged(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    """Another number of about the same size, as a slip of a finger makes it."""
    found = list(NUMBER.finditer(whole))
    if not found:
        return bits_flipped(rng, whole, other)
    match = rng.choice(found)
    text = match.group().decode()
    factor, step = rng.choice([0.5, 2, -1, 10, 1 + 1e-9, 1 - 2**-52]), rng.choice([-1, 1, 2])
    is_whole = text.isdigit() and rng.random() < 0.7
    nudged = str(int(text) + step) if is_whole else repr(float(text) * factor)
    return put(whole, match.start(), nudged.encode(), match.end() - match.start())


def binary_number_replaced(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    number = rng.choice(
        [
            struct.pack(order + kind, value)
            for order in "<>"
            for kind, value in [("f", 3e38), ("f", float("nan")), ("d", 1e308), ("d", float("inf")), ("f", -0.0)]
        ]
        + [b"\xff" * 4, b"\0" * 4, b"\xff\xff\xff\x7f", b"\0\0\0\x80", b"\0\0\0\x40"]
    )
    return put(whole, place(rng, whole), number, len(number))


def nested(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    bracket = rng.choice(BRACKETS)
    found = list(NUMBER.finditer(whole))
    if found and rng.random() < 0.5:  # where a value may be
        match = rng.choice(found)
        return put(whole, match.start(), bracket * DEEP, match.end() - match.start())
    return put(whole, place(rng, whole), bracket * DEEP)


def name_twice(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    """A key of JSON or an attribute of XML comes twice, perhaps with another value."""
    keys = list(KEY.finditer(whole))
    if keys and (whole[:1] == b"{" or rng.random() < 0.5):
        match = rng.choice(keys)
        value = rng.choice([b"1", b'"a"', b"[]", b"{}", b"null", b"1e308"])
        return put(whole, match.start(), match.group() + value + b", ")
    attributes = list(ATTRIBUTE.finditer(whole))
    if not attributes:
        return line_repeated(rng, whole, other)
    match = rng.choice(attributes)
    return put(whole, match.start(), match.group())


def value_replaced(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    """A value of JSON has another type."""
    keys = list(KEY.finditer(whole))
    if not keys:
        return token_added(rng, whole, other)
    match = rng.choice(keys)
    end = min((at for at in (whole.find(sign, match.end()) for sign in b",}]\n") if at >= 0), default=len(whole))
    value = rng.choice([b"1", b"-1", b'"a"', b"[]", b"{}", b"null", b"true", b"1e308", b'""', b"4294967296", b"[[1]]"])
    return put(whole, match.end(), value, end - match.end())


def long_line(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    return put(whole, place(rng, whole), rng.choice([b"1 ", b"a", b" ", b'"', b"1,", b"\n", b"1", b"\\"]) * 300_000)


def encoded(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    """Another encoding or other line ends."""
    text = whole.decode("latin-1")
    return rng.choice(
        [
            b"\xef\xbb\xbf" + whole,
            text.encode("utf-16"),
            whole.replace(b"\n", b"\r"),
            whole.replace(b"\n", b"\r\n"),
            whole.replace(b" ", b"\xc2\xa0"),
            whole.replace(b"\n", b""),
        ]
    )


ANY: list[Damage] = [
    truncated,
    bits_flipped,
    bytes_lost,
    bytes_added,
    token_added,
    spliced,
    block_repeated,
    binary_number_replaced,
]
TEXT: list[Damage] = [
    *(number_replaced, number_replaced, number_replaced),
    *(number_nudged, number_nudged, number_nudged),
    *(line_repeated, lines_swapped, nested, name_twice, value_replaced, long_line, encoded),
]


def damaged(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    """One to four damages, one after the other."""
    for _ in range(rng.choice([1, 1, 1, 1, 2, 4])):
        whole = rng.choice(rng.choice([ANY, TEXT]))(rng, whole, other)[:LONGEST]
    return whole


def damaged_zip(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    """Half of the time a part inside is damaged, and the archive around it is sound."""
    if rng.random() < 0.5:
        return damaged(rng, whole, other)
    archive, second = zipfile.ZipFile(BytesIO(whole)), zipfile.ZipFile(BytesIO(other))
    parts = {name: archive.read(name) for name in archive.namelist()}
    name = rng.choice([name for name in parts if name in second.namelist()])
    parts[name] = damaged(rng, parts[name], second.read(name))
    return zip_of(parts, rng.choice([zipfile.ZIP_DEFLATED, zipfile.ZIP_STORED]))


def chunks_of(glb: bytes) -> tuple[bytes, bytes]:
    """The JSON and the buffer of a file of two chunks."""
    end = 20 + struct.unpack_from("<I", glb, 12)[0]
    return glb[20:end], glb[end + 8 :]


def damaged_glb(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    """Most of the time the JSON or the buffer is damaged, and the chunks around them are sound."""
    if rng.random() < 0.3:
        return damaged(rng, whole, other)
    (text, buffer), (second, second_buffer) = chunks_of(whole), chunks_of(other)
    if rng.random() < 0.8:
        return glb_of(damaged(rng, text, second), buffer)
    return glb_of(text, damaged(rng, buffer, second_buffer))


def damaged_tree(rng: random.Random, whole: bytes, other: bytes) -> bytes:
    """Half of the time a value of sound JSON is replaced, so that the damage gets past the parser."""
    if rng.random() < 0.5:
        return damaged(rng, whole, other)
    tree = json.loads(whole)
    for _ in range(rng.choice([1, 1, 2, 3])):
        change_value(rng, tree)
    return json.dumps(tree).encode()


def change_value(rng: random.Random, tree: object) -> None:
    """Replaces, removes or repeats one value of a tree, at a random depth."""
    keys = list(tree) if isinstance(tree, dict) else list(range(len(tree)))  # type: ignore[arg-type]
    if not keys:
        return
    key = rng.choice(keys)
    if isinstance(tree[key], (dict, list)) and rng.random() < 0.8:  # type: ignore[index]
        return change_value(rng, tree[key])  # type: ignore[index]
    if rng.random() < 0.2:
        del tree[key]  # type: ignore[attr-defined]
    else:
        values = [0, -1, 1, 2**31, 2**32, 2**64, 1e308, -0.0, 5e-324, 1e20, "", "a", "../a", None, True, [], {}, [0], [[]]]
        values += [float("nan"), [1e308] * 3, [0] * 7, "x" * 100_000, "\x00\x1b[2J", "moving.obj", ".", "/dev/stdin"]
        tree[key] = rng.choice(values)  # type: ignore[index]
