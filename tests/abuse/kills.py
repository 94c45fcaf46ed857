"""Kills at random moments: each output has its former content or its whole new one, and the next run goes on as ever."""

import random
import signal
import time
from collections.abc import Iterable
from pathlib import Path

from cases import Case, Counts, Kind, Outcome
from questions import QUESTIONS, WRITERS, Question
from runs import Running, changes, contents, run
from setting import Setting, Whole, make_folders

PRECIOUS = b"precious\n"


def cases(counts: Counts) -> Iterable[Case]:
    return (Case("kills", name, number) for name in WRITERS for number in range(counts.kills))


def run_case(setting: Setting, case: Case, folder: Path) -> Outcome:
    rng = case.random(setting.seed)
    question = QUESTIONS[case.name]
    outcome = Outcome()
    names = question.own_names()
    command = question.command(setting.program, "large", names)
    outcome.command = " ".join(command)
    setting.copy_world("large", folder)
    make_folders(question, names, folder)
    if rng.random() < 0.5:
        for name, _ in question.written(names):
            (folder / name).write_bytes(PRECIOUS)
    before = contents(folder)
    whole = setting.whole("large", question.name)
    running = Running(command, folder)
    wait_for_moment(rng, running, question, names, folder, whole)
    running.send(signal.SIGKILL)
    landed = running.wait().status == -signal.SIGKILL
    outcome.notes["killed" if landed else "ended before"] += 1
    left = check_files(outcome, question, names, whole, before, folder)
    run_again(outcome, setting, question, names, left, folder)
    return outcome


def wait_for_moment(
    rng: random.Random, running: Running, question: Question, names: dict[str, str], folder: Path, whole: Whole
) -> None:
    """Any moment of the run, or one soon after an output has begun."""
    if rng.random() < 0.5:
        time.sleep(rng.uniform(0, 1.1 * whole.ended.seconds))
        return
    parts = [folder / (name + ".part") for name, _ in question.written(names)]
    while not running.has_ended() and not any(part.exists() for part in parts):
        time.sleep(0.0001)
    time.sleep(rng.uniform(0, 0.005) if rng.random() < 0.7 else rng.uniform(0, whole.ended.seconds))


def check_files(
    outcome: Outcome, question: Question, names: dict[str, str], whole: Whole, before: dict[str, bytes], folder: Path
) -> set[str]:
    """Checks what a cut run leaves. Returns the names of the parts."""
    after = contents(folder)
    left, allowed = set(), set()
    for name, output in question.written(names):
        part = name + ".part"
        allowed |= {name, part}
        is_sound = after.get(name) in (before.get(name), whole.files[name])
        outcome.expect(is_sound, f"{name} has neither its former content nor its new one")
        if part in after:
            left.add(part)
            outcome.notes["left a part"] += 1
            if output.has_rows:
                outcome.expect(whole.files[name].startswith(after[part]), f"the rows in {part} are others")
    others = set(changes(before, after)) - allowed
    outcome.expect(not others, f"a cut run changed {', '.join(sorted(others))}")
    return left


def run_again(
    outcome: Outcome, setting: Setting, question: Question, names: dict[str, str], left: set[str], folder: Path
) -> None:
    """The next run writes what an undisturbed one does, and clears up."""
    command = question.command(setting.program, "large", names)
    whole = setting.whole("large", question.name)
    if question.can_resume and left:
        refused = run(command, folder)
        is_told = refused.status == 2 and len(refused.errors) == 1 and sorted(left)[0] in refused.errors[0]
        outcome.expect(is_told, f"a run that was cut is not told from a whole one: {refused.status} {refused.lines}")
        command += ["--resume"]
        outcome.notes["resumed"] += 1
    ended = run(command, folder)
    outcome.expect(ended.status == whole.ended.status, f"the next run: status {ended.status}, {ended.lines}")
    after = contents(folder)
    for name, content in whole.files.items():
        outcome.expect(after.get(name) == content, f"the next run wrote another {name} than an undisturbed one")
    parts = sorted(name for name in after if name.endswith(".part"))
    outcome.expect(not parts, f"the next run left {', '.join(parts)}")


NEEDS = ("killed", "left a part", "resumed")
KIND = Kind("kills", cases, run_case, ("large",), lambda case: [("large", case.name)], needs=NEEDS)
