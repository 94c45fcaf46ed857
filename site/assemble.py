#!/usr/bin/env python3
"""Assembles what Sphinx reads for the site: the Markdown of the repository in its own folders, and made pages.

Usage: assemble.py OUT STUBS. OUT is made anew. STUBS is the file with the type stubs of the compiled Python module. Needs
doxygen. The pages of the JavaScript reference come from TypeDoc, which tools/site.sh runs.
"""

import pathlib
import re
import shutil
import sys

import plots
import reference_cpp
import reference_python

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOP = ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "javascript/README.md"]
LISTED = {"docs/derivations": "Notes", "docs/decisions": "Decisions"}  # folders that have no index of their own

PLAYGROUND = ROOT / "build" / "playground" / "index.html"

ONLY_WITH_PLAYGROUND = re.compile(r"^%PLAYGROUND% (.*\n)", re.MULTILINE)
QUOTE = re.compile(r'^%README% from "(.*)" until "(.*)"$', re.MULTILINE)
LINK = re.compile(r"(\]\()([^)#:\s]+)(#[^)]*)?\)")
INTRODUCTIONS = {
    "docs/derivations": "Every formula and every bound of the library, with its derivation, its files and its tests.",
    "docs/decisions": "Every choice that someone may want to undo: the question, the options, the choice, and what would change it.",
}


def title_of(document: pathlib.Path) -> str:
    return next(line for line in document.read_text(encoding="utf-8").splitlines() if line.startswith("# "))[2:]


def index_of(folder: str) -> str:
    """The page that lists the documents of a folder in order of their numbers."""
    documents = sorted((ROOT / folder).glob("*.md"))
    entries = "\n".join(document.stem for document in documents)
    return f"# {LISTED[folder]}\n\n{INTRODUCTIONS[folder]}\n\n```{{toctree}}\n:maxdepth: 1\n\n{entries}\n```\n"


def is_staged(path: pathlib.Path) -> bool:
    """Whether the site has this file."""
    name = path.relative_to(ROOT).as_posix()
    return name in TOP or (name.startswith("docs/") and path.is_file())


def on_site(document: pathlib.Path, text: str) -> str:
    """The text with the links that a site can follow: folders lead to their index, sources are only named."""

    def link(match: re.Match[str]) -> str:
        target = (document.parent / match[2]).resolve()
        if target == ROOT / "README.md":
            return f"{match[1]}{'../' * (len(document.relative_to(ROOT).parts) - 1)}index.md)"
        if target.is_dir() and target.relative_to(ROOT).as_posix() in LISTED:
            return f"{match[1]}{match[2].rstrip('/')}/index.md)"
        if target.exists() and not is_staged(target):
            return "]<source>"
        return match[0]

    text = LINK.sub(link, text)
    return re.sub(r"\[([^\]]*)\]<source>", lambda match: match[1] if "`" in match[1] else f"`{match[1]}`", text)


def copy_documents(out: pathlib.Path) -> None:
    for document in [*(ROOT / name for name in TOP), *sorted((ROOT / "docs").rglob("*.md"))]:
        target = out / document.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(on_site(document, document.read_text(encoding="utf-8")), encoding="utf-8")
    shutil.copytree(ROOT / "docs" / "images", out / "docs" / "images")
    for folder in LISTED:
        (out / folder / "index.md").write_text(index_of(folder), encoding="utf-8")


def with_quotes(page: str, readme: str) -> str:
    """The page with parts of README.md: each from its first words until the words that follow it."""

    def quote(match: re.Match[str]) -> str:
        start = readme.find(match[1])
        end = readme.find(match[2], start + 1)
        if start < 0 or end < 0:
            raise SystemExit(f'site/assemble.py: README.md has no "{match[1]}" before "{match[2]}"')
        return readme[start:end].strip()

    return QUOTE.sub(quote, page)


def with_playground(page: str, is_there: bool) -> str:
    return ONLY_WITH_PLAYGROUND.sub(r"\1" if is_there else "", page)


def copy_pages(out: pathlib.Path, has_playground: bool) -> None:
    """The pages that only the site has."""
    readme = (out / "README.md").read_text(encoding="utf-8")
    for page in sorted((ROOT / "site" / "pages").rglob("*.md")):
        if page.name == "playground.md" and not has_playground:
            continue
        target = out / page.relative_to(ROOT / "site" / "pages")
        target.parent.mkdir(parents=True, exist_ok=True)
        text = with_playground(page.read_text(encoding="utf-8"), has_playground)
        target.write_text(with_quotes(text, readme), encoding="utf-8")
    (out / "README.md").unlink()  # the start page has it


def copy_playground(extra: pathlib.Path) -> bool:
    """Whether there is one. `make playground` builds it."""
    shutil.rmtree(extra / "playground", ignore_errors=True)
    if PLAYGROUND.is_file():
        (extra / "playground").mkdir(parents=True)
        shutil.copyfile(PLAYGROUND, extra / "playground" / "index.html")
    return PLAYGROUND.is_file()


def main() -> int:
    out, stubs = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    copy_documents(out)
    extra = out.parent / "extra"
    extra.mkdir(exist_ok=True)
    copy_pages(out, copy_playground(extra))
    plots.write(ROOT, out / "plots")
    xml = reference_cpp.run_doxygen(ROOT, out.parent / "doxygen")
    reference_cpp.write(ROOT, xml, out / "api" / "cpp")
    reference_python.make_package(ROOT, stubs, out.parent / "python")
    reference_python.write(ROOT, out / "api" / "python")
    return 0


if __name__ == "__main__":
    sys.exit(main())
