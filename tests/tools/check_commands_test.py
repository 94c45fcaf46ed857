#!/usr/bin/env python3
"""The check of the lists of commands can fail: each test breaks one thing."""

import unittest

import small_tree  # noqa: F401  adds the folder of the tools

import check_commands as check

HELPS = {"check": "  MOVING FILE\n  --seconds T  a limit\n", "draw": "  --out FILE  a file\n", "acm": "  --seconds T\n  --out FILE\n"}
COMMANDS = (
    "# The command line\n\n    chasles check MOVING\n    chasles draw  FILE\n    chasles acm ROBOT\n\n## check\n\n"
    "**`--seconds T`** (`check`): a limit.\n\n**Files that commands write** (`draw`,\n`acm --out`): whole.\n"
)
FILES = "`check` and `draw` print a warning where files state units that differ."


class CheckCommands(unittest.TestCase):
    def faults(self, commands: str = COMMANDS, files: str = FILES) -> list[str]:
        return check.faults_of(commands, files, HELPS)

    def test_sound_lists_pass(self):
        self.assertEqual(self.faults(), [])

    def test_a_command_that_is_left_out_is_found(self):
        self.assertEqual(self.faults(COMMANDS.replace("    chasles draw  FILE\n", "")), ["docs/command-line.md: the synopsis leaves out draw"])
        for before, after, name in [("(`check`)", "(`other`)", "check"), ("`draw`,\n", "", "draw"), ("`acm --out`", "`x`", "acm")]:
            self.assertTrue(self.faults(COMMANDS.replace(before, after))[0].endswith(f"leaves out {name}"))
        self.assertTrue(self.faults(files=FILES.replace("`check`", "`path`"))[0].endswith("leaves out check"))

    def test_a_list_that_is_gone_is_found(self):
        self.assertIn("there is no list", self.faults(COMMANDS.replace("**Files", "Files"))[0])
        self.assertIn("there is no list", self.faults(files="")[0])


if __name__ == "__main__":
    unittest.main()
