"""Closed streams, full ones, and pipes whose reader has gone: no crash, and no text gets into another file."""

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import product
from pathlib import Path

from cases import Case, Counts, Kind, Outcome
from questions import QUESTIONS
from runs import Ended, changes, contents, in_shell, run
from setting import Setting, make_folders

OPEN, CLOSED, FULL, LEFT = "open", "closed", "full", "left by its reader"
WAYS = list(product((OPEN, CLOSED), (OPEN, CLOSED, FULL, LEFT), (OPEN, CLOSED, FULL, LEFT)))[1:]


def cases(counts: Counts) -> Iterable[Case]:
    return (Case("streams", name, number) for name in QUESTIONS for number, way in enumerate(WAYS) if is_chosen(name, way))


def is_chosen(name: str, way: tuple[str, str, str]) -> bool:
    """`demo` takes seconds: one stream at a time has to do."""
    return name != "demo" or sum(state != OPEN for state in way) == 1


@contextmanager
def abandoned_pipe() -> Iterator[int]:
    reader, writer = os.pipe()
    os.close(reader)
    try:
        yield writer
    finally:
        os.close(writer)


def run_with_streams(command: list[str], way: tuple[str, str, str], folder: Path) -> Ended:
    redirection = ""
    for stream, (sign, state) in enumerate(zip("<>>", way)):
        if state == CLOSED:
            redirection += f" {stream}{sign}&-"
        elif state == FULL:
            redirection += f" {stream}>/dev/full"
    streams = [name for name, state in zip(("stdin", "stdout", "stderr"), way) if state == LEFT]
    with abandoned_pipe() as writer:
        return run(in_shell(command, redirection), folder, **{name: writer for name in streams})


def run_case(setting: Setting, case: Case, folder: Path) -> Outcome:
    way = WAYS[case.number]
    outcome = Outcome()
    question = QUESTIONS[case.name]
    names = question.own_names()
    make_folders(question, names, folder)
    before = setting.copy_world("small", folder)
    command = question.command(setting.program, "small", names)
    outcome.command = f"(stdin {way[0]}, stdout {way[1]}, stderr {way[2]}) " + " ".join(command)
    ended = run_with_streams(command, way, folder)
    outcome.expect(not ended.crash, ended.crash)
    whole = setting.whole("small", question.name)
    outcome.notes["stdout " + way[1]] += 1
    if way[1] == OPEN:
        outcome.expect(ended.status == whole.ended.status, f"status {ended.status} instead of {whole.ended.status}")
        outcome.expect(ended.out == whole.ended.out or case.name == "demo", "another answer")  # demo prints times
    else:
        outcome.expect(ended.status == 2, f"status {ended.status} instead of 2")
        if way[2] == OPEN:
            is_named = len(ended.errors) == 1 and "standard output" in ended.errors[0]
            outcome.expect(is_named, f"no error line names standard output: {ended.errors}")
    check_files(outcome, before, contents(folder), whole.files)
    return outcome


def check_files(outcome: Outcome, before: dict[str, bytes], after: dict[str, bytes], new: dict[str, bytes]) -> None:
    for name in changes(before, after):
        outcome.expect(after.get(name) == new.get(name, b"no output"), f"{name} has other content than without abuse")


NEEDS = tuple("stdout " + state for state in (CLOSED, FULL, LEFT))
KIND = Kind("streams", cases, run_case, ("small",), lambda case: [("small", case.name)], needs=NEEDS)
