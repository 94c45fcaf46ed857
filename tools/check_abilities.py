#!/usr/bin/env python3
"""Checks docs/abilities.md: each name exists in its face, and each empty cell gives one of the reasons below the table.

Usage: check_abilities.py [ROOT]. Prints one line "FILE:LINE: WHY" for each violation and exits with 1 if there is any.
"""

import pathlib
import re
import sys

FILE = "docs/abilities.md"
FACES = {  # the sources in which the names of a column have to be
    "C++": ["chasles/**/*.h"],
    "Python": ["python/chasles/*.py", "python/src/*.cpp"],
    "command line": ["cli/*.cpp", "view/answer_json.cpp"],
    "JavaScript": ["javascript/chasles/index.d.ts"],
}
REASON = re.compile(r"^(\d+)\. ", re.MULTILINE)


def texts(root: pathlib.Path) -> dict[str, str]:
    """All sources of each face."""
    return {
        face: "\n".join(path.read_text(encoding="utf-8") for pattern in patterns for path in sorted(root.glob(pattern)))
        for face, patterns in FACES.items()
    }


def why_not(cell: str, source: str, reasons: set[str]) -> str | None:
    """What is wrong with a cell."""
    if match := re.fullmatch(r"`\"?([\w-]+)\"?`", cell):
        found = re.search(rf"(?<![\w-]){re.escape(match[1])}(?![\w-])", source)
        return None if found else f"{cell} does not exist there"
    if match := re.fullmatch(r"\((\d+)\)", cell):
        return None if match[1] in reasons else f"there is no reason {match[1]}"
    return f"{cell!r} is neither a name nor a reason"


def violations(root: pathlib.Path) -> list[str]:
    text = (root / FILE).read_text(encoding="utf-8")
    reasons, sources = set(REASON.findall(text)), texts(root)
    found: list[str] = []
    used: set[str] = set()
    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith("| ") or line.startswith("| ability "):
            continue
        cells = [cell.strip() for cell in line.strip("|").split("|")][1:]
        if len(cells) != len(FACES):
            found.append(f"{FILE}:{number}: has {len(cells)} faces instead of {len(FACES)}")
            continue
        used |= {cell.strip("()") for cell in cells}
        for (face, source), cell in zip(sources.items(), cells, strict=True):
            if why := why_not(cell, source, reasons):
                found.append(f"{FILE}:{number}: {face}: {why}")
    found += [f"{FILE}:1: reason {reason} has no cell" for reason in sorted(reasons - used)]
    return found


if __name__ == "__main__":
    faults = violations(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
    print("\n".join(faults), end="\n" if faults else "")
    sys.exit(1 if faults else 0)
