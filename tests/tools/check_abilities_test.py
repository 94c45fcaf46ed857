#!/usr/bin/env python3
"""The check of the abilities can fail: each test breaks one cell in a small tree."""

import unittest

from small_tree import SmallTree

import check_abilities  # in the folder that small_tree adds

TABLE = "| ability | C++ | Python | command line | JavaScript |\n|---|---|---|---|---|\n"
ROW = "| hold | `hold` | `hold` | `--hold` | (1) |\n"
REASONS = "\n1. It needs none.\n"


class CheckAbilities(SmallTree):
    sound = {
        "docs/abilities.md": TABLE + ROW + REASONS,
        "chasles/query/options.h": "double hold = 0;\n",
        "python/src/options.cpp": '"hold"_a\n',
        "cli/options.cpp": '"--hold"\n',
        "javascript/chasles/index.d.ts": "margin?: number;\n",
    }
    check = check_abilities

    def test_sound_tree_passes(self):
        self.assertEqual(self.violations_with(), [])

    def assert_table(self, row: str, reason: str, reasons: str = REASONS):
        self.assert_violation("docs/abilities.md", TABLE + row + reasons, reason)

    def test_names_that_a_face_lacks_are_found(self):
        self.assert_table("| hold | `held` | `hold` | `--hold` | (1) |\n", "C\\+\\+: `held` does not exist there")
        self.assert_table("| hold | `hold` | `hol` | `--hold` | (1) |\n", "Python: `hol` does not exist there")
        self.assert_table("| hold | `hold` | `hold` | `-hold` | (1) |\n", "command line: `-hold` does not exist there")

    def test_cells_without_a_reason_are_found(self):
        self.assert_table("| hold | `hold` | `hold` | `--hold` | (2) |\n", "there is no reason 2", "\n2 reasons\n")
        self.assert_table("| hold | `hold` | `hold` | `--hold` | |\n", "'' is neither a name nor a reason", "\n")

    def test_reasons_without_a_cell_are_found(self):
        self.assert_table(ROW, "reason 2 has no cell", REASONS + "2. Nobody asks.\n")

    def test_missing_faces_are_found(self):
        self.assert_table("| hold | `hold` | `hold` | `--hold` |\n", "has 3 faces instead of 4", "\n")


if __name__ == "__main__":
    unittest.main()
