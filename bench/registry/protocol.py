"""The child's side of the line protocols of bench/process_peer.h and bench/translations_bench.cpp."""

import os
import sys
import time
from collections.abc import Callable


def serve(handlers: dict[str, Callable[[str], str]]) -> None:
    """Answers each input line by the handler named by its first word, until the input ends."""
    replies = os.fdopen(os.dup(1), "w", buffering=1, encoding="ascii", errors="replace")
    os.dup2(2, 1)  # keeps output of the library out of the replies
    print("ready", file=replies)
    for line in sys.stdin:
        word, _, rest = line.rstrip("\n").partition(" ")
        try:
            reply = handlers[word](rest)
        except Exception as error:  # every failure is reported to the parent
            reply = "failed " + f"{type(error).__name__}: {error}".splitlines()[0]
        print(reply, file=replies)


def absent(why: str) -> None:
    print("absent", why.splitlines()[0], flush=True)


def timed(work: Callable):
    """The result of `work` and its duration in seconds."""
    start = time.perf_counter()
    answer = work()
    return answer, time.perf_counter() - start


def answer(touches: bool, when: float | None, seconds: float) -> str:
    return f"answer {int(touches)} {'-' if when is None else repr(float(when))} {seconds!r}"
