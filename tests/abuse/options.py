"""Each option that names a file is known to this program: a new one has to be abused, too. None takes an empty value."""

import re
from collections.abc import Iterable
from pathlib import Path

from cases import Case, Counts, Kind, Outcome
from questions import INPUT_OPTIONS, QUESTIONS
from runs import Ended, run
from setting import Setting

COMMAND = re.compile(r"^  ([a-z]+) ", re.MULTILINE)
# An option, and its type up to two blanks or the end of the line.
OPTION = re.compile(r"^  (?:-\w,)?(--[a-z-]+)((?: \S+)*)", re.MULTILINE)
FLAG = re.compile(r"^(| REQUIRED| (Excludes|Needs):.*)$")
FILE = re.compile(r"\b(FILE|FOLDER|PAGE|CSV|MESH)\b")


def cases(counts: Counts) -> Iterable[Case]:
    return [Case("options", "help", 0)]


def run_case(setting: Setting, case: Case, folder: Path) -> Outcome:
    outcome = Outcome(command=f"{setting.program} --help")
    commands = COMMAND.findall(help_of(setting, folder).split("Subcommands:")[-1])
    outcome.expect(bool(commands), "the help names no command")
    for command in commands:
        questions = [question for question in QUESTIONS.values() if question.arguments[0] == command]
        outcome.expect(bool(questions), f"no question asks {command}")
        known = INPUT_OPTIONS | {output.option for question in questions for output in question.outputs}
        for option, kind in OPTION.findall(help_of(setting, folder, command)):
            if not FLAG.match(kind):
                outcome.notes["options with a value"] += 1
                check_empty(outcome, run([setting.program, command, option, ""], folder), option)
            if FILE.search(kind):
                outcome.notes["options of files"] += 1
                outcome.expect(option in known, f"{command} {option} names a file; tests/abuse/questions.py lacks it")
    return outcome


def check_empty(outcome: Outcome, ended: Ended, option: str) -> None:
    refused = ended.status == 2 and len(ended.lines) == 1 and ended.lines[0].startswith(f"chasles: {option}: is empty")
    outcome.expect(refused, f"{option} '': status {ended.status}, {ended.lines}")


def help_of(setting: Setting, folder: Path, *command: str) -> str:
    return run([setting.program, *command, "--help"], folder).out.decode()


KIND = Kind("options", cases, run_case, needs=("options of files", "options with a value"))
