"""Tests of tree checks run on a small valid tree. Each test changes one file."""

import pathlib
import sys
import tempfile
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))


class SmallTree(unittest.TestCase):
    sound: dict[str, str]  # the text of each file
    check: types.ModuleType  # its `violations(root)` lists what is wrong

    def violations_with(self, **changes: str) -> list[str]:
        """The violations that the check finds after the files in `changes` have new texts."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (self.sound | changes).items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return self.check.violations(root)

    def assert_violation(self, file: str, text: str, reason: str) -> None:
        found = self.violations_with(**{file: text})
        self.assertEqual(len(found), 1, found)
        self.assertRegex(found[0], f"^{file}:[0-9]+: .*{reason}")
