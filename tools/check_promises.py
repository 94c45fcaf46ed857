#!/usr/bin/env python3
"""Checks that what the documents name as proof is there.

Usage: check_promises.py [ROOT]. In every document, a `Suite.Test` has to be a test of the tree, a path in backticks or a
link to a file has to exist; and each promise of docs/promises.md has to name a test or link to a note. Prints one line
"FILE:LINE: WHY" a violation and exits with 1 if there is any.
"""

import pathlib
import re
import sys

TEST = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", re.MULTILINE)
NAMED_TEST = re.compile(r"`([A-Z]\w+)\.([A-Z]\w+|\*)`")
NAMED_FILE = re.compile(r"`((?:chasles|tests|tools|scenes|view|viewer|cli|bench|docs|cmake)/[\w./-]+\.\w+)`")
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
PROMISES = "docs/promises.md"
PROMISE = re.compile(r"^\d+\. \*\*")


def tests_of(root: pathlib.Path) -> set[tuple[str, str]]:
    return {found for file in root.glob("tests/**/*.cpp") for found in TEST.findall(file.read_text(encoding="utf-8"))}


def documents(root: pathlib.Path) -> list[pathlib.Path]:
    return sorted([*root.glob("*.md"), *root.glob("docs/**/*.md")])


def promises(text: str) -> list[tuple[int, str]]:
    """Line and text of each numbered promise, up to the next one or the next heading."""
    found: list[tuple[int, str]] = []
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if PROMISE.match(line):
            found.append((number, line))
            inside = True
        elif line.startswith("#"):
            inside = False
        elif inside:
            found[-1] = (found[-1][0], found[-1][1] + "\n" + line)
    return found


def violations(root: pathlib.Path) -> list[str]:
    tests = tests_of(root)
    suites = {suite for suite, _ in tests}
    result = []
    for document in documents(root):
        name = document.relative_to(root).as_posix()
        text = document.read_text(encoding="utf-8")
        for number, line in enumerate(text.splitlines(), 1):
            for suite, test in NAMED_TEST.findall(line):
                if (suite not in suites) if test == "*" else ((suite, test) not in tests):
                    result.append(f"{name}:{number}: there is no test {suite}.{test}")
            for file in NAMED_FILE.findall(line):
                if "NNNN" not in file and not any(root.glob(file)):
                    result.append(f"{name}:{number}: there is no file {file}")
            for link in LINK.findall(line):
                if not (document.parent / link).exists():
                    result.append(f"{name}:{number}: the link to {link} leads nowhere")
        if name == PROMISES:
            found = promises(text)
            if not found:
                result.append(f"{name}:1: promises nothing")
            for number, promise in found:
                if not NAMED_TEST.search(promise) and not LINK.search(promise):
                    result.append(f"{name}:{number}: a promise without a test or a note")
    return result


def main() -> int:
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = violations(root)
    print("\n".join(found) if found else "every test, file and link that the documents name is there")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
