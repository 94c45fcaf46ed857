#!/usr/bin/env python3
"""The check of the promises can fail: each rule is broken once in a small tree made for it."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
import check_promises  # noqa: E402

SOUND = {
    "docs/promises.md": "# Promises\n\n1. **Kept** (`Box.IsClosed`,\n   [01](notes/01.md)).\n2. **Also** ([01](notes/01.md)).\n",
    "docs/notes/01.md": "See `tests/mesh/box_test.cpp` and `Box.*`.\n",
    "tests/mesh/box_test.cpp": "TEST(Box, IsClosed) {\n}\n",
}


class CheckPromises(unittest.TestCase):
    def violations_with(self, **changes: str) -> list[str]:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (SOUND | changes).items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return check_promises.violations(root)

    def assert_violation(self, file: str, text: str, reason: str) -> None:
        found = self.violations_with(**{file: text})
        self.assertEqual(len(found), 1, found)
        self.assertRegex(found[0], f"^{file}:[0-9]+: .*{reason}")

    def test_sound_tree_passes(self):
        self.assertEqual(self.violations_with(), [])

    def test_missing_test_is_found(self):
        self.assert_violation("docs/notes/01.md", "`Box.IsOpen`\n", "no test Box.IsOpen")

    def test_missing_suite_is_found(self):
        self.assert_violation("docs/notes/01.md", "`Ball.*`\n", "no test Ball")

    def test_missing_file_is_found(self):
        self.assert_violation("docs/notes/01.md", "`tests/mesh/ball_test.cpp`\n", "no file")

    def test_broken_link_is_found(self):
        self.assert_violation("docs/notes/01.md", "[02](02.md)\n", "leads nowhere")

    def test_promise_without_proof_is_found(self):
        text = "1. **Kept** (`Box.IsClosed`).\n2. **Bare.** Trust us.\n\n## Other\n\n[01](notes/01.md)\n"
        self.assert_violation("docs/promises.md", text, "without a test or a note")

    def test_empty_page_is_found(self):
        self.assert_violation("docs/promises.md", "# Promises\n", "promises nothing")


if __name__ == "__main__":
    unittest.main()
