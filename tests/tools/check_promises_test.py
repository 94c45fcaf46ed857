#!/usr/bin/env python3
"""The check of the promises can fail: each test breaks one rule in a small tree."""

import unittest

from small_tree import SmallTree

import check_promises  # in the folder that small_tree adds

SOUND = {
    "docs/promises.md": "# Promises\n\n1. **Kept** (`Box.IsClosed`,\n   [01](notes/01.md)).\n2. **Also** ([01](notes/01.md)).\n",
    "docs/notes/01.md": "See `tests/mesh/box_test.cpp` and `Box.*`.\n",
    "tests/mesh/box_test.cpp": "TEST(Box, IsClosed) {\n}\n",
}


class CheckPromises(SmallTree):
    sound = SOUND
    check = check_promises

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
