"""What the tests of the playground share: the page in a headless Chromium, a hand, and checks after every test.

Usage of such a test: TEST.py PAGE CHROMIUM CHASLES [FOLDER]. CHASLES is the native program, which may be empty: what needs it
is skipped. Screenshots and downloads are kept in FOLDER, if given. Exit status 77 means skipped, because there is no browser.
"""

import csv
import io
import json
import math
import pathlib
import shlex
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "view"))
from devtools import Browser  # noqa: E402
from png import pixels  # noqa: E402

SIZE = (900, 560)
ALT, CONTROL, META, SHIFT = 1, 2, 4, 8  # modifiers of the DevTools protocol

page, chromium = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
chasles = str(pathlib.Path(sys.argv[3]).resolve()) if len(sys.argv) > 3 and sys.argv[3] else ""
passing = tempfile.TemporaryDirectory(prefix="chasles-playground-")  # deleted at exit
folder = pathlib.Path(sys.argv[4] if len(sys.argv) > 4 else passing.name).resolve()


def run(*arguments: str, cwd: pathlib.Path) -> subprocess.CompletedProcess:
    return subprocess.run([chasles, *arguments], cwd=cwd, capture_output=True, text=True, check=False)


def quantile(values: list, share: float) -> float:
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def count(rows: list, is_wanted) -> int:
    return sum(is_wanted(pixel) for row in rows for pixel in row)


def is_contact_colour(pixel: tuple) -> bool:
    red, green, blue = pixel
    return abs(red - 0xD4) < 12 and abs(green - 0x14) < 24 and abs(blue - 0x7F) < 12


def is_moving_colour(pixel: tuple) -> bool:
    red, green, blue = pixel
    return red > 150 and 0.55 < green / red < 0.8 and blue < 0.2 * red


def is_hand_colour(pixel: tuple) -> bool:
    return max(pixel) < 60


def poses_in(text: str) -> list:
    return [[float(word) for word in row] for row in list(csv.reader(io.StringIO(text)))[1:]]


def distance(a: list, b: list) -> float:
    return math.dist(a[:3], b[:3])


def angle(a: list, b: list) -> float:
    """By which two poses are turned against each other."""
    return 2 * math.acos(min(1, abs(sum(x * y for x, y in zip(a[3:], b[3:])))))


