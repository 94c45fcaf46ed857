"""Repairs of pages: comments of the sources name documents by their paths, which are links here; equal ids of titles; dashes."""

import pathlib
import re
from typing import Any

from docutils import nodes
from sphinx.transforms import SphinxTransform

PATH = re.compile(r"(docs/(?:derivations|decisions)/(\d+)(?:-[\w-]+\.md)?|docs/[\w-]+\.md)")


class LinksToNotes(SphinxTransform):
    """Replaces "docs/derivations/02" and "docs/promises.md" by links, in the reference of the interfaces."""

    default_priority = 600

    def apply(self, **options: Any) -> None:
        if not self.env.docname.startswith("api/"):
            return
        for text in list(self.document.findall(nodes.Text)):
            if PATH.search(text) and not isinstance(text.parent, nodes.reference):
                self.replace(text)

    def replace(self, text: nodes.Text) -> None:
        parts: list[nodes.Node] = []
        end = 0
        for match in PATH.finditer(text):
            document = self.document_of(match[1])
            if document:
                uri = self.app.builder.get_relative_uri(self.env.docname, document)
                parts += [nodes.Text(text[end : match.start()]), nodes.reference("", match[1], refuri=uri, internal=True)]
                end = match.end()
        if parts:
            parts.append(nodes.Text(text[end:]))
            text.parent.replace(text, parts)

    def document_of(self, path: str) -> str:
        """The document with this path, or with this number; empty if there is none."""
        known = self.env.found_docs
        if path.endswith(".md"):
            return path.removesuffix(".md") if path.removesuffix(".md") in known else ""
        return next((name for name in sorted(known) if pathlib.PurePath(name).as_posix().startswith(path + "-")), "")


class TitlesWithoutIds(SphinxTransform):
    """The titles inside a class of C++ ("Public Members") are on a page many times: their ids would be equal."""

    default_priority = 600

    def apply(self, **options: Any) -> None:
        for title in self.document.findall(nodes.rubric):
            if any(name.startswith("breathe-section-title") for name in title["ids"]):
                title["ids"] = []


class DashesOfFields(SphinxTransform):
    """Sphinx writes two hyphens between a parameter and its text, and leaves it to its quotes to join them."""

    default_priority = 600

    def apply(self, **options: Any) -> None:
        for text in list(self.document.findall(nodes.Text)):
            if text == " -- ":
                text.parent.replace(text, nodes.Text(" \u2013 "))


def setup(app: Any) -> dict[str, bool]:
    app.add_transform(LinksToNotes)
    app.add_transform(TitlesWithoutIds)
    app.add_post_transform(DashesOfFields)
    return {"parallel_read_safe": True}
