#!/usr/bin/env python3
"""Checks a folder of HTML pages: every link leads somewhere, and no page needs the network.

Usage: check_site.py FOLDER. Prints one line "PAGE: WHY" for each violation and exits with 1 if there is any.

- A link, picture, script, style or frame inside the site leads to a file of the site, and "#NAME" to an element with this id.
- Links to other sites are allowed as links only (`<a href>`): nothing that a page loads comes from elsewhere. Styles load
  nothing from elsewhere, either.
- A picture has a text (`alt`), a frame a title, and ids are unique in a page.
"""

import collections
import pathlib
import re
import sys
import urllib.parse
from html.parser import HTMLParser

LOADED = {("img", "src"), ("script", "src"), ("iframe", "src"), ("source", "src"), ("source", "srcset"), ("video", "src"),
          ("object", "data"), ("embed", "src"), ("link", "href")}  # fmt: skip
NEEDS = {"img": "alt", "iframe": "title"}
NOT_LOADED = {"canonical", "next", "prev", "search", "index", "author", "top", "up", "license"}  # kinds of <link>
IN_STYLE = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")
ELSEWHERE = re.compile(r"(?:[a-zA-Z][a-zA-Z+.-]*:)?//")
NOT_FILES = ("data:", "mailto:", "javascript:", "blob:", "about:")


class Page(HTMLParser):
    """The ids of a page, what it links to, and what it lacks."""

    def __init__(self, text: str):
        super().__init__()
        self.ids: collections.Counter[str] = collections.Counter()
        self.links: list[tuple[str, bool]] = []  # address, and whether the page loads it
        self.faults: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attributes}
        if "id" in values:
            self.ids[values["id"]] += 1
        if tag in NEEDS and not values.get(NEEDS[tag], "").strip():
            self.faults.append(f"<{tag} {values.get('src', '')[:60]}> has no {NEEDS[tag]}")
        if tag == "a" and "href" in values:
            self.links.append((values["href"], False))
        if tag == "link" and NOT_LOADED & set(values.get("rel", "").split()):
            self.links.append((values.get("href", ""), False))
            return
        for name, value in values.items():
            if (tag, name) in LOADED:
                self.links.append((value, True))


class Site:
    def __init__(self, folder: pathlib.Path):
        self.folder = folder.resolve()
        files = sorted(self.folder.rglob("*.html"))
        self.pages = {file: Page(file.read_text(encoding="utf-8")) for file in files}

    def why_broken(self, place: pathlib.Path, address: str, is_loaded: bool) -> str:
        """Why an address in a file leads nowhere; empty if it does not."""
        if address.startswith(NOT_FILES):
            return ""
        if ELSEWHERE.match(address):
            return f"loads {address} from elsewhere" if is_loaded else ""
        parts = urllib.parse.urlsplit(address)
        target = (place.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else place
        if not target.is_relative_to(self.folder) or not target.is_file():
            return f"{address} leads nowhere"
        name = urllib.parse.unquote(parts.fragment)
        if name and target in self.pages and not self.pages[target].ids[name] and name != "top":
            return f"{address}: there is no such place in {target.relative_to(self.folder)}"
        return ""

    def faults_of_page(self, file: pathlib.Path, page: Page) -> list[str]:
        twice = [f"the id '{name}' is there {count} times" for name, count in page.ids.items() if count > 1]
        broken = [self.why_broken(file, address, is_loaded) for address, is_loaded in page.links]
        return [*page.faults, *twice, *dict.fromkeys(why for why in broken if why)]

    def faults_of_style(self, file: pathlib.Path) -> list[str]:
        addresses = ["".join(match) for match in IN_STYLE.findall(file.read_text(encoding="utf-8"))]
        return [why for address in addresses if (why := self.why_broken(file, address, True))]

    def violations(self) -> list[str]:
        found = [(file, why) for file, page in self.pages.items() for why in self.faults_of_page(file, page)]
        found += [(file, why) for file in sorted(self.folder.rglob("*.css")) for why in self.faults_of_style(file)]
        return [f"{file.relative_to(self.folder).as_posix()}: {why}" for file, why in found]


def violations(folder: pathlib.Path) -> list[str]:
    """One line "PAGE: WHY" for each violation."""
    site = Site(folder)
    return site.violations() if site.pages else [f"{folder.name}: has no pages"]


def main() -> int:
    folder = pathlib.Path(sys.argv[1])
    found = violations(folder)
    print("\n".join(found) if found else "every link of the site leads somewhere, and no page needs the network")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
