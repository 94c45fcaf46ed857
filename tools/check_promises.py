#!/usr/bin/env python3
"""Checks that the documents name only what exists.

Usage: check_promises.py [ROOT]. Prints one line "FILE:LINE: WHY" for each violation and exits with 1 if there is any.

Every document is checked (tools/check_links.py checks the links):
- a `Suite.Test` in backticks is a test of the tree;
- a path or the name of a source file in backticks exists, also as a stem without an extension;
- a code name in backticks occurs in the sources, outside of `//` comments. A code name is a CamelCase type, a
  snake_case name, a `function()`, or any name with `::`. All parts of `Type::member` or `Type.member` occur in one
  file. Historical documents are exempt from this rule.

Each promise of docs/promises.md names a test or links to a note.
"""

import pathlib
import re
import sys

SOURCES = ["chasles", "cli", "view", "viewer", "scenes", "python", "javascript", "tests", "bench", "tools", "examples", "cmake", "site"]
BUILD_FILES = ["Makefile", "CMakeLists.txt", "CMakePresets.json", "pyproject.toml"]
NOT_OURS = {"node_modules", "__pycache__", "corpus"}
PROMISES = "docs/promises.md"
HISTORICAL = ["CHANGELOG.md", "docs/performance-attempts.md"]  # name code that is gone
ALLOWED = {
    *("fast_float", "manylinux_2_34", "target_clones"),  # other libraries and tools
    *("PascalCase", "snake_case", "_in_world", "_in_fixed"),  # rules for names
}
OTHERS = ("std::", "Eigen::")  # namespaces of other libraries
MADE = ["bench/results"]  # folders that git ignores and a program makes

FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"(?<!`)`([^`]+)`(?!`)")
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
PROMISE = re.compile(r"^\d+\. \*\*")
TEST = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)", re.MULTILINE)
NAMED_TEST = re.compile(r"([A-Z]\w+)\.([A-Z]\w+|\*)")
PATH = re.compile(rf"(?:{'|'.join([*SOURCES, 'docs'])})(?:/[\w.*-]+)+/?")
FILE_NAME = re.compile(r"\w+\.(?:h|inl|cpp|py|ts|sh|cmake)")
NAME = re.compile(r"(?<![\w./<>-])[A-Za-z_]\w*(?:(?:::|\.)[A-Za-z_]\w*)*(?![\w/-])(?:\(\))?")
CODE_NAME = re.compile(r"[A-Z]\w*[a-z]\w*|\w*[A-Za-z0-9]_\w*|_\w+|\w+\(\)")
LINE_COMMENT = re.compile(r"//.*")
WORD = re.compile(r"[A-Za-z_]\w*")


class Tree:
    """Everything that a document may name."""

    def __init__(self, root: pathlib.Path):
        self.root = root
        self.tests: set[tuple[str, str]] = set()
        self.words: list[set[str]] = []  # of each source file, and of its path
        self.file_names: set[str] = set()
        own = {pathlib.Path(__file__).name, "check_promises_test.py"}  # these name code that does not exist
        for path in self.source_files():
            self.file_names.add(path.name)
            try:
                text = path.read_text(encoding="utf-8")
            except UnicodeDecodeError:
                continue
            if path.suffix == ".cpp":
                self.tests.update(TEST.findall(text))
            if path.suffix in [".h", ".inl", ".cpp", ".ts", ".js", ".mjs"]:
                text = LINE_COMMENT.sub("", text)
            if path.name not in own:
                self.words.append({*WORD.findall(text), *WORD.findall(path.relative_to(root).as_posix())})

    def source_files(self) -> list[pathlib.Path]:
        below = [file for folder in SOURCES for file in sorted((self.root / folder).rglob("*"))]
        files = [*(self.root / file for file in BUILD_FILES), *below]
        return [file for file in files if file.is_file() and not NOT_OURS & set(file.parts)]

    def has_test(self, suite: str, test: str) -> bool:
        return any(s == suite for s, _ in self.tests) if test == "*" else (suite, test) in self.tests

    def has_path(self, path: str) -> bool:
        """Whether a file or a folder has this path, or a file has it as its stem."""
        path = path.rstrip("/")
        return path in MADE or any(self.root.glob(path)) or ("." not in path and any(self.root.glob(path + ".*")))

    def has_name(self, name: str) -> bool:
        parts = set(WORD.findall(name))
        return name.startswith(OTHERS) or bool(parts & ALLOWED) or any(parts <= words for words in self.words)


def documents(root: pathlib.Path) -> list[pathlib.Path]:
    return sorted([*root.glob("*.md"), *root.glob("docs/**/*.md")])


def spans(text: str) -> list[tuple[int, str]]:
    """Line and text of each span in backticks; a span may continue in the next line."""
    text = FENCED.sub(lambda block: "\n" * block[0].count("\n"), text)
    return [(text.count("\n", 0, found.start()) + 1, " ".join(found[1].split())) for found in SPAN.finditer(text)]


def code_names(span: str) -> list[str]:
    """The names in a span that look like code of ours."""
    return [name for name in NAME.findall(span) if "::" in name or CODE_NAME.search(name)]


def why_missing(tree: Tree, span: str, is_historical: bool) -> list[str]:
    """Why a span names something that does not exist; empty if everything exists."""
    if found := NAMED_TEST.fullmatch(span):
        return [] if tree.has_test(*found.groups()) else [f"there is no test {span}"]
    if FILE_NAME.fullmatch(span):
        return [] if span in tree.file_names else [f"there is no file {span}"]
    paths = [part for part in span.split() if PATH.fullmatch(part)]
    names = [] if is_historical else code_names(" ".join(part for part in span.split() if part not in paths))
    return [
        *(f"there is no file {path}" for path in paths if "NNNN" not in path and not tree.has_path(path)),
        *(f"the sources do not have {name}" for name in names if not tree.has_name(name)),
    ]


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


def has_proof(promise: str) -> bool:
    return bool(LINK.search(promise)) or any(NAMED_TEST.fullmatch(span) for _, span in spans(promise))


def violations(root: pathlib.Path) -> list[str]:
    """One line "FILE:LINE: WHY" for each violation."""
    tree = Tree(root)
    result = []
    for document in documents(root):
        name = document.relative_to(root).as_posix()
        text = document.read_text(encoding="utf-8")
        found = [(line, why) for line, span in spans(text) for why in why_missing(tree, span, name in HISTORICAL)]
        if name == PROMISES:
            all_promises = promises(text)
            if not all_promises:
                found.append((1, "promises nothing"))
            found += [(line, "a promise without a test or a note") for line, p in all_promises if not has_proof(p)]
        result += [f"{name}:{line}: {why}" for line, why in sorted(found)]
    return result


def main() -> int:
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = violations(root)
    print("\n".join(found) if found else "every test, file and code name in the documents exists")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
