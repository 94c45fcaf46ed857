"""What the programs `chasles-cad` and `chasles-animation` have in common with the command line: exit status, errors, outputs."""

from __future__ import annotations

import argparse
import contextlib
import ctypes
import os
import pathlib
import signal
import sys
import tempfile
import threading
import time
import traceback
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NoReturn

from ._core import Cancelled, InvalidInput

FIRST_LINE, BETWEEN_LINES = 5.0, 10.0  # seconds
CLEAR, CONTACT, WRONG_INPUT, OUT_OF_TIME, INTERRUPTED = 0, 1, 2, 3, 130


class Parser(argparse.ArgumentParser):
    """Errors are one line, as of all commands."""

    def error(self, message: str) -> NoReturn:
        print(f"chasles: {self.prog.split()[-1]}: {message}", file=sys.stderr)
        raise SystemExit(WRONG_INPUT)


def run(parser: Parser, arguments: Sequence[str] | None, answer: Callable[[argparse.Namespace], int]) -> int:
    """Answers, and returns the exit status. Without arguments, those of the process are taken, which SIGTERM interrupts then."""
    if arguments is None:
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    options = parser.parse_args(arguments)
    if sys.stdout is None:
        print("chasles: cannot write the answer: standard output is closed", file=sys.stderr)
        return WRONG_INPUT
    try:
        with _signs_of_life():
            status = answer(options)
        sys.stdout.flush()
        return status
    except InvalidInput as error:
        print(f"chasles: {' '.join(str(error).split())}", file=sys.stderr)
        return WRONG_INPUT
    except OSError as error:  # of the output: nothing more can be written there
        print(f"chasles: cannot write the answer: {error.strerror}", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return WRONG_INPUT
    except Cancelled:
        print("chasles: the time was over; nothing is proven", file=sys.stderr)
        return OUT_OF_TIME
    except KeyboardInterrupt:
        print("chasles: interrupted", file=sys.stderr)
        return INTERRUPTED
    except MemoryError:
        print("chasles: not enough memory", file=sys.stderr)
        return WRONG_INPUT
    except Exception as error:  # Python would end with 1, which says contact
        traceback.print_exc()
        print(
            f"chasles: nothing is proven: a fault of this program: {type(error).__name__}: {error}; please report it",
            file=sys.stderr,
        )
        return WRONG_INPUT


@contextlib.contextmanager
def answers_alone() -> Iterator[None]:
    """What others print, as programs of users and libraries in C++, goes to standard error: standard output has the answer only."""
    sys.stdout.flush()
    if sys.stderr is None:  # closed: its number would be the next one
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    kept = os.dup(1)
    try:
        os.dup2(2, 1)
        with contextlib.redirect_stdout(sys.stderr):
            yield
    finally:
        with contextlib.suppress(OSError, TypeError, AttributeError):  # without a C library of the process
            ctypes.CDLL(None).fflush(None)
        os.dup2(kept, 1)
        os.close(kept)


@contextlib.contextmanager
def _signs_of_life() -> Iterator[None]:
    """A line on standard error after 5 seconds and then every 10, as all commands write where no bar is seen (cli/progress_bar.cpp)."""
    is_over, begin = threading.Event(), time.monotonic()

    def write() -> None:
        after = FIRST_LINE
        while not is_over.wait(begin + after - time.monotonic()):
            with contextlib.suppress(OSError, ValueError, AttributeError):  # there is no standard error
                sys.stderr.write(f"chasles: progress: at work for {after:.0f} s\n")
                sys.stderr.flush()
            after += BETWEEN_LINES

    thread = threading.Thread(target=write, daemon=True)
    thread.start()
    try:
        yield
    finally:
        is_over.set()
        thread.join()


def refuse_input(out: str | os.PathLike[str], inputs: Iterable[pathlib.Path]) -> None:
    """Raises InvalidInput if `out` is one of the inputs, also behind links."""
    for file in inputs:
        if os.path.exists(out) and file.exists() and os.path.samefile(out, file):
            raise InvalidInput(f"{out}: is an input; write to another file")


@contextlib.contextmanager
def beside(out: str | os.PathLike[str], inputs: Iterable[pathlib.Path]) -> Iterator[pathlib.Path]:
    """A new file beside `out`, which gets its name when it is complete. Refuses an `out` that is one of the inputs."""
    path = pathlib.Path(out)
    refuse_input(path, inputs)
    try:
        handle, name = tempfile.mkstemp(prefix=path.name[:80] + ".", suffix=".part", dir=path.parent)
        os.close(handle)
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None
    try:
        yield pathlib.Path(name)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(name, 0o666 & ~mask)
        os.replace(name, path)
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None
    finally:
        pathlib.Path(name).unlink(missing_ok=True)
