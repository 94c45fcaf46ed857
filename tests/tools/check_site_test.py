#!/usr/bin/env python3
"""The check of the site can fail: each test breaks one rule in a site of two pages."""

import unittest

from small_tree import SmallTree

import check_site  # in the folder that small_tree adds

SOUND = {
    "index.html": '<h1 id="title">T</h1><a href="a/b.html#there">b</a> <a href="https://example.org">else</a>'
    '<img src="a.png" alt="A"><link rel="stylesheet" href="s.css"><link rel="canonical" href="https://example.org/">',
    "a/b.html": '<p id="there"></p><a href="../index.html">up</a><a href="#there">here</a><iframe title="F" src="c.html"></iframe>',
    "a/c.html": "<p></p>",
    "a.png": "",
    "s.css": "p { background: url(a.png) } i { background: url(data:image/png;base64,AA) }",
}


class CheckSite(SmallTree):
    sound = SOUND
    check = check_site

    def assert_fault(self, text: str, reason: str, file: str = "a/c.html") -> None:
        found = self.violations_with(**{file: text})
        self.assertEqual(len(found), 1, found)
        self.assertRegex(found[0], f"^{file}: .*{reason}")

    def test_sound_site_passes(self):
        self.assertEqual(self.violations_with(), [])

    def test_missing_page_is_found(self):
        self.assert_fault('<a href="d.html">d</a>', "d.html leads nowhere")

    def test_folder_is_no_page(self):
        self.assert_fault('<a href="../a/">a</a>', "leads nowhere")

    def test_page_outside_of_the_site_is_found(self):
        self.assert_fault('<a href="../../index.html">a</a>', "leads nowhere")

    def test_missing_place_is_found(self):
        self.assert_fault('<a href="b.html#here">b</a>', "no such place in a/b.html")

    def test_missing_picture_is_found(self):
        self.assert_fault('<img src="b.png" alt="B">', "b.png leads nowhere")

    def test_what_comes_from_elsewhere_is_found(self):
        self.assert_fault('<script src="https://example.org/a.js"></script>', "from elsewhere")
        self.assert_fault('<link rel="stylesheet" href="//example.org/a.css">', "from elsewhere")

    def test_styles_that_load_from_elsewhere_are_found(self):
        self.assert_fault("@import 'https://example.org/a.css';", "from elsewhere", "s.css")
        self.assert_fault("p { background: url('b.png') }", "b.png leads nowhere", "s.css")

    def test_picture_without_a_text_and_frame_without_a_title_are_found(self):
        self.assert_fault('<img src="../a.png">', "has no alt")
        self.assert_fault('<iframe src="b.html"></iframe>', "has no title")

    def test_equal_ids_are_found(self):
        self.assert_fault('<p id="x"></p><p id="x"></p>', "'x' is there 2 times")


if __name__ == "__main__":
    unittest.main()
