#!/usr/bin/env python3
"""The check of the promises can fail: each test breaks one rule in a small tree."""

import unittest

from small_tree import SmallTree

import check_promises  # in the folder that small_tree adds

SOUND = {
    "docs/promises.md": "# Promises\n\n1. **Kept** (`Box.IsClosed`,\n   [01](notes/01.md)).\n"
    "2. **Also** ([01](notes/01.md)).\n",
    "docs/notes/01.md": "See `tests/mesh/box_test.cpp` and `Box.*`.\n",
    "tests/mesh/box_test.cpp": "TEST(Box, IsClosed) {\n}\n",
    "chasles/mesh/box.h": "struct ClosedBox {\n    double side_length;\n};  // once a FoldedBox\n",
    "chasles/mesh/edge.h": "int count_edges();\n",
    "tests/tools/check_promises_test.py": "made_up_here = 1\n",
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

    def assert_sound(self, text: str) -> None:
        self.assertEqual(self.violations_with(**{"docs/notes/01.md": text}), [])

    def test_stems_folders_patterns_and_made_folders_are_sound(self):
        self.assert_sound("`chasles/mesh/box`, `chasles/mesh`, `tests/mesh/`, `tests/mesh/*_test.cpp`\n")
        self.assert_sound("`bench/results/`, `docs/decisions/NNNN-title.md`\n")

    def test_missing_stem_is_found(self):
        self.assert_violation("docs/notes/01.md", "`chasles/mesh/ball`\n", "no file chasles/mesh/ball")

    def test_missing_file_in_a_command_is_found(self):
        self.assert_violation("docs/notes/01.md", "`python3 tools/run.py --fast`\n", "no file tools/run.py")

    def test_missing_file_without_its_folder_is_found(self):
        self.assert_sound("`box.h`\n")
        self.assert_violation("docs/notes/01.md", "`ball.h`\n", "no file ball.h")

    def test_code_names_of_the_sources_are_sound(self):
        self.assert_sound("`ClosedBox`, `ClosedBox::side_length`, `ClosedBox.side_length`, `count_edges()`\n")

    def test_words_commands_and_other_libraries_are_no_code_names(self):
        self.assert_sound("`time`, `--max-turn`, `make check`, `FILE`, `build/x_y/<name>_z`, `std::made_up`, `OBB`\n")
        self.assert_sound("`fast_float`, `_in_world`\n")

    def test_missing_code_name_is_found(self):
        for name in ["OpenBox", "OpenBox::volume", "box::volume", "fold_box", "fold()", "Box.volume", "made_up_here"]:
            with self.subTest(name):
                reason = "do not have " + name.replace("()", r"\(\)")
                self.assert_violation("docs/notes/01.md", f"`{name}`\n", reason)

    def test_code_name_with_arguments_is_found(self):
        self.assert_violation("docs/notes/01.md", "`fold_box(side, {.margin = 1})`\n", "do not have fold_box")

    def test_member_of_another_type_is_found(self):
        self.assert_violation("docs/notes/01.md", "`ClosedBox::count_edges`\n", "do not have ClosedBox::count_edges")

    def test_name_that_only_a_comment_has_is_found(self):
        self.assert_violation("docs/notes/01.md", "`FoldedBox`\n", "do not have FoldedBox")

    def test_span_over_two_lines_is_found(self):
        self.assert_violation("docs/notes/01.md", "Text `tools/run.py\n--fast` text.\n", "no file tools/run.py")

    def test_names_in_code_blocks_and_historical_documents_are_free(self):
        self.assert_sound("```\n`fold_box`\n```\n")
        self.assertEqual(self.violations_with(**{"CHANGELOG.md": "`fold_box`\n"}), [])

    def test_promise_without_proof_is_found(self):
        text = "1. **Kept** (`Box.IsClosed`).\n2. **Bare.** Trust us.\n\n## Other\n\n[01](notes/01.md)\n"
        self.assert_violation("docs/promises.md", text, "without a test or a note")

    def test_empty_page_is_found(self):
        self.assert_violation("docs/promises.md", "# Promises\n", "promises nothing")


if __name__ == "__main__":
    unittest.main()
