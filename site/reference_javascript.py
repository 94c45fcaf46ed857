#!/usr/bin/env python3
"""Finishes the pages that TypeDoc wrote, so that Sphinx reads them as pages of the site.

Usage: reference_javascript.py FOLDER. Rows of tables have anchors in HTML, which Sphinx does not know: links to rows become
links to the page. The index gets a toctree.
"""

import pathlib
import re
import sys

ANCHOR = re.compile(r'<a id="([^"]+)"></a> ')
LINK = re.compile(r"\]\(([\w/.-]+\.md)#([\w-]+)\)")
KIND = re.compile(r"^# [\w ]+: ", re.MULTILINE)
HEAD = """# JavaScript

`import { load } from "chasles"` gives an instance of the library; all bodies and scenes belong to it.
[The guide](../../javascript/README.md) shows how the parts work together.
"""
TOCTREE = "\n```{toctree}\n:hidden:\n:glob:\n\nfunctions/*\nclasses/*\ninterfaces/*\ntypes/*\n```\n"


def main() -> int:
    folder = pathlib.Path(sys.argv[1])
    pages = {page.resolve(): page.read_text(encoding="utf-8") for page in folder.rglob("*.md")}
    rows = {page: set(ANCHOR.findall(text)) for page, text in pages.items()}
    for page, text in pages.items():

        def link(match: re.Match[str]) -> str:
            target = (page.parent / match[1]).resolve()
            return f"]({match[1]})" if match[2] in rows[target] else match[0]

        text = LINK.sub(link, KIND.sub("# ", ANCHOR.sub("", text))).replace("\n***\n", "\n")
        if page.parent == folder.resolve():
            text = text.replace("# JavaScript\n", HEAD, 1) + TOCTREE
        page.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
