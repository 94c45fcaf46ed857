"""What the tests of pages in a headless Chromium share: the program, the browser, and checks after every test.

Usage of such a test: TEST.py CHASLES CHROMIUM [FOLDER]. Screenshots are kept in FOLDER, if given. Exit status 77 means
skipped, because there is no browser or the build has no viewer.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from devtools import Browser
from png import pixels

CUBE = """v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""
SIZE = (900, 560)

chasles, chromium = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]
passing = tempfile.TemporaryDirectory(prefix="chasles-view-")  # deleted at exit
folder = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else passing.name).resolve()


def run(*arguments: str) -> subprocess.CompletedProcess:
    return subprocess.run([chasles, *arguments], cwd=folder, capture_output=True, text=True, check=False)


def count(rows: list, is_wanted) -> int:
    return sum(is_wanted(pixel) for row in rows for pixel in row)


def is_contact_colour(pixel: tuple) -> bool:
    red, green, blue = pixel
    return abs(red - 0xD4) < 12 and abs(green - 0x14) < 24 and abs(blue - 0x7F) < 12


def is_moving_colour(pixel: tuple) -> bool:
    red, green, blue = pixel
    return red > 150 and 0.55 < green / red < 0.8 and blue < 0.2 * red


class PageTest(unittest.TestCase):
    """Tests of pages in `folder`. After every test: no errors, and no requests except for the page."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.write_pages()
        cls.browser = Browser(chromium, *SIZE)

    @classmethod
    def write_pages(cls) -> None:
        """Writes the pages that the tests open."""

    @classmethod
    def tearDownClass(cls) -> None:
        cls.browser.__exit__()

    def setUp(self) -> None:
        self.browser.events.clear()

    def tearDown(self) -> None:
        requests = [e["params"]["request"]["url"] for e in self.browser.events if e["method"].endswith("WillBeSent")]
        self.assertEqual([url for url in requests if not url.startswith(("file:///", "data:"))], [])
        self.assertEqual(len([url for url in requests if url.startswith("file:")]), 1)
        self.assertEqual([e["params"] for e in self.browser.events if self.is_complaint(e)], [])

    @staticmethod
    def is_complaint(event: dict) -> bool:
        if event["method"] == "Log.entryAdded":
            return event["params"]["entry"]["level"] == "error"
        if event["method"] == "Runtime.consoleAPICalled":
            return event["params"]["type"] in ("error", "warning")
        return event["method"] == "Runtime.exceptionThrown"

    def open(self, page: str) -> None:
        self.browser.open((folder / page).as_uri(), "!!window.chasles")
        self.browser.evaluate("window.chasles.ready")

    def time(self) -> float:
        return self.browser.evaluate("window.chasles.time()")

    def text(self, selector: str) -> str:
        return self.browser.evaluate(f"document.querySelector({json.dumps(selector)}).innerText")

    def click(self, selector: str) -> None:
        self.browser.evaluate(f"document.querySelector({json.dumps(selector)}).click()")

    def slide(self, place: float) -> None:
        """Drags the slider's thumb to a position in [0, 1]."""
        left, right, y, now = self.browser.evaluate(
            "(({left, right, top, bottom}, slider) => [left + 9, right - 9, (top + bottom) / 2, Number(slider.value)])"
            "(document.getElementById('time').getBoundingClientRect(), document.getElementById('time'))"
        )
        self.browser.drag(left + now * (right - left), left + place * (right - left), y)

    def picture(self, name: str) -> list:
        png = self.browser.screenshot(scale=0.5)  # Python reads a quarter of the pixels in a quarter of the time
        (folder / f"{name}.png").write_bytes(png)
        return pixels(png)

    def dark_and_narrow(self, page: str, name: str) -> list:
        """The picture of a page in the dark and in a narrow window, which the page does not exceed."""
        dark = {"name": "prefers-color-scheme", "value": "dark"}
        self.browser.call("Emulation.setEmulatedMedia", features=[dark])
        self.browser.resize(400, 700)
        try:
            self.open(page)
            self.assertEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 400)
            return self.picture(name)
        finally:
            self.browser.call("Emulation.setEmulatedMedia", features=[])
            self.browser.resize(*SIZE)


def main() -> int:
    if not chromium:
        print("skipped: no chromium")
        return 77
    (folder / "cube.obj").write_text(CUBE)
    tried = run("view", "cube.obj", "cube.obj", "--start", "3 0 0", "--goal", "0 0 0", "--out", "tried.html")
    if "this build has no viewer" in tried.stderr:
        print("skipped:", tried.stderr)
        return 77
    return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1
