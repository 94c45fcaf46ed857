#!/usr/bin/env python3
"""The check of the links can fail: each test breaks one link in a small tree."""

import unittest

from small_tree import SmallTree

import check_links  # in the folder that small_tree adds

SOUND = {
    "README.md": "# Title\n\nSee [one](docs/01.md), [there](docs/01.md#the-end), [docs](docs), [top](#title)\n"
    "and [elsewhere](https://example.org/x#y). ![A picture](docs/a.png)\n",
    "docs/01.md": "# One\n\n[back](../README.md#title) `[no](link.md)`\n\n    [no](link.md)\n\n## The *end*\n\n## The end\n",
    "docs/a.png": "",
}


class CheckLinks(SmallTree):
    sound = SOUND
    check = check_links

    def test_sound_tree_passes(self):
        self.assertEqual(self.violations_with(), [])

    def test_missing_file_is_found(self):
        self.assert_violation("docs/02.md", "[03](03.md)\n", "03.md leads nowhere")

    def test_missing_picture_is_found(self):
        self.assert_violation("docs/02.md", "![b](b.png)\n", "b.png leads nowhere")

    def test_missing_heading_is_found(self):
        self.assert_violation("docs/02.md", "[x](01.md#the-start)\n", "01.md has no heading 'the-start'")

    def test_missing_heading_of_the_same_file_is_found(self):
        self.assert_violation("docs/02.md", "# Two\n\n[x](#three)\n", "02.md has no heading 'three'")

    def test_equal_headings_are_counted(self):
        self.assertEqual(self.violations_with(**{"docs/02.md": "[x](01.md#the-end-1)\n"}), [])
        self.assert_violation("docs/02.md", "[x](01.md#the-end-2)\n", "no heading 'the-end-2'")

    def test_link_over_two_lines_is_found(self):
        self.assert_violation("docs/02.md", "[two\nlines](03.md)\n", "03.md leads nowhere")

    def test_link_with_code_in_its_text_is_found(self):
        self.assert_violation("docs/02.md", "[`code`](03.md)\n", "03.md leads nowhere")

    def test_link_out_of_the_repository_is_found(self):
        self.assert_violation("docs/02.md", "[out](../../x.md)\n", "leaves the repository")

    def test_code_and_what_is_built_are_free(self):
        self.assertEqual(self.violations_with(**{"docs/02.md": "```\n[x](y.md)\n```\n", "build/a.md": "[x](y.md)\n"}), [])


if __name__ == "__main__":
    unittest.main()
