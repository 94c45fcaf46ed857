#!/usr/bin/env python3
"""A shared library of chasles exports what the public headers mark with CHASLES_EXPORT, and nothing else of its own.

Usage: exported_symbols.py NM LIBRARY ROOT. Prints one line a wrong symbol and exits with 1 if there is any; with 77 (ctest:
skipped) where NM is not a program.
"""

import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
import check_layers  # noqa: E402

TYPE = re.compile(r"\b(?:class|struct)\s+(?:\[\[\w+\]\]\s+)?CHASLES_EXPORT\s+(\w+)")
FUNCTION = re.compile(r"\bCHASLES_EXPORT\s+(?!class|struct)[^;({]*?(\w+)[^\w\s(]*\(")
# "vtable for" and the like, a result type in front of a template's name, then the name itself.
NAME = re.compile(r"^(?:(?:vtable|typeinfo|typeinfo name|VTT|guard variable) for )?(chasles(?:::~?\w+)+)")

INTERNAL = re.compile(r"\bchasles::[a-z_]+::")


def marked_names(root: pathlib.Path) -> tuple[set[str], set[str]]:
    """The types and the functions that the public headers mark; a member function is named alone."""
    types: set[str] = set()
    functions: set[str] = set()
    for header in check_layers.public_headers(root) - {"chasles/base/export.h"}:
        text = re.sub(r"//.*", "", (root / header).read_text(encoding="utf-8"))
        types.update(TYPE.findall(text))
        functions.update(FUNCTION.findall(text))
    return types, functions


def exported_symbols(nm: str, library: str) -> list[str]:
    """Demangled. Weak copies of what other libraries define in headers are left out, unless internal types are in them."""
    command = [nm, "--dynamic", "--defined-only", "--demangle", "--format=posix", library]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    # NAME TYPE VALUE SIZE, where the name may hold blanks.
    split = [re.fullmatch(r"(.*?) ([A-Za-z])(?: [0-9a-f]+){0,2}\s*", line) for line in lines]
    found = [match.groups() for match in split if match]
    return [name for name, kind in found if kind not in "WVu" or NAME.match(name) or INTERNAL.search(name)]


def why_wrong(symbol: str, types: set[str], functions: set[str]) -> str:
    match = NAME.match(symbol)
    if not match:
        return "is no name of chasles"
    first, *rest = match.group(1).split("::")[1:]
    if first in types or (not rest and first in functions):
        return ""
    return "" if rest and rest[-1] in functions else "is not marked with CHASLES_EXPORT in a public header"


def main() -> int:
    nm, library, root = sys.argv[1:]
    if not shutil.which(nm):
        print(f"skipped: {nm} is not a program")
        return 77
    types, functions = marked_names(pathlib.Path(root))
    symbols = exported_symbols(nm, library)
    wrong = [f"{symbol}: {why}" for symbol in symbols if (why := why_wrong(symbol, types, functions))]
    names = {part for symbol in symbols if (match := NAME.match(symbol)) for part in match.group(1).split("::")}
    wrong += [f"{name}: is marked, but not exported" for name in sorted((types | functions) - names)]
    print("\n".join(wrong) if wrong else f"{len(symbols)} symbols, all of {', '.join(sorted(types | functions))}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
