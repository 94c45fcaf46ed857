#!/usr/bin/env python3
"""Runs the commands of the documents, and compares what they print with what the documents show.

Usage: commands.py CHASLES FILES DOCUMENT... Each document is one session, in a copy of the folder FILES. A line
"    $ chasles ..." is run; the lines up to the next command or the end of the block are what it prints, except if there are
none. "    $ cat FILE" writes a file that is not there, and shows one that is. Numbers may differ in their last digits, and
those of the work in all. A line "..." stands for any lines.
"""

import math
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

COMMAND = re.compile(r"^( {4,})\$ (.*)$")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
TOLERANCE = 1e-9


def sessions(document: pathlib.Path) -> list[tuple[int, str, list[str]]]:
    """Line, command and shown lines of each command."""
    found: list[tuple[int, str, list[str]]] = []
    is_open = False
    margin = ""
    for number, line in enumerate(document.read_text(encoding="utf-8").splitlines(), 1):
        if command := COMMAND.match(line):
            margin = command[1]
            found.append((number, command[2], []))
            is_open = True
        elif is_open and line.startswith(margin):
            found[-1][2].append(line.removeprefix(margin))
        else:
            is_open = False
    return found


def are_alike(shown: str, printed: str) -> bool:
    if NUMBER.sub("#", shown.rstrip()) != NUMBER.sub("#", printed.rstrip()):
        return False
    pairs = zip(NUMBER.findall(shown), NUMBER.findall(printed), strict=True)
    is_work = shown.startswith("  work ")
    return is_work or all(math.isclose(float(a), float(b), rel_tol=TOLERANCE, abs_tol=TOLERANCE) for a, b in pairs)


def is_shown(shown: list[str], printed: list[str]) -> bool:
    """Whether the lines agree, each "..." standing for any number of lines."""
    if not shown or not printed:
        return shown == printed or shown == ["..."]
    if shown[0].strip() == "...":
        return any(is_shown(shown[1:], printed[start:]) for start in range(len(printed) + 1))
    return are_alike(shown[0], printed[0]) and is_shown(shown[1:], printed[1:])


def fault(words: list[str], shown: list[str], folder: pathlib.Path) -> str:
    """Runs a command; says what it prints if this is not what is shown."""
    if words[0] == "cat" and not (folder / words[1]).exists():
        (folder / words[1]).write_text("\n".join(shown) + "\n", encoding="utf-8")
        return ""
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=60)
    printed = [line for line in (done.stdout + done.stderr).splitlines() if not line.startswith("chasles: progress: ")]
    if not shown or is_shown(shown, printed):
        return ""
    return "\n".join(["shown:", *shown, "printed:", *printed])


def faults(chasles: str, files: pathlib.Path, document: pathlib.Path) -> list[str]:
    commands = sessions(document)
    result = [] if any(command.startswith("chasles ") for _, command, _ in commands) else [f"{document}: has no command"]
    with tempfile.TemporaryDirectory() as name:
        folder = shutil.copytree(files.parent, pathlib.Path(name) / "copy") / files.name
        for number, command, shown in commands:
            words = [chasles if word == "chasles" else word for word in shlex.split(command)]
            if why := fault(words, shown, folder):
                result.append(f"{document.name}:{number}: {command}\n{why}")
    return result


def main() -> int:
    chasles, files, *documents = sys.argv[1:]
    found = [why for document in documents for why in faults(chasles, pathlib.Path(files), pathlib.Path(document))]
    print("\n\n".join(found) if found else "every command prints what the documents show")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
