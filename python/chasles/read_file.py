"""Whole files, read once, by the rules of the command line: docs/decisions/0072-input-that-need-not-end.md."""

from __future__ import annotations

import contextlib
import os
import pathlib
import select
import stat
import tempfile
from collections.abc import Iterator

from ._core import InvalidInput

MOST_FROM_PIPE = 256 << 20  # bytes
LONGEST_WAIT = 30  # seconds, for the first bytes of a pipe


def read_file(path: pathlib.Path) -> bytes:
    """The bytes of a file, or of a pipe that ends within 256 MiB.

    Raises InvalidInput if it is empty, for devices, and for a pipe that stays silent for 30 seconds; OSError and ValueError where the
    system does not read it.
    """
    mode = path.stat().st_mode
    if stat.S_ISCHR(mode) or stat.S_ISBLK(mode):
        raise InvalidInput(f"{path}: is a device, which need not end; give a file or a pipe")
    data = _from_pipe(path) if stat.S_ISFIFO(mode) else path.read_bytes()
    if not data:
        raise InvalidInput(f"{path}: is empty")
    return data


@contextlib.contextmanager
def as_regular_file(path: pathlib.Path) -> Iterator[pathlib.Path]:
    """The file itself; the bytes of a pipe in a file of their own, for readers that take a name."""
    if path.is_file():
        yield path
        return
    data = read_file(path)
    with tempfile.TemporaryDirectory(prefix="chasles-") as folder:
        copy = pathlib.Path(folder, "from_pipe" + path.suffix)
        copy.write_bytes(data)
        yield copy


def _from_pipe(path: pathlib.Path) -> bytes:
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)  # without a writer, the ordinary way would wait for ever
    with open(descriptor, "rb") as pipe:
        wait = select.poll()
        wait.register(descriptor, select.POLLIN)
        if not wait.poll(1000 * LONGEST_WAIT):
            raise InvalidInput(f"{path}: is a pipe into which nothing was written for {LONGEST_WAIT} seconds")
        os.set_blocking(descriptor, True)
        data = pipe.read(MOST_FROM_PIPE + 1)
    if len(data) > MOST_FROM_PIPE:
        raise InvalidInput(
            f"{path}: is a pipe that does not end within {MOST_FROM_PIPE >> 20} MiB; write it to a file first"
        )
    return data
