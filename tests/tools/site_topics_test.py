#!/usr/bin/env python3
"""Every public header, and every public name of Python, has a page of the reference on the site; and tables have their plots."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "site"))

import plots  # noqa: E402
import reference_cpp  # noqa: E402
import reference_python  # noqa: E402


class SiteTopics(unittest.TestCase):
    def test_every_public_header_has_a_topic(self):
        headers = reference_cpp.headers_of_topics(ROOT)
        self.assertIn("chasles/query/first_contact.h", headers)
        self.assertEqual([header for header in headers if not (ROOT / header).is_file()], [])

    def test_a_header_without_a_topic_is_refused(self):
        title, headers = reference_cpp.TOPICS["scenes"]
        reference_cpp.TOPICS["scenes"] = (title, headers[1:])
        self.addCleanup(reference_cpp.TOPICS.update, scenes=(title, headers))
        with self.assertRaisesRegex(SystemExit, "no topic has chasles/scene/scene.h"):
            reference_cpp.headers_of_topics(ROOT)

    def test_every_public_name_of_python_has_one_topic(self):
        names = [name for _, names in reference_python.TOPICS.values() for name in names]
        self.assertEqual(sorted(names), sorted(reference_python.public_names(ROOT)))

    def test_tables_of_the_documents_are_plotted(self):
        for name, draw in plots.PLOTS.items():
            with self.subTest(name):
                self.assertGreater(draw(ROOT).count("<circle"), 4)

    def test_a_table_that_is_gone_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "0 tables that begin with"):
            plots.table(ROOT / "README.md", "| no such head |")


if __name__ == "__main__":
    unittest.main()
