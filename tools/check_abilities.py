#!/usr/bin/env python3
"""Checks docs/abilities.md: which face has which ability.

Usage: check_abilities.py ROOT [CHASLES]. Prints one line for each fault and exits with 1 if there is any. With the
program CHASLES, the commands and options of the table are looked for in its help, and each of its options in the table.

A cell of a row names what gives the ability, in backticks, or says "no (x)", where x is a reason below the tables. A name
exists in its face. Each name that a face offers stands in the table: the commands and options of the command line, the
names of the Python package, and the methods of the JavaScript package.
"""

import pathlib
import re
import subprocess
import sys

TABLE = "docs/abilities.md"
FACES = ["C++", "Python", "command line", "JavaScript", "page"]
SPAN = re.compile(r"`([^`]+)`")
NO = re.compile(r"no \(([a-z]+)\)")
REASON = re.compile(r"^- \(([a-z]+)\) \S")
WORD = re.compile(r"[A-Za-z_]\w*")
OPTION = re.compile(r"--[a-z][a-z-]*")
METHOD = re.compile(r"^  (?:readonly )?([a-z]\w*)[(:?]", re.MULTILINE)
CLASSES = ("Chasles", "Scene", "DraggedBody", "Workers", "Polyhedron")
NOT_ABILITIES = {"--help"}  # of every program


def words_of(root: pathlib.Path, *patterns: str) -> set[str]:
    texts = [path.read_text(encoding="utf-8") for pattern in patterns for path in sorted(root.glob(pattern))]
    return {word for text in texts for word in WORD.findall(text)}


def commands_of(chasles: str) -> dict[str, set[str]]:
    """The options of each command."""

    def help_of(*command: str) -> str:
        return subprocess.run([chasles, *command, "--help"], capture_output=True, text=True, check=True).stdout

    names = re.findall(r"^  ([a-z]+) ", help_of().split("Subcommands:")[-1], re.MULTILINE)
    return {name: set(OPTION.findall(help_of(name))) for name in names}


class Table:
    """The rows and reasons of the document, and what is wrong in them."""

    def __init__(self, text: str):
        self.faults: list[str] = []
        self.names: dict[str, set[str]] = {face: set() for face in FACES}
        self.cells: list[tuple[int, str, str]] = []  # line, face, name
        reasons = {found[1] for line in text.splitlines() if (found := REASON.match(line))}
        used: set[str] = set()
        for number, line in enumerate(text.splitlines(), 1):
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if not line.startswith("|") or set(line) <= set("|- ") or cells[1:] == FACES:
                continue
            if len(cells) != len(FACES) + 1:
                self.faults.append(f"{TABLE}:{number}: {len(cells) - 1} cells, and there are {len(FACES)} faces")
                continue
            used |= self.read_row(number, cells)
        self.faults += [f"{TABLE}: reason ({name}) is not given" for name in sorted(used - reasons)]
        self.faults += [f"{TABLE}: reason ({name}) is not used" for name in sorted(reasons - used)]

    def read_row(self, number: int, cells: list[str]) -> set[str]:
        used: set[str] = set()
        for face, cell in zip(FACES, cells[1:], strict=True):
            names = SPAN.findall(cell)
            self.cells += [(number, face, name) for name in names]
            self.names[face] |= set(names)
            reasons = set(NO.findall(cell))
            used |= reasons
            if not names and not reasons:
                self.faults.append(f"{TABLE}:{number}: {face}: neither a name nor a reason")
        return used

    def words(self, face: str) -> set[str]:
        return {word for name in self.names[face] for word in WORD.findall(name)}


def missing_names(table: Table, root: pathlib.Path, commands: dict[str, set[str]]) -> list[str]:
    """The names of the table that do not exist."""
    known = {
        "C++": words_of(root, "chasles/*/*.h", "chasles/*.h"),
        "Python": words_of(root, "python/chasles/*.py", "python/src/*.cpp", "python/src/*.h"),
        "JavaScript": words_of(root, "javascript/chasles/index.d.ts"),
    }
    faults = []
    for line, face, name in table.cells:
        if face in known:
            faults += [f"{TABLE}:{line}: {face}: {word} does not exist" for word in WORD.findall(name) if word not in known[face]]
        elif commands:
            command, options = name.removeprefix("chasles ").split(" ")[0], OPTION.findall(name)
            if command not in commands:
                faults.append(f"{TABLE}:{line}: {face}: there is no command {name!r}")
            else:
                faults += [f"{TABLE}:{line}: chasles {command} has no {option}" for option in options if option not in commands[command]]
    return faults


def python_names(root: pathlib.Path) -> set[str]:
    text = (root / "python/chasles/__init__.py").read_text(encoding="utf-8")
    listed = re.search(r"__all__ = \[(.*?)\]", text, re.DOTALL)
    return set(re.findall(r'"([A-Za-z]\w*)"', listed[1])) if listed else set()


def javascript_names(root: pathlib.Path) -> set[str]:
    text = (root / "javascript/chasles/index.d.ts").read_text(encoding="utf-8")
    names: set[str] = set()
    for name in CLASSES:
        body = re.search(rf"^export (?:declare class|interface) {name}\b.*?\{{(.*?)^\}}", text, re.DOTALL | re.MULTILINE)
        names |= set(METHOD.findall(body[1])) if body else {f"class {name}"}
    return names


def missing_rows(table: Table, root: pathlib.Path, commands: dict[str, set[str]]) -> list[str]:
    """What a face offers and the table lacks."""
    faults = [f"{TABLE}: Python: {name} is in no row" for name in sorted(python_names(root) - table.words("Python"))]
    faults += [f"{TABLE}: JavaScript: {name} is in no row" for name in sorted(javascript_names(root) - table.words("JavaScript"))]
    of_commands = table.names["command line"] | table.names["page"]
    named = {name.removeprefix("chasles ").split(" ")[0] for name in of_commands}
    options = {option for name in of_commands for option in OPTION.findall(name)} | NOT_ABILITIES
    for command, has in commands.items():
        if command not in named:
            faults.append(f"{TABLE}: chasles {command} is in no row")
        faults += [f"{TABLE}: {option} of chasles {command} is in no row" for option in sorted(has - options)]
    return faults


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    commands = commands_of(sys.argv[2]) if len(sys.argv) > 2 else {}
    table = Table((root / TABLE).read_text(encoding="utf-8"))
    faults = table.faults + missing_names(table, root, commands) + missing_rows(table, root, commands)
    print("\n".join(faults) if faults else f"{len(table.cells)} names in {TABLE}, all there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
