"""Makes what all cases share: the inputs, and what undisturbed runs answer and write."""

import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import inputs
from questions import QUESTIONS, Question
from runs import Ended, changes, contents, run


@dataclass(frozen=True)
class Whole:
    """What an undisturbed run answers, writes and takes."""

    ended: Ended
    files: dict[str, bytes]  # by name


@dataclass(frozen=True)
class Setting:
    program: str
    seed: int
    worlds: Path  # a folder with the inputs of each world
    start_seconds: float  # a start and an end of the program
    wholes: dict[tuple[str, str], Whole]  # by world and question
    can_mount: bool  # whether a small file system can be made
    longest_end: float  # seconds from Ctrl-C to the end, beside a start of the program

    def whole(self, world: str, question: str) -> Whole:
        return self.wholes[world, question]

    def copy_world(self, world: str, folder: Path) -> dict[str, bytes]:
        """The files that are then in the folder."""
        shutil.copytree(self.worlds / world, folder, dirs_exist_ok=True)
        return contents(folder)


class Unusable(Exception):
    """The program does not answer the inputs that all cases start from."""


def make_setting(
    program: str, seed: int, folder: Path, longest_end: float, worlds: set[str], asked: set[tuple[str, str]]
) -> Setting:
    """Makes the inputs of these worlds, and answers these questions of them."""
    folder.mkdir()
    for name in worlds:
        (folder / name).mkdir()
        inputs.WORLDS[name](folder / name)
    starts = sorted(run([program, "--version"], folder).seconds for _ in range(7))
    wholes = {(world, name): whole_run(program, QUESTIONS[name], world, folder) for world, name in sorted(asked)}
    return Setting(program, seed, folder, starts[3], wholes, can_mount(), longest_end)


def whole_run(program: str, question: Question, world: str, folder: Path) -> Whole:
    """Runs twice: both runs have to write the same."""
    first, second = (one_run(program, question, world, folder) for _ in range(2))
    if changed := changes(first.files, second.files):
        raise Unusable(f"{question.name}: a second run wrote another {', '.join(changed)}")
    return second


def one_run(program: str, question: Question, world: str, folder: Path) -> Whole:
    copy = folder / "whole"
    shutil.copytree(folder / world, copy)
    before = contents(copy)
    names = question.own_names()
    make_folders(question, names, copy)
    ended = run(question.command(program, world, names), copy)
    if ended.status not in (0, 1):
        raise Unusable(f"{question.name}: status {ended.status}: {ended.err.decode('utf-8', 'replace')}")
    after = contents(copy)
    shutil.rmtree(copy)
    written = {name for name, _ in question.written(names)}
    if set(changes(before, after)) != written:
        raise Unusable(f"{question.name}: wrote {changes(before, after)} instead of {sorted(written)}")
    return Whole(ended, {name: after[name] for name in written})


def make_folders(question: Question, names: dict[str, str], folder: Path) -> None:
    """An output that consists of files in a folder needs the folder."""
    for output in question.outputs:
        if output.files != ("",):
            (folder / names[output.option]).mkdir(parents=True, exist_ok=True)


def can_mount() -> bool:
    """Whether this user may mount a file system of memory in a name space of his own."""
    script = "mount -t tmpfs -o size=4k none /mnt"
    try:
        return subprocess.run(["unshare", "-rm", "sh", "-c", script], capture_output=True).returncode == 0
    except FileNotFoundError:
        return False
