#!/usr/bin/env python3
"""Checks that functions, parameter lists and files of the library stay small, and that comments explain them.

Usage: check_sizes.py [ROOT]. Prints one line "FILE:LINE: WHY" a violation, and the figures, and exits with 1 if there is any.
The source is laid out by clang-format, so that counting braces finds every function. A function counts from the line of
its head (without `template <...>`) to its closing brace; lambdas are a part of the function around them. The share of
comments is that of the lines with a comment among the lines that are not empty.
"""

import pathlib
import re
import sys
from dataclasses import dataclass

LONGEST_FUNCTION = 50  # lines
MOST_PARAMETERS = 6
SHORT_FUNCTION = 18  # lines; SHORT_SHARE of all functions are shorter
SHORT_SHARE = 0.9
LONGEST_FILE = 350  # lines
COMMENT_SHARE = 0.15

# Breaks a limit today: "FILE", "FILE: FUNCTION", or one of the shares. The list only gets shorter.
EXCEPTIONS: set[str] = set()

SUFFIXES = [".h", ".cpp", ".inl"]

COMMENT_OR_TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'', re.S)
PREPROCESSOR = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.M)
SCOPE = re.compile(r"(?:inline\s+)?namespace\b|extern\s*$|(?:class|struct|union|enum)\b")
HEAD_NOISE = re.compile(r"\b(?:public|private|protected)\s*:(?!:)")
NO_NAME = {"noexcept", "requires", "decltype", "alignas", "explicit", "__attribute__", "if", "while", "for", "switch", "catch"}
CLOSING = {"(": ")", "[": "]", "{": "}"}


@dataclass
class Function:
    file: str
    name: str
    line: int
    lines: int
    parameters: int


def blanked(match: re.Match[str]) -> str:
    """Blanks of the same length and the same line breaks."""
    return re.sub(r"[^\n]", " ", match.group(0))


def plain_code(text: str) -> str:
    """The text with comments, literals and preprocessor lines blanked out, each character at its place."""
    return PREPROCESSOR.sub(blanked, COMMENT_OR_TEXT.sub(blanked, text))


def end_of_group(code: str, begin: int) -> int:
    """The position behind the bracket that closes the one at `begin`."""
    depth = 0
    for at in range(begin, len(code)):
        if code[at] in "([{":
            depth += 1
        elif code[at] in ")]}":
            depth -= 1
            if depth == 0:
                return at + 1
    return len(code)


def skip_template(head: str) -> int:
    """How much of a head is `template <...>` and blanks."""
    at = len(head) - len(head.lstrip())
    while head.startswith("template", at):
        depth = 0
        for at in range(head.index("<", at), len(head)):
            depth += (head[at] == "<") - (head[at] == ">" and head[at - 1] != "-")
            if depth == 0:
                break
        rest = head[at + 1 :]
        at += 1 + len(rest) - len(rest.lstrip())
    return at


def parameter_count(inside: str) -> int:
    """Of the text between the brackets of a parameter list."""
    depth, commas = 0, 0
    for before, letter in zip(" " + inside, inside):
        depth += (letter in "([{<") - (letter in ")]}" or (letter == ">" and before != "-"))
        commas += letter == "," and depth == 0
    return commas + 1 if inside.strip() not in ("", "void") else 0


def parameter_list(head: str) -> re.Match[str] | None:
    """The name in front of the parameter list and its opening bracket; none if the head is that of no function."""
    if head.rstrip().endswith("="):
        return None
    at = 0
    pattern = re.compile(r"(operator\s*(?:\(\)|\[\]|[^\s\w(]+|\s[\w:<>*& ]+)|~?\w+(?:<[^()]*>)?)\s*\(")
    while match := pattern.search(head, at):
        if match.group(1) not in NO_NAME and "=" not in head[: match.start()].replace("==", ""):
            return match
        at = end_of_group(head, match.end() - 1)
    return None


def is_member_initialiser(head: str) -> bool:
    """Whether a brace after this head begins the value of a member in a constructor's list, not the body."""
    return bool(re.search(r"\)\s*(?:noexcept\s*)?:(?!:)", head)) and bool(re.search(r"[\w>]\s*$", head))


