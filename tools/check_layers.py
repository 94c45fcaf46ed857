#!/usr/bin/env python3
"""Checks that data flows one way: a layer includes only the layers that it may know.

Usage: check_layers.py [ROOT]. Prints one line "FILE:LINE: WHY" a violation and exits with 1 if there is any.
"""

import pathlib
import re
import sys

# Top to bottom as in the architecture; each layer with what it may include besides itself. Less than everything above:
# the mesh knows nothing of motions and the files nothing of queries.
MAY_INCLUDE = {
    "base": [],
    "algebra": ["base"],
    "motion": ["base", "algebra"],
    "elementary": ["base", "algebra", "motion"],
    "hierarchy": ["base"],
    "mesh": ["base", "algebra", "hierarchy"],
    "culling": ["base", "algebra", "motion", "elementary", "hierarchy", "mesh"],
    "contact": ["base", "algebra", "motion", "elementary", "hierarchy", "mesh"],
    "search": ["base", "algebra", "motion", "elementary", "hierarchy", "mesh", "culling", "contact"],
    "memory": ["base", "algebra", "motion", "elementary", "hierarchy", "mesh", "culling", "contact", "search"],
    "query": ["base", "algebra", "motion", "elementary", "hierarchy", "mesh", "culling", "contact", "search", "memory"],
    "scene": ["base", "algebra", "motion", "elementary", "hierarchy", "mesh", "culling", "contact", "search", "memory", "query"],
    "io": ["base", "algebra", "motion", "hierarchy", "mesh"],
    "robot": [
        "base", "algebra", "motion", "elementary", "hierarchy", "mesh", "culling", "contact", "search", "memory", "query", "scene",
        "io",
    ],
    "certificate": [
        "base", "algebra", "motion", "elementary", "hierarchy", "mesh", "culling", "contact", "search", "memory", "query", "scene",
        "io", "robot",
    ],
    "manipulation": [
        "base", "algebra", "motion", "elementary", "hierarchy", "mesh", "culling", "contact", "search", "memory", "query", "scene",
    ],
    "tools": [],
    "scenes": [],
    "view": ["base", "motion"],
    "cli": ["base", "io", "robot", "scenes", "tools", "view"],
    "python": ["base", "motion", "scene", "io", "tools", "view"],
    "javascript": ["base", "motion", "io", "view"],
    "playground": ["examples", "scenes"],
    "ompl": [],
}
# Beside chasles/, not in it; they may include the public headers.
FACES = ["scenes", "view", "cli", "python", "javascript", "playground", "ompl"]
SURFACE = "chasles/chasles.h"
MAY_INCLUDE_SURFACE = ["scenes", "view", "cli", "python", "javascript", "playground", "tests", "bench", "examples"]
FREE = ["tests", "bench"]  # may include any layer, but by the same names

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
OWN_NAME = re.compile(r"(chasles/[a-z_]+|[a-z_]+)/[a-z0-9_/]+\.(h|inl)")
SUFFIXES = [".h", ".hpp", ".cpp", ".cc", ".inl"]


def layer_of(path: str) -> str:
    """The layer that a path relative to the root belongs to: the folder below chasles/, or the top folder."""
    parts = pathlib.PurePosixPath(path).parts
    if parts == ("chasles", "ompl.h"):
        return "ompl"  # one header beside the library
    if parts[0] == "chasles":
        return parts[1] if len(parts) > 2 else ""
    return parts[0]


def public_headers(root: pathlib.Path) -> set[str]:
    """The headers that the surface reaches; every face may include each of them by its own name."""
    found: set[str] = set()
    waiting = [SURFACE]
    while waiting:
        name = waiting.pop()
        if name in found or not (root / name).is_file():
            continue
        found.add(name)
        for line in (root / name).read_text(encoding="utf-8").splitlines():
            match = INCLUDE.match(line)
            if match and match.group(2).startswith("chasles/"):
                waiting.append(match.group(2))
    return found


def why_wrong(root: pathlib.Path, file: str, quote: str, name: str) -> str:
    """Why `file` must not include `name`; empty if it may."""
    if quote == "<":
        return f"<{name}> is ours: include it in quotes" if name.startswith("chasles/") else ""
    if not (root / name).is_file():
        return f'"{name}" is not a file of the project, named from its root'
    if file == SURFACE:
        return ""
    layer, included = layer_of(file), layer_of(name)
    if name == SURFACE:
        return "" if layer in MAY_INCLUDE_SURFACE else f'{layer} must not include the whole surface "{name}"'
    if not OWN_NAME.fullmatch(name):
        return f'"{name}" is not of the form "chasles/<layer>/<file>.h" or ".inl"'
    if layer in FREE or layer == included:
        return ""
    if layer in FACES and name in public_headers(root):
        return ""
    if layer not in MAY_INCLUDE:
        return f'"{layer or file}" is not a layer; add it to the architecture and to tools/check_layers.py'
    return "" if included in MAY_INCLUDE[layer] else f'{layer} must not know of {included or name}: "{name}"'


def violations(root: pathlib.Path) -> list[str]:
    """One line "FILE:LINE: WHY" for each include that is against the rules."""
    found = []
    for folder in ["chasles", *FACES, *FREE]:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in SUFFIXES:
                continue
            file = path.relative_to(root).as_posix()
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
                match = INCLUDE.match(line)
                why = why_wrong(root, file, *match.groups()) if match else ""
                if why:
                    found.append(f"{file}:{number}: {why}")
    return found


def main() -> int:
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent
    found = violations(root)
    print("\n".join(found) if found else "every include goes to a layer that may be known")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
