#!/usr/bin/env python3
"""The check of the documents' commands can fail: each test shows one wrong thing."""

import pathlib
import tempfile
import unittest

import commands

PROGRAM = """#!/bin/sh
echo "CONTACT at time 0.5000000000001"
echo "  work  12 box pairs"
cat "$1"
"""


class Commands(unittest.TestCase):
    def faults(self, document: str) -> list[str]:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "files").mkdir()
            (folder / "chasles").write_text(PROGRAM, encoding="utf-8")
            (folder / "chasles").chmod(0o755)
            (folder / "page.md").write_text(document, encoding="utf-8")
            return commands.faults(str(folder / "chasles"), folder / "files", folder / "page.md")

    def shown(self, text: str) -> str:
        return "    $ cat body.obj\n    v 0\n    $ chasles body.obj\n" + text

    def test_what_is_printed_is_sound(self):
        self.assertEqual(self.faults(self.shown("    CONTACT at time 0.5\n      work  13 box pairs\n    v 0\n")), [])

    def test_an_ellipsis_stands_for_lines(self):
        self.assertEqual(self.faults(self.shown("    CONTACT at time 0.5\n    ...\n")), [])
        self.assertEqual(self.faults(self.shown("    ...\n    v 0\n")), [])

    def test_another_number_is_found(self):
        self.assertIn("page.md:3", self.faults(self.shown("    CONTACT at time 0.6\n    ...\n"))[0])

    def test_another_word_is_found(self):
        self.assertEqual(len(self.faults(self.shown("    CLEAR at time 0.5\n    ...\n"))), 1)

    def test_a_missing_line_is_found(self):
        self.assertEqual(len(self.faults(self.shown("    CONTACT at time 0.5\n    v 0\n"))), 1)

    def test_a_document_without_commands_is_found(self):
        self.assertEqual(len(self.faults("text\n")), 1)


if __name__ == "__main__":
    unittest.main()
