"""An output that is an input, or another output, under any name: refused with one line, and nothing changes."""

import os
from collections.abc import Callable, Iterable
from pathlib import Path

from cases import Case, Counts, Kind, Outcome
from kills import PRECIOUS
from questions import QUESTIONS, WRITERS, Question
from runs import changes, contents, in_shell, run
from setting import Setting


def linked(folder: Path, name: str) -> str:
    (folder / "link").symlink_to(name)
    return "link"


def twice_linked(folder: Path, name: str) -> str:
    (folder / "link").symlink_to(folder / name)
    (folder / "second link").symlink_to("link")
    return "second link"


def other_name(folder: Path, name: str) -> str:
    os.link(folder / name, folder / "other name")
    return "other name"


def through_folder(folder: Path, name: str) -> str:
    (folder / "folder").mkdir()
    return "folder/../" + name


def through_link(folder: Path, name: str) -> str:
    (folder / "here").symlink_to(".")
    return "here/" + name


def part_is_link(folder: Path, name: str) -> str:
    (folder / "out.part").symlink_to(name)
    return "out"


def part_is_other_name(folder: Path, name: str) -> str:
    os.link(folder / name, folder / "out.part")
    return "out"


# How an output may have the name of a file.
FORMS: dict[str, Callable[[Path, str], str]] = {
    "same": lambda folder, name: name,
    "here": lambda folder, name: "./" + name,
    "folder": through_folder,
    "absolute": lambda folder, name: str(folder / name),
    "link": linked,
    "twice-linked": twice_linked,
    "other-name": other_name,
    "linked-folder": through_link,
    "part-is-link": part_is_link,
    "part-is-other-name": part_is_other_name,
}
STREAM = "standard-output"  # the shell appends standard output to the file, and the output is /dev/stdout


def files_of(question: Question) -> list[str]:
    """The options that name a file, not a folder."""
    return [output.option for output in question.outputs if output.files == ("",)]


def as_input(question: Question) -> list[tuple[str, str, str]]:
    """(option, input, form)"""
    options = files_of(question)
    return [(option, read, form) for option in options for read in question.reads for form in [*FORMS, STREAM]]


# How two outputs may have one name. Two names of one file (hard links) are two outputs: each replaces its own name.
PAIR_FORMS: dict[str, Callable[[Path], tuple[str, str]]] = {
    "same": lambda folder: ("same", "same"),
    "here": lambda folder: ("same", "./same"),
    "absolute": lambda folder: (str(folder / "same"), "same"),
    "folder": lambda folder: ("same", through_folder(folder, "same")),
    "linked-folder": lambda folder: (through_link(folder, "same"), "same"),
    "link": lambda folder: ("same", linked(folder, "same")),
    "part": lambda folder: ("same", "same.part"),
    "is-part": lambda folder: ("same.part", "same"),
}


def as_output(question: Question) -> list[tuple[str, str, str, bool]]:
    """(option, other option, form, whether the file exists)"""
    options = files_of(question)
    pairs = [(a, b) for i, a in enumerate(options) for b in options[i + 1 :]]
    return [(*pair, form, is_there) for pair in pairs for form in PAIR_FORMS for is_there in (True, False)]


def cases(counts: Counts) -> Iterable[Case]:
    for name in WRITERS:
        question = QUESTIONS[name]
        yield from (Case("names", name, number) for number in range(len(as_input(question)) + len(as_output(question))))


def run_case(setting: Setting, case: Case, folder: Path) -> Outcome:
    question = QUESTIONS[case.name]
    setting.copy_world("small", folder)
    inputs = as_input(question)
    if case.number < len(inputs):
        return replace_input(setting, question, *inputs[case.number], folder)
    return same_output(setting, question, *as_output(question)[case.number - len(inputs)], folder)


def replace_input(setting: Setting, question: Question, option: str, read: str, form: str, folder: Path) -> Outcome:
    outcome = Outcome()
    name = "/dev/stdout" if form == STREAM else FORMS[form](folder, read)
    command = question.command(setting.program, "small", {**question.own_names(), option: name})
    outcome.command = " ".join(command) + (f" >> {read}" if form == STREAM else "")
    before = contents(folder)
    ended = run(in_shell(command, f"1>>{read}") if form == STREAM else command, folder)
    outcome.notes["an output is an input"] += 1
    check_refused(outcome, ended.status, ended.errors, name)
    outcome.expect(contents(folder) == before, f"changed {changes(before, contents(folder))}")
    return outcome


def same_output(
    setting: Setting, question: Question, option: str, other: str, form: str, is_there: bool, folder: Path
) -> Outcome:
    outcome = Outcome()
    if is_there:
        (folder / "same").write_bytes(PRECIOUS)
    first, second = PAIR_FORMS[form](folder)
    command = question.command(setting.program, "small", {**question.own_names(), option: first, other: second})
    outcome.command = " ".join(command)
    before = contents(folder)
    ended = run(command, folder)
    outcome.notes["an output is another output"] += 1
    check_refused(outcome, ended.status, ended.errors, second)
    outcome.expect(contents(folder) == before, f"changed {changes(before, contents(folder))}")
    return outcome


def check_refused(outcome: Outcome, status: int, errors: list[str], name: str) -> None:
    is_told = status == 2 and len(errors) == 1 and Path(name).name in errors[0]
    outcome.expect(is_told, f"not refused with one line that names the file: status {status}, {errors}")


KIND = Kind("names", cases, run_case, ("small",), needs=("an output is an input", "an output is another output"))
