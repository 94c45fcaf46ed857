#!/usr/bin/env python3
"""Checks the links between the Markdown files of the repository, without network.

Usage: check_links.py [ROOT]. Prints one line "FILE:LINE: WHY" for each violation and exits with 1 if there is any.

A link or picture leads to a file or a folder of the repository; the part after "#" is a heading of the Markdown file, as
GitHub and the site name it. Links in code are no links. Addresses of other sites are not followed.
"""

import pathlib
import re
import sys

FENCED = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"(?<!`)(`+)(?!`)(.+?)(?<!`)\1(?!`)", re.DOTALL)
INDENTED = re.compile(r"(?<=\n\n)(?: {4}.*\n(?:\n(?= {4}))?)+")
LINK = re.compile(r"!?\[(?:[^\]\[]|\[[^\]]*\])*\]\(\s*<?([^)\s>]*)>?(?:\s+\"[^\"]*\")?\s*\)")
HEADING = re.compile(r"^#{1,6} +(.*?)[ #]*$", re.MULTILINE)
ELSEWHERE = re.compile(r"[a-z][a-z+.-]*:")
NOT_OURS = {"build", "dist", "node_modules", ".git", "shared"}
STAGED = "site/pages"  # linked as they stand on the site, whose build checks them


def documents(root: pathlib.Path) -> list[pathlib.Path]:
    found: list[pathlib.Path] = []
    for folder in [root, *(path for path in sorted(root.iterdir()) if path.is_dir() and path.name not in NOT_OURS)]:
        found += folder.glob("*.md") if folder == root else folder.rglob("*.md")
    names = {path: path.relative_to(root) for path in found}
    return sorted(path for path, name in names.items() if not name.is_relative_to(STAGED) and not NOT_OURS & set(name.parts))


def blanked(text: str) -> str:
    """The text with code blanked out, line by line."""
    for code in (FENCED, INDENTED, SPAN):
        text = code.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
    return text


def slug(heading: str) -> str:
    """The name of a heading in links."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def anchors(text: str) -> set[str]:
    """The names of all headings; equal ones are counted."""
    found: set[str] = set()
    seen: dict[str, int] = {}
    for heading in HEADING.findall(FENCED.sub("", text)):
        name = slug(heading)
        found.add(f"{name}-{seen[name]}" if name in seen else name)
        seen[name] = seen.get(name, 0) + 1
    return found


class Repository:
    """The Markdown files, each read once."""

    def __init__(self, root: pathlib.Path):
        self.root = root.resolve()
        self.anchors: dict[pathlib.Path, set[str]] = {}

    def anchors_of(self, document: pathlib.Path) -> set[str]:
        if document not in self.anchors:
            self.anchors[document] = anchors(document.read_text(encoding="utf-8"))
        return self.anchors[document]

    def why_broken(self, document: pathlib.Path, link: str) -> str:
        """Why a link leads nowhere; empty if it does not."""
        if ELSEWHERE.match(link):
            return ""
        path, _, anchor = link.partition("#")
        target = (document.parent / path).resolve() if path else document.resolve()
        if not target.is_relative_to(self.root):
            return f"the link to {link} leaves the repository"
        if not target.exists():
            return f"the link to {link} leads nowhere"
        if anchor and target.suffix == ".md" and anchor not in self.anchors_of(target):
            return f"the link to {link}: {target.name} has no heading '{anchor}'"
        return ""


def violations(root: pathlib.Path) -> list[str]:
    """One line "FILE:LINE: WHY" for each violation."""
    repository = Repository(root)
    result = []
    for document in documents(root):
        text = blanked(document.read_text(encoding="utf-8"))
        for match in LINK.finditer(text):
            if why := repository.why_broken(document, match[1]):
                line = text.count("\n", 0, match.start()) + 1
                result.append(f"{document.relative_to(root).as_posix()}:{line}: {why}")
    return result


def main() -> int:
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = violations(root)
    print("\n".join(found) if found else f"every link in {len(documents(root))} documents leads somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
