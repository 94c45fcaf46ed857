#!/usr/bin/env python3
"""The program notices what it looks for: programs that break one promise each stand in for the command line.

Usage: abuse_test.py CHASLES. Each stand-in is a script around the true program.
"""

import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ABUSE = Path(__file__).parent
CHASLES = str(Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else ""

NAME_OF_OUTPUT = """
for word; do
    case $last in --out | --page | --save) output=$word ;; esac
    last=$word
done
"""

# The first run keeps the rows beside the program. Each other run copies them row by row, without another process.
WRITES_IN_PLACE = """
[ -n "$output" ] || exec "$chasles" "$@"
if [ ! -f "$0.rows" ]; then
    "$chasles" "$@"
    status=$?
    cp "$output" "$0.rows"
    exit $status
fi
: > "$output"
while IFS= read -r row; do echo "$row" >> "$output"; done < "$0.rows"
exit 1
"""


class StandIn(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def abused(self, script: str, only: str, *counts: str) -> subprocess.CompletedProcess[str]:
        program = self.folder / "stand-in"
        program.write_text(f"#!/bin/sh\nchasles='{CHASLES}'\n{script}\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        command = [sys.executable, str(ABUSE), str(program), "--seed", "1", "--jobs", "2", "--only", only, *counts]
        return subprocess.run([*command, "--keep", str(self.folder / "kept")], capture_output=True, text=True)

    def expect_broken(self, fault: str, script: str, only: str, *counts: str) -> None:
        ended = self.abused(script, only, *counts)
        self.assertEqual(ended.returncode, 1, ended.stdout + ended.stderr)
        self.assertIn("BROKEN " + only, ended.stdout)
        self.assertIn(fault, ended.stdout)
        self.assertTrue(any((self.folder / "kept").glob("*/what-broke.txt")))

    def test_the_program_itself_passes(self) -> None:
        for only, *counts in [("options",), ("names/acm",), ("streams/info",), ("damage/obj", "--damaged", "20")]:
            ended = self.abused('exec "$chasles" "$@"', only, *counts)
            self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)

    def test_an_input_is_overwritten(self) -> None:
        script = NAME_OF_OUTPUT + '[ -z "$output" ] || echo new > "$output"; exec "$chasles" "$@"'
        self.expect_broken("changed ['arm.urdf']", script, "names/acm")

    def test_rows_are_written_in_place(self) -> None:
        script = NAME_OF_OUTPUT + WRITES_IN_PLACE
        self.expect_broken("out__out has neither its former content nor its new one", script, "kills/batch", "--kills", "8")

    def test_a_full_disk_goes_unnoticed(self) -> None:
        self.expect_broken("status 0 instead of 2", '"$chasles" "$@" 2>/dev/null; exit 0', "disks/acm", "--disks", "3")

    def test_a_closed_stream_gets_into_a_file(self) -> None:
        script = NAME_OF_OUTPUT + '"$chasles" "$@"; status=$?; echo 2>/dev/null || echo answer > "$output"; exit $status'
        self.expect_broken("has other content than without abuse", script, "streams/acm")

    def test_an_interruption_is_ignored(self) -> None:
        script = 'trap "" INT TERM; [ "$1" = --version ] || sleep 2; exit 0'
        self.expect_broken("seconds after the signal", script, "interrupts/check", "--interrupts", "1")

    def test_an_interruption_is_not_reported(self) -> None:
        script = '"$chasles" "$@" & trap "kill -KILL $!; exit 130" INT TERM; wait $!'
        self.expect_broken("no line says that it was interrupted", script, "interrupts/check", "--interrupts", "2")

    def test_a_crash(self) -> None:
        script = 'case "$*" in *damaged*) kill -SEGV $$ ;; esac; exec "$chasles" "$@"'
        self.expect_broken("ended by SIGSEGV", script, "damage/off", "--damaged", "5")

    def test_an_error_of_two_lines(self) -> None:
        script = '"$chasles" "$@" || { status=$?; [ $status = 1 ] || echo "see above" >&2; exit $status; }'
        self.expect_broken("no single error line", script, "damage/off", "--damaged", "20")

    def test_a_new_option_that_names_a_file(self) -> None:
        script = '"$chasles" "$@"; status=$?; [ "$*" != "view --help" ] || echo "  --plot FILE  a picture"; exit $status'
        self.expect_broken("view --plot names a file", script, "options/help")

    def test_questions_that_are_not_answered(self) -> None:
        ended = self.abused("exit 2", "streams/info")
        self.assertEqual(ended.returncode, 1)
        self.assertIn("BROKEN whole inputs: info: status 2", ended.stdout)


if __name__ == "__main__":
    unittest.main()