class PlaygroundTest(unittest.TestCase):
    """After every test: no errors, and no requests except for the page and what it made itself."""

    @classmethod
    def setUpClass(cls) -> None:
        cls.browser = Browser(chromium, *SIZE, patience=120)
        cls.browser._call("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})

    @classmethod
    def tearDownClass(cls) -> None:
        cls.browser.__exit__()

    def setUp(self) -> None:
        self.browser.events.clear()

    def tearDown(self) -> None:
        requests = [e["params"]["request"]["url"] for e in self.browser.events if e["method"].endswith("WillBeSent")]
        self.assertEqual([url for url in requests if not url.startswith(("file:///", "data:", "blob:"))], [])
        self.assertEqual([url for url in requests if url.startswith("file:") and not url.startswith(page.as_uri())], [])
        self.assertEqual([e["params"] for e in self.browser.events if self.is_complaint(e)], [])

    @staticmethod
    def is_complaint(event: dict) -> bool:
        if event["method"] == "Log.entryAdded":
            return event["params"]["entry"]["level"] == "error"
        if event["method"] == "Runtime.consoleAPICalled":
            return event["params"]["type"] in ("error", "warning")
        return event["method"] == "Runtime.exceptionThrown"

    def open(self, fragment: str = "") -> float:
        """Returns after how many milliseconds the page was ready."""
        self.browser.call("Page.navigate", url="about:blank")
        self.browser.open(page.as_uri() + fragment, "!!window.playground")
        return self.evaluate("playground.ready")

    def evaluate(self, expression: str) -> object:
        return self.browser.evaluate(expression)

    def pose(self) -> list:
        return self.evaluate("playground.pose()")

    def text(self, selector: str) -> str:
        return self.evaluate(f"document.querySelector({json.dumps(selector)}).innerText")

    def is_hidden(self, selector: str) -> bool:
        return self.evaluate(f"document.querySelector({json.dumps(selector)}).hidden")

    def click(self, selector: str) -> None:
        """By the mouse, at the middle of the element."""
        x, y = self.evaluate(
            "(element => (element.scrollIntoView({block: 'center'}), (({left, top, width, height}) => [left + width / 2, top + height / 2])"
            f"(element.getBoundingClientRect())))(document.querySelector({json.dumps(selector)}))"
        )
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)

    def wait_until(self, expression: str, seconds: float = 60) -> None:
        deadline = time.monotonic() + seconds
        while not self.evaluate(expression):
            self.assertLess(time.monotonic(), deadline, f"waited for {expression}")
            time.sleep(0.03)

    def wait_for_pose(self, pose: list) -> None:
        numbers = ", ".join(repr(number) for number in pose)
        self.wait_until(f"[{numbers}].every((number, index) => number === playground.pose()[index])")

    def mouse(self, kind: str, x: float, y: float, button: str = "left", modifiers: int = 0) -> None:
        pressed = {"left": 1, "right": 2, "none": 0}[button] if kind != "mouseReleased" else 0
        more = {"button": button, "buttons": pressed, "clickCount": 1, "modifiers": modifiers}
        self.browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def on_part(self, point: list) -> tuple:
        """Where a point of the part, in its own frame, is on the screen."""
        place = self.evaluate(f"playground.partOnScreen({json.dumps(point)})")
        return place["x"], place["y"]

    def drag(self, way: list, button: str = "left", modifiers: int = 0, release: bool = True) -> None:
        """Drags by the mouse from place to place, and waits at the end until the part is at rest."""
        self.mouse("mouseMoved", *way[0], button="none")
        self.mouse("mousePressed", *way[0], button, modifiers)
        self.wait_until("playground.app.hand.grip !== undefined")
        for x, y in way[1:]:
            self.mouse("mouseMoved", x, y, button, modifiers)
            time.sleep(0.01)
        self.evaluate("playground.atRest()")
        if release:
            self.mouse("mouseReleased", *way[-1], button, modifiers)
            self.wait_until("playground.app.hand.grip === undefined")
            self.evaluate("playground.atRest()")  # an update may be under way

    def pull(self, point: list, right: float, down: float, steps: int = 20, **more: object) -> None:
        x, y = self.on_part(point)
        self.drag([(x + right * i / steps, y + down * i / steps) for i in range(steps + 1)], **more)

    def press(self, key: str, modifiers: int = 0) -> None:
        for kind in ["rawKeyDown", "keyUp"]:
            self.browser.call("Input.dispatchKeyEvent", type=kind, key=key, code=key, modifiers=modifiers)

    def picture(self, name: str) -> list:
        png = self.browser.screenshot(scale=0.5)
        (folder / f"{name}.png").write_bytes(png)
        return pixels(png)

    def prove(self) -> str:
        """The words of the proof."""
        self.click("#prove")
        self.wait_until("document.getElementById('proof').children.length > 0", 300)
        return self.text("#proof")

    def saved(self) -> pathlib.Path:
        """The files of the recorded hand, unpacked."""
        for old in folder.glob("hand-*.zip"):
            old.unlink()
        self.click("#save")
        deadline = time.monotonic() + 30
        while not any(map(zipfile.is_zipfile, folder.glob("hand-*.zip"))):  # a browser names the file before it is whole
            self.assertLess(time.monotonic(), deadline, "nothing was downloaded")
            time.sleep(0.05)
        (file,) = folder.glob("hand-*.zip")
        unpacked = folder / file.stem
        with zipfile.ZipFile(file) as packed:
            self.assertIsNone(packed.testzip())
            packed.extractall(unpacked)
        return unpacked

    def replayed(self, body: str, fixed: list) -> list:
        """Replays the saved hand natively, and proves the saved way. Returns the poses of the replay."""
        saved = self.saved()
        command = next(line for line in (saved / "README.txt").read_text().splitlines() if line.startswith("chasles drag "))
        self.assertIn(command.removeprefix("chasles"), (saved / "drag.sh").read_text())
        options = shlex.split(command[command.index("--margin") :])
        arguments = ["scene.json", "--body", body, "--goals", "hand.csv", "--out", "out.csv", "--page", "replay.html", *options]
        replay = run("drag", *arguments, cwd=saved)
        self.assertIn(replay.returncode, (0, 1), replay.stderr)
        self.assertTrue((saved / "replay.html").stat().st_size > 100_000)
        for other in fixed:
            proof = run("path", f"{body.replace(' ', '-')}.obj", f"{other.replace(' ', '-')}.obj", "--poses", "way.csv", "--json", cwd=saved)
            self.assertEqual(json.loads(proof.stdout)["verdict"], "clear", proof.stderr)
        goals, reached = (poses_in((saved / f"{name}.csv").read_text()) for name in ("hand", "reached"))
        out = [row[1:8] for row in poses_in((saved / "out.csv").read_text())]
        self.assertEqual(len(goals), len(out))
        self.assertEqual(len(reached), len(out))
        self.assertEqual(reached[-1], self.pose())
        return [reached, out]

    def drop(self, *files: pathlib.Path) -> None:
        """Files dropped on the picture, as from a file manager."""
        data = {"items": [], "files": [str(file) for file in files], "dragOperationsMask": 1}
        for kind in ["dragEnter", "dragOver", "drop"]:
            self.browser.call("Input.dispatchDragEvent", type=kind, x=200, y=200, data=data)


def main() -> int:
    if not chromium:
        print("skipped: no chromium")
        return 77
    folder.mkdir(parents=True, exist_ok=True)
    return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1
