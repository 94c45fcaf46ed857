#!/usr/bin/env python3
"""Checks the lists of commands in the documents against the program.

Usage: check_commands.py ROOT CHASLES. Prints one line for each fault and exits with 1 if there is any. Each command of the help
stands in the synopsis of docs/command-line.md. The lists of commands with a limit of time, of commands
that write files, and of commands that warn of units that differ name the commands whose help has such options or arguments.
"""

import pathlib
import re
import subprocess
import sys

COMMANDS = "docs/command-line.md"
FILES = "docs/files.md"
OUTPUTS = ("--out", "--page", "--csv", "--plot", "--save")
BODIES = ("MOVING", "SCENE")  # arguments: two bodies, or more
NAME = re.compile(r"`([a-z]+)")

Helps = dict[str, str]


def helps_of(chasles: str) -> Helps:
    """The help of each command."""

    def help_of(*command: str) -> str:
        return subprocess.run([chasles, *command, "--help"], capture_output=True, text=True, check=True).stdout

    names = re.findall(r"^  ([a-z]+) ", help_of().split("Subcommands:")[-1], re.MULTILINE)
    return {name: help_of(name) for name in names}


def commands_with(helps: Helps, words: tuple[str, ...]) -> set[str]:
    """The commands whose help has a line that begins with one of these options or arguments."""
    line = re.compile(rf"^\s+(?:{'|'.join(map(re.escape, words))})\b", re.MULTILINE)
    return {name for name, text in helps.items() if line.search(text)}


def list_faults(file: str, text: str, pattern: str, needed: set[str]) -> list[str]:
    """What is missing in the list of commands that the pattern finds."""
    found = re.search(pattern, text, re.DOTALL)
    if not found:
        return [f"{file}: there is no list {pattern!r}"]
    return [f"{file}: {found[0].split('(')[0].strip()!r} leaves out {name}" for name in sorted(needed - set(NAME.findall(found[1])))]


def faults_of(commands: str, files: str, helps: Helps) -> list[str]:
    """`commands` and `files` are the texts of both documents."""
    synopsis = set(re.findall(r"^    chasles ([a-z]+) ", commands.split("\n## ")[0], re.MULTILINE))
    faults = [f"{COMMANDS}: the synopsis leaves out {name}" for name in helps if name not in synopsis]
    of_acm = {"acm"}  # has a limit in any case, as the text says
    of_plain = {"verify"}  # reads OBJ and STL, which state no unit
    faults += list_faults(COMMANDS, commands, r"\*\*`--seconds T`\*\* \(([^)]*)\)", commands_with(helps, ("--seconds",)) - of_acm)
    faults += list_faults(COMMANDS, commands, r"\*\*Files that commands write\*\* \(([^)]*)\)", commands_with(helps, OUTPUTS))
    faults += list_faults(FILES, files, r"((?:`[a-z]+`(?:, | and ))+`[a-z]+`) print a warning where files", commands_with(helps, BODIES) - of_plain)
    return faults


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    helps = helps_of(sys.argv[2])
    faults = faults_of(*((root / file).read_text(encoding="utf-8") for file in (COMMANDS, FILES)), helps)
    print("\n".join(faults) if faults else f"{len(helps)} commands, all in {COMMANDS} and {FILES}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
