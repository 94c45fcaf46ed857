"""Runs the program and measures its time and memory."""

import os
import resource
import signal
import subprocess
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

LONGEST = 30.0  # seconds until a run is given up
GIVEN_UP = -1000  # the status of such a run
SIGNALS = {number.value: number.name for number in signal.Signals}


@dataclass(frozen=True)
class Ended:
    """A run that has ended. A negative status is the number of a signal."""

    status: int
    out: bytes
    err: bytes
    seconds: float
    cpu_seconds: float
    memory: int  # MiB, the most at one time

    @property
    def lines(self) -> list[str]:
        return self.err.decode("utf-8", "replace").splitlines()

    @property
    def errors(self) -> list[str]:
        """The lines on standard error that are no warnings and tell no progress."""
        return [line for line in self.lines if not line.startswith(("chasles: warning: ", "chasles: progress: "))]

    @property
    def crash(self) -> str:
        """How it ended by a signal or not at all; empty otherwise."""
        if self.status == GIVEN_UP:
            return f"did not end within {LONGEST:.0f} seconds"
        # a shell ends with 128 and the number of the signal that has ended its command
        number = -self.status if self.status < 0 else self.status - 128
        return f"ended by {SIGNALS[number]}" if number in SIGNALS and number != signal.SIGINT else ""


class Running:
    """A started run. Its output goes to files in memory, so no pipe can be full."""

    def __init__(self, command: Sequence[str], folder: Path, **streams: object):
        self.files = [open(os.memfd_create(name), "w+b") for name in ("out", "err")]
        self.begun = time.monotonic()
        given = {"stdin": subprocess.DEVNULL, "stdout": self.files[0], "stderr": self.files[1], **streams}
        self.process = subprocess.Popen(command, cwd=folder, **given)  # type: ignore[call-overload]

    def send(self, number: int) -> None:
        os.kill(self.process.pid, number)  # it is not reaped before `wait`

    def has_ended(self) -> bool:
        return os.waitid(os.P_PID, self.process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None

    def wait(self) -> Ended:
        given_up = []

        def give_up(number: int, frame: object) -> None:
            given_up.append(number)
            self.send(signal.SIGKILL)

        signal.signal(signal.SIGALRM, give_up)
        signal.setitimer(signal.ITIMER_REAL, LONGEST)
        # the timer is stopped before the process is reaped, so that the number cannot be another process's
        os.waitid(os.P_PID, self.process.pid, os.WEXITED | os.WNOWAIT)
        seconds = time.monotonic() - self.begun
        signal.setitimer(signal.ITIMER_REAL, 0)
        _, status, usage = os.wait4(self.process.pid, 0)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        return Ended(
            GIVEN_UP if given_up else self.process.returncode,
            *self._read(),
            seconds,
            usage.ru_utime + usage.ru_stime,
            usage.ru_maxrss // 1024,
        )

    def _read(self) -> tuple[bytes, bytes]:
        texts = []
        for file in self.files:
            file.seek(0)
            texts.append(file.read())
            file.close()
        return texts[0], texts[1]


def run(command: Sequence[str], folder: Path, **streams: object) -> Ended:
    return Running(command, folder, **streams).wait()


@contextmanager
def limited(what: int, most: int) -> Iterator[None]:
    """What is started meanwhile has the limit. It is a soft one, so it can be lifted again."""
    soft, hard = resource.getrlimit(what)
    resource.setrlimit(what, (most, hard))
    try:
        yield
    finally:
        resource.setrlimit(what, (soft, hard))


def in_shell(command: Sequence[str], redirection: str) -> list[str]:
    """The command with its streams as the shell's redirection says, like `>&-`."""
    return ["sh", "-c", f'exec "$@" {redirection}', "sh", *command]


def contents(folder: Path) -> dict[str, bytes]:
    """All files of a folder by name, also behind links; a link to nothing is left out."""
    files = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def changes(before: dict[str, bytes], after: dict[str, bytes]) -> list[str]:
    """The names of files that are new, gone or not the same."""
    return sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
