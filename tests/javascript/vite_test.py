#!/usr/bin/env python3
"""The npm package in Vite 5 to 7, as a project has it after `npm install`: in development, and in a build. No option is set.

Usage: vite_test.py PROJECT CHROMIUM. PROJECT is a folder in which the package is installed (tools/wasm_check.sh makes it). Exit
status 77 means skipped, because there is no browser.
"""

import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "view"))
from devtools import Browser  # noqa: E402

project = pathlib.Path(sys.argv[1]).resolve()
chromium = sys.argv[2] if len(sys.argv) > 2 else ""
ANSWER = {"verdict": "contact", "time": 0.6398059071839116, "byWorkers": 9 * [0.6398059071839116]}


class Server:
    """`vite dev` or `vite preview` at a free port."""

    def __init__(self, command: list[str], folder: pathlib.Path):
        self._process = subprocess.Popen(
            [*command, "--host", "127.0.0.1", "--port", "0"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )

    def __enter__(self) -> str:
        said = ""
        for line in self._process.stdout:
            said += re.sub(r"\x1b\[[0-9;]*m", "", line)
            if found := re.search(r"http://127\.0\.0\.1:\d+", said):
                return found[0]
        raise RuntimeError(said)

    def __exit__(self, *_: object) -> None:
        self._process.terminate()
        self._process.wait()
        self._process.stdout.close()


class InVite(unittest.TestCase):
    def answer(self, address: str) -> tuple[dict, bool]:
        """What the page answers, and whether it fetched the module."""
        with Browser(chromium, 400, 300, patience=90) as browser:
            browser.open(address, "!!window.isDone")
            answer = browser.evaluate("window.answer")
            requests = [e["params"]["request"]["url"] for e in browser.events if e["method"] == "Network.requestWillBeSent"]
        return answer, any(url.split("?")[0].endswith(".wasm") for url in requests)

    def check(self, version: int) -> None:
        folder = project / f"in_vite_{version}"
        folder.mkdir(exist_ok=True)
        (folder / "package.json").write_text('{ "private": true, "type": "module" }\n')
        (folder / "index.html").write_text('<!doctype html><link rel="icon" href="data:,"><script type="module" src="/main.js"></script>\n')
        (folder / "main.js").write_text('import { load } from "chasles";\nimport { ask } from "./question.js";\nask(load, {}, {});\n')
        (folder / "question.js").write_text((project / "question.mjs").read_text())
        vite = ["node", str(project / f"node_modules/vite{version}/bin/vite.js")]
        subprocess.run([*vite, "build", "--logLevel", "warn"], cwd=folder, check=True)
        for mode, fetches in [("dev", False), ("preview", True)]:
            with Server([*vite, mode], folder) as address:
                for round in ["a new cache", "a reload"]:
                    answer, has_fetched = self.answer(address)
                    self.assertEqual({key: answer.get(key) for key in ANSWER}, ANSWER, f"{mode}, {round}: {answer}")
                    self.assertEqual(has_fetched, fetches, mode)

    def test_vite_5(self) -> None:
        self.check(5)

    def test_vite_6(self) -> None:
        self.check(6)

    def test_vite_7(self) -> None:
        self.check(7)


def main() -> int:
    if not chromium:
        print("skipped: no chromium")
        return 77
    return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
