#!/usr/bin/env python3
"""Cuts the C++ out of docs/guide/cpp.md, so that the tests compile and run what a reader copies.

Usage: cpp_code.py DOCUMENT OUT. Writes first/first.cpp, the block that has a main, with the block of CMake beside it;
pieces.cpp, all other blocks one after the other in a main of their own; and first.txt and pieces.txt, the lines that the
comments say they print.
"""

import pathlib
import re
import sys

BLOCK = re.compile(r"^```(cpp|cmake)\n(.*?)^```", re.DOTALL | re.MULTILINE)
PRINT = re.compile(r"std::(?:printf|puts)\((?:[^;]|\n)*?\);(?:\n? *// (.*))?")
HEAD = "#include <chasles/chasles.h>\n\n#include <cstdio>\n#include <vector>\n\nint main() {\n"


def expected_of(code: str) -> str:
    """What the code prints: the comment behind or below each statement that prints, where it has one."""
    return "".join(f"{line}\n" for line in PRINT.findall(code) if line)


def files_of(document: str) -> dict[str, str]:
    blocks = BLOCK.findall(document)
    builds = [block for language, block in blocks if language == "cmake"]
    wholes = [block for language, block in blocks if language == "cpp" and "int main()" in block]
    pieces = "".join(block for language, block in blocks if language == "cpp" and "int main()" not in block)
    if len(builds) != 1 or len(wholes) != 1 or not pieces:
        raise SystemExit("cpp_code.py: the document needs one block of CMake, one with a main, and others")
    return {
        "first/CMakeLists.txt": builds[0],
        "first/first.cpp": wholes[0],
        "first.txt": expected_of(wholes[0]),
        "pieces.cpp": HEAD + pieces + "}\n",
        "pieces.txt": expected_of(pieces),
    }


def main() -> int:
    document, out = map(pathlib.Path, sys.argv[1:])
    (out / "first").mkdir(parents=True, exist_ok=True)
    for name, content in files_of(document.read_text(encoding="utf-8")).items():
        file = out / name
        if not file.is_file() or file.read_text(encoding="utf-8") != content:  # an equal file is not compiled again
            file.write_text(content, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
