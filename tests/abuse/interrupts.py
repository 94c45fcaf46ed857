"""Ctrl-C at random moments of questions that last seconds: the program ends at once, says so, and keeps what it has."""

import shutil
import signal
import time
from collections.abc import Iterable
from pathlib import Path

from cases import Case, Counts, Kind, Outcome
from kills import PRECIOUS
from questions import QUESTIONS, Question
from runs import Ended, Running, contents
from setting import Setting, make_folders

LATEST = 1.5  # seconds after the start
READING = 0.1  # seconds in which most inputs are read
TRIES = 5  # other programs on the machine may delay one
INTERRUPTED = 130
SILENT = "ended by the signal itself"

ASKED = {
    **{name: question for name, question in QUESTIONS.items() if name != "info-robot"},
    "info": Question("info", ("info", "big.obj"), ("big.obj",)),
}


def cases(counts: Counts) -> Iterable[Case]:
    return (Case("interrupts", name, number) for name in ASKED for number in range(counts.interrupts))


def run_case(setting: Setting, case: Case, folder: Path) -> Outcome:
    """Tries the same moment again while the end comes late, or before the program could say anything."""
    for attempt in range(TRIES):
        shutil.rmtree(folder)
        folder.mkdir()
        outcome = interrupt(setting, case, folder)
        is_late = outcome.slowest > setting.longest_end + setting.start_seconds
        if not is_late and not outcome.notes[SILENT]:
            return outcome
    outcome.expect(not is_late, f"ended {outcome.slowest:.3f} seconds after the signal")
    return outcome


def interrupt(setting: Setting, case: Case, folder: Path) -> Outcome:
    rng = case.random(setting.seed)
    outcome = Outcome()
    question = ASKED[case.name]
    names = question.own_names()
    setting.copy_world("slow", folder)
    make_folders(question, names, folder)
    for name, _ in question.written(names):
        (folder / name).write_bytes(PRECIOUS)
    moment = rng.uniform(0, LATEST if rng.random() < 0.75 else READING)
    number = signal.SIGINT if rng.random() < 0.75 else signal.SIGTERM
    command = question.command(setting.program, "slow", names)
    outcome.command = f"({number.name} after {moment:.3f} s) " + " ".join(command)
    running = Running(command, folder)
    time.sleep(moment)
    sent = time.monotonic()
    running.send(number)
    ended = running.wait()
    outcome.slowest = running.begun + ended.seconds - sent
    if outcome.slowest <= setting.longest_end and ended.status in (0, 1):
        outcome.notes["ended before"] += 1
        outcome.slowest = 0
    elif moment < 2 * setting.start_seconds and ended.status == -number:
        outcome.notes["interrupted while it started"] += 1
    else:
        outcome.notes[SILENT if ended.status == -number else "interrupted"] += 1
        check_end(outcome, ended)
        new = [setting.whole(*whole).files for whole in wholes(case)]
        check_files(outcome, question, names, new[0] if new else {}, folder)
    return outcome


def check_end(outcome: Outcome, ended: Ended) -> None:
    how = ended.crash or f"status {ended.status}"
    outcome.expect(ended.status == INTERRUPTED, f"{how} instead of {INTERRUPTED}")
    is_told = len(ended.errors) == 1 and ended.errors[0].startswith("chasles: interrupted")
    outcome.expect(is_told, f"no line says that it was interrupted: {ended.errors}")


def check_files(
    outcome: Outcome, question: Question, names: dict[str, str], new: dict[str, bytes], folder: Path
) -> None:
    after = contents(folder)
    for name, output in question.written(names):
        is_sound = after.get(name) in (PRECIOUS, new.get(name, PRECIOUS))
        outcome.expect(is_sound, f"{name} has neither its former content nor its new one")
        part = after.get(name + ".part")
        if output.has_rows:
            outcome.expect(part is None or part.endswith(b"\n"), f"the last row of {name}.part is torn")
        else:
            outcome.expect(part is None, f"{name}.part stays")


WORLDS = ("small", "slow")


def wholes(case: Case) -> list[tuple[str, str]]:
    """`demo` writes the same files in every world, and at its beginning."""
    return [("small", case.name)] if case.name == "demo" else []


KIND = Kind("interrupts", cases, run_case, WORLDS, wholes, is_timed=True, needs=("interrupted",))
