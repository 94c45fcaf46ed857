#!/usr/bin/env python3
"""Extracts the documentation of the public headers for another language.

Usage: docstrings.py OUT HEADER... writes one C++ initialiser {"Scope.name", "text"} for each documented declaration of
the headers. The text is the `///` comment above the declaration or the `///<` comment after it. Names have a dot instead
of `::`. For overloads, the first documented one counts.
"""

import pathlib
import re
import sys
import textwrap

WIDTH = 84

SCOPE = re.compile(r"^\s*(?:enum\s+)?(?:struct|class)\s+(?:(?:\[\[\w+\]\]|[A-Z]+_EXPORT)\s+)*(\w+)[^;]*\{")
ONE_LINE_ENUM = re.compile(r"^\s*enum\s+class\s+(\w+)[^{]*\{[^}]*\};")
ABOVE = re.compile(r"^\s*///(?!<) ?(.*)$")
BEHIND = re.compile(r"^(.*?)///<\s?(.*)$")
FUNCTION = re.compile(r"(\w+)\s*\(")
FIELD = re.compile(r"(\w+)\s*(?:=[^=].*|\{.*\}|,)?\s*[;,]?\s*$")


def declared_name(code: str) -> str:
    """The name that a line of a declaration introduces; empty if the line has no name."""
    code = code.split("//")[0].strip()
    head = code.split("=")[0] if "(" not in code.split("=")[0] else code
    match = FUNCTION.search(head) or FIELD.search(head)
    return match.group(1) if match and match.group(1) not in ("public", "private") else ""


def text_of(lines: list[str]) -> str:
    """The paragraphs, wrapped again. Indented lines stay unchanged."""
    paragraphs: list[str] = []
    open_paragraph = False
    for line in lines:
        if not line.strip() or line.startswith("    "):
            paragraphs.append(line.rstrip())
            open_paragraph = False
        elif open_paragraph:
            paragraphs[-1] += " " + line.strip()
        else:
            paragraphs.append(line.strip())
            open_paragraph = True
    text = "\n".join(wrapped(paragraph) for paragraph in paragraphs)
    return text.strip("\n").replace("::", ".")


def wrapped(paragraph: str) -> str:
    return paragraph if paragraph.startswith("    ") else textwrap.fill(paragraph, WIDTH)


class Reader:
    """Collects the documented names of one header, line by line."""

    def __init__(self, found: dict[str, str]):
        self.found = found
        self.scopes: list[tuple[str, int]] = []  # name, and the depth of braces before it
        self.depth = 0
        self.above: list[str] = []
        self.behind = ""  # the name whose trailing comment may continue on the next line

    def keep(self, name: str, lines: list[str]) -> str:
        full = ".".join([scope for scope, _ in self.scopes] + [name])
        if name and lines:
            self.found.setdefault(full, text_of(lines))
        return full

    def read(self, line: str) -> None:
        above, behind = ABOVE.match(line), BEHIND.match(line)
        if above:
            self.above.append(above.group(1))
        elif behind:
            self.read_behind(*behind.groups())
        else:
            self.read_code(line)

    def read_behind(self, code: str, text: str) -> None:
        if code.strip():
            self.behind = self.keep(declared_name(code), [*self.above, text])
            self.count_braces(code)
        elif self.behind in self.found:
            self.found[self.behind] = text_of([self.found[self.behind], text])
        self.above = []

    def read_code(self, line: str) -> None:
        scope = ONE_LINE_ENUM.match(line) or SCOPE.match(line)
        if scope:
            self.keep(scope.group(1), self.above)
            if not ONE_LINE_ENUM.match(line):
                self.scopes.append((scope.group(1), self.depth))
        elif line.strip():
            self.keep(declared_name(line), self.above)
        self.above = []
        self.behind = ""
        self.count_braces(line)

    def count_braces(self, code: str) -> None:
        code = code.split("//")[0]
        self.depth += code.count("{") - code.count("}")
        while self.scopes and self.depth <= self.scopes[-1][1]:
            self.scopes.pop()


def docstrings(headers: list[str]) -> dict[str, str]:
    """The text of each name. `headers` are the contents of the headers."""
    found: dict[str, str] = {}
    for header in headers:
        reader = Reader(found)
        for line in header.splitlines():
            reader.read(line)
    return found


def main() -> int:
    out, *headers = map(pathlib.Path, sys.argv[1:])
    found = docstrings([header.read_text(encoding="utf-8") for header in headers])
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("".join(f'{{"{name}", R"docs({text})docs"}},\n' for name, text in sorted(found.items())), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
