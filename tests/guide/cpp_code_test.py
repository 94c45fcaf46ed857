#!/usr/bin/env python3
"""What is cut out of the guide is the code, and what its comments say."""

import unittest

import cpp_code


class CppCode(unittest.TestCase):
    def test_comments_behind_prints_are_expected(self):
        code = 'std::puts("a"); // a\nstd::printf("%d",\n            f(1)); // 2 // 3\nint i = 0; // no print\n'
        self.assertEqual(cpp_code.expected_of(code), "a\n2 // 3\n")
        self.assertEqual(cpp_code.expected_of('std::puts("a");\n    // a\n'), "a\n")

    def test_prints_without_a_comment_are_not_expected(self):
        self.assertEqual(cpp_code.expected_of('std::puts("never");\nint i; // other\n'), "")
        self.assertEqual(cpp_code.expected_of('std::puts("never"); break;\n// other\n'), "")

    def test_a_document_without_a_program_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "needs one block of CMake"):
            cpp_code.files_of("```cpp\nint i = 0;\n```\n")


if __name__ == "__main__":
    unittest.main()
