#!/usr/bin/env python3
"""The check of the table of abilities can fail: each test breaks one thing."""

import pathlib
import unittest

import small_tree  # noqa: F401  adds the folder of the tools

import check_abilities as check

HEADER = "| ability | C++ | Python | command line | JavaScript | page |\n|---|---|---|---|---|---|\n"
ROW = "| first | `first_contact` | `load` | `chasles check --margin` | `firstContact` | no (answer) |\n"
REASONS = "\n- (answer) A page asks nothing.\n"
ROOT = pathlib.Path(__file__).parents[2]
COMMANDS = {"check": {"--help", "--margin"}}


def table(rows: str, reasons: str = REASONS) -> check.Table:
    return check.Table(HEADER + rows + reasons)


class CheckAbilities(unittest.TestCase):
    def test_a_sound_table_passes(self):
        self.assertEqual(table(ROW).faults, [])

    def test_an_empty_cell_is_found(self):
        self.assertIn("neither a name", table(ROW.replace("`load`", "yes")).faults[0])

    def test_a_missing_cell_is_found(self):
        self.assertIn("4 cells", table(ROW.replace("| `load` ", "")).faults[0])

    def test_a_reason_that_is_not_given_or_not_used_is_found(self):
        self.assertIn("(answer) is not given", table(ROW, "").faults[0])
        self.assertIn("(old) is not used", table(ROW, REASONS + "- (old) Gone.\n").faults[0])

    def test_a_command_or_option_that_is_not_there_is_found(self):
        self.assertEqual(check.missing_names(table(ROW), ROOT, COMMANDS), [])
        self.assertIn("no --hold", check.missing_names(table(ROW.replace("--margin", "--hold")), ROOT, COMMANDS)[0])
        self.assertIn("no command", check.missing_names(table(ROW.replace("check", "chock")), ROOT, COMMANDS)[0])
        self.assertIn("nothing_here", check.missing_names(table(ROW.replace("`load`", "`nothing_here`")), ROOT, COMMANDS)[0])

    def test_an_option_or_name_in_no_row_is_found(self):
        found = check.missing_rows(table(ROW), ROOT, {"check": {"--margin", "--any"}, "batch": set()})
        self.assertIn("docs/abilities.md: --any of chasles check is in no row", found)
        self.assertIn("docs/abilities.md: chasles batch is in no row", found)
        self.assertIn("docs/abilities.md: Python: Scene is in no row", found)
        self.assertIn("docs/abilities.md: JavaScript: leastDistance is in no row", found)


if __name__ == "__main__":
    unittest.main()