def functions_of(file: str, text: str) -> list[Function]:
    code = plain_code(text)
    found: list[Function] = []
    begin = at = 0  # `begin`: where the declaration starts that `at` is in
    while at < len(code):
        if code[at] in "([":
            at = end_of_group(code, at)
            continue
        if code[at] in ";}":
            begin = at + 1
        elif code[at] == "{":
            access = [match.end() for match in HEAD_NOISE.finditer(code, begin, at)]
            begin = access[-1] if access else begin
            begin += skip_template(code[begin:at])
            head = code[begin:at]
            list_ = parameter_list(head)
            if SCOPE.match(head) and not re.search(r"\)\s*(?:const|noexcept|\s)*$", head):
                begin = at + 1
            elif list_ is None or is_member_initialiser(head):
                at = end_of_group(code, at)
                continue
            else:
                end = end_of_group(code, at)
                first = code.count("\n", 0, begin) + 1
                inside = head[list_.end() : end_of_group(head, list_.end() - 1) - 1]
                name = list_.group(1).strip()
                found.append(Function(file, name, first, code.count("\n", 0, end) + 2 - first, parameter_count(inside)))
                begin = at = end
                continue
        at += 1
    return found


def comment_lines(text: str) -> tuple[int, int]:
    """Lines with a comment, and lines that are not empty."""
    without_text = COMMENT_OR_TEXT.sub(lambda match: match.group(0) if match.group(0).startswith("/") else '""', text)
    lines = [line for line in without_text.splitlines() if line.strip()]
    return sum("//" in line for line in lines), len(lines)


def size_violations(functions: list[Function], lines: dict[str, int]) -> dict[str, str]:
    """By the name that an exception has, "FILE:LINE: WHY"."""
    found = {}
    for file, count in lines.items():
        if count > LONGEST_FILE:
            found[file] = f"{file}:1: {count} lines, {LONGEST_FILE} are allowed"
    for function in functions:
        place, key = f"{function.file}:{function.line}: {function.name}", f"{function.file}: {function.name}"
        if function.lines > LONGEST_FUNCTION:
            found[key] = f"{place} has {function.lines} lines, {LONGEST_FUNCTION} are allowed"
        if function.parameters > MOST_PARAMETERS:
            found[key] = f"{place} has {function.parameters} parameters, {MOST_PARAMETERS} are allowed"
    return found


def check(root: pathlib.Path) -> tuple[list[str], str]:
    """The violations, and a line of figures with what the list of exceptions need not name any more."""
    functions: list[Function] = []
    lines: dict[str, int] = {}
    comments = filled = 0
    for path in sorted(path for path in (root / "chasles").rglob("*") if path.suffix in SUFFIXES):
        file, text = path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")
        functions += functions_of(file, text)
        lines[file] = len(text.splitlines())
        comment, full = comment_lines(text)
        comments, filled = comments + comment, filled + full
    found = size_violations(functions, lines)
    short = sum(function.lines < SHORT_FUNCTION for function in functions) / max(1, len(functions))
    if short < SHORT_SHARE:
        why = f"{short:.1%} are under {SHORT_FUNCTION} lines, {SHORT_SHARE:.0%} are wanted"
        found["short functions"] = f"chasles:1: of the functions, {why}"
    share = comments / max(1, filled)
    if share < COMMENT_SHARE:
        found["comments"] = f"chasles:1: {share:.1%} of the lines have a comment, {COMMENT_SHARE:.0%} are wanted"
    longest = max((function.lines for function in functions), default=0)
    figures = (
        f"{len(functions)} functions, {short:.1%} under {SHORT_FUNCTION} lines, the longest of {longest}; "
        f"{len(lines)} files, the longest of {max(lines.values(), default=0)} lines; {share:.1%} of the lines with a comment"
    )
    unneeded = "".join(f"\nno exception any more: {key}" for key in sorted(EXCEPTIONS - set(found)))
    return [why for key, why in found.items() if key not in EXCEPTIONS], figures + unneeded


def violations(root: pathlib.Path) -> list[str]:
    return check(root)[0]


def main() -> int:
    found, figures = check(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    print("\n".join([*found, figures]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
