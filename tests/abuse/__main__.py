#!/usr/bin/env python3
"""Abuses the command line: kills, full disks, closed streams, outputs that are inputs, Ctrl-C, damaged files.

Usage: python3 tests/abuse CHASLES [--short] [--seed N] [--only KIND[/NAME[/NUMBER]]] [--keep FOLDER] ...

Prints each broken promise, a summary, and how to repeat a case. Exits with 1 if anything is broken.
"""

import argparse
import multiprocessing
import os
import random
import resource
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import damage
import disks
import interrupts
import kills
import names
import options
import streams
from cases import Case, Counts, Kind, Outcome
from setting import Setting, Unusable, make_setting

KINDS = {module.KIND.name: module.KIND for module in (options, names, streams, disks, kills, damage, interrupts)}
WHOLE = Counts(kills=50, disks=60, interrupts=20, damaged=20_000)
SHORT = Counts(kills=4, disks=6, interrupts=2, damaged=60)
LONGEST_END = {True: 1.0, False: 0.2}  # seconds from Ctrl-C to the end: in the short form, beside other programs
MOST_SHOWN = 20  # broken cases of a kind that are printed


@dataclass
class Tally:
    """What came of the cases of one kind."""

    cases: int = 0
    broken: list[str] = field(default_factory=list)  # titles
    notes: Counter[str] = field(default_factory=Counter)
    slowest: float = 0.0
    slowest_case: str = ""

    def add(self, case: Case, outcome: Outcome) -> None:
        self.cases += 1
        self.notes += outcome.notes
        if outcome.slowest > self.slowest:
            self.slowest, self.slowest_case = outcome.slowest, case.title
        if outcome.faults:
            self.broken.append(case.title)


@dataclass
class Abuse:
    """Runs cases in folders of their own and keeps the folders of those that break a promise."""

    setting: Setting
    kept: Path
    work: Path

    def __call__(self, case: Case) -> tuple[Case, Outcome]:
        folder = self.work / f"case-{os.getpid()}"
        folder.mkdir()
        try:
            try:
                outcome = KINDS[case.kind].run(self.setting, case, folder)
            except Exception as error:  # a case that cannot be run is broken, and the others go on
                outcome = Outcome([f"the case could not be run: {error!r}"])
            if outcome.faults:
                self.keep(case, outcome, folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
        return case, outcome

    def keep(self, case: Case, outcome: Outcome, folder: Path) -> None:
        target = self.kept / case.title.replace("/", "-")
        shutil.rmtree(target, ignore_errors=True)
        shutil.copytree(folder, target, symlinks=False, ignore_dangling_symlinks=True, ignore=loops)
        (target / "what-broke.txt").write_text("\n".join([outcome.command, *outcome.faults, ""]))


def loops(folder: str, entries: list[str]) -> list[str]:
    """Links that lead to folders, or nowhere."""
    paths = [Path(folder) / entry for entry in entries]
    return [path.name for path in paths if path.is_symlink() and not os.path.isfile(path)]


def run_kind(kind: Kind, cases: Iterable[Case], abuse: Abuse, jobs: int) -> Tally:
    tally = Tally()
    begun = time.monotonic()
    with multiprocessing.get_context("fork").Pool(1 if kind.is_timed else jobs) as pool:
        told = begun
        for case, outcome in pool.imap_unordered(abuse, cases, chunksize=1 if kind.is_timed else 4):
            tally.add(case, outcome)
            if outcome.faults and len(tally.broken) <= MOST_SHOWN:
                show(case, outcome)
            if time.monotonic() - told > 60:
                told = time.monotonic()
                print(f"{kind.name}: {tally.cases} cases so far", flush=True)
    print(line_of(kind, tally, time.monotonic() - begun), flush=True)
    return tally


def show(case: Case, outcome: Outcome) -> None:
    print(f"BROKEN {case.title}: {outcome.command}", flush=True)
    for fault in outcome.faults:
        print(f"    {fault[:500]}", flush=True)


def line_of(kind: Kind, tally: Tally, seconds: float) -> str:
    notes = ", ".join(f"{count} {note}" for note, count in sorted(tally.notes.items()))
    slowest = f"; slowest {tally.slowest:.3f} s ({tally.slowest_case})" if tally.slowest > 0 else ""
    return f"{kind.name}: {tally.cases} cases, {len(tally.broken)} broken: {notes}{slowest}; {seconds:.0f} s in all"


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tests/abuse", description=__doc__.split("\n\n")[0])
    parser.add_argument("chasles", help="the program")
    parser.add_argument("--short", action="store_true", help="fewer cases: at most two minutes on two cores")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6), help="default: another each time")
    parser.add_argument("--only", default="", help="KIND, KIND/NAME or KIND/NAME/NUMBER: these cases alone")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="cases at the same time")
    parser.add_argument("--keep", type=Path, default=Path("build/abuse"), help="folder for the files of broken cases")
    parser.add_argument("--kills", type=int, help="kills of each command with outputs")
    parser.add_argument("--disks", type=int, help="full disks of each command with outputs")
    parser.add_argument("--interrupts", type=int, help="interruptions of each command")
    parser.add_argument("--damaged", type=int, help="damaged files of each format")
    return parser.parse_args()


def counts_of(given: argparse.Namespace) -> Counts:
    usual = SHORT if given.short else WHOLE
    chosen = {name: getattr(given, name) for name in vars(usual)}
    return Counts(**{name: getattr(usual, name) if chosen[name] is None else chosen[name] for name in chosen})


def run_all(given: argparse.Namespace, work: Path) -> dict[str, Tally]:
    chosen = {}
    for kind in KINDS.values():
        if cases := [case for case in kind.cases(counts_of(given)) if case.is_chosen(given.only)]:
            chosen[kind.name] = cases
    worlds = {world for name in chosen for world in KINDS[name].worlds}
    asked = {whole for cases in chosen.values() for case in cases for whole in KINDS[case.kind].wholes(case)}
    program, longest_end = str(Path(given.chasles).resolve()), LONGEST_END[given.short]
    setting = make_setting(program, given.seed, work / "worlds", longest_end, worlds, asked)
    abuse = Abuse(setting, given.keep.resolve(), work)
    return {name: run_kind(KINDS[name], cases, abuse, given.jobs) for name, cases in chosen.items()}


def missing_notes(tallies: dict[str, Tally]) -> list[str]:
    """What should have happened at least once, where all cases were run."""
    return [f"{name}: never {need}" for name, tally in tallies.items() for need in KINDS[name].needs if not tally.notes[need]]


def main() -> int:
    given = arguments()
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
    print(f"seed {given.seed}", flush=True)
    begun = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="abuse-") as work:
        try:
            tallies = run_all(given, Path(work))
        except Unusable as error:
            print(f"BROKEN whole inputs: {error}")
            return 1
    broken = [title for tally in tallies.values() for title in tally.broken]
    missing = [] if given.only else missing_notes(tallies)
    cases = sum(tally.cases for tally in tallies.values())
    print("\n".join([f"{cases} cases, {len(broken)} broken, {time.monotonic() - begun:.0f} s", *missing]))
    if broken:
        print(f"kept in {given.keep}; repeat one with --seed {given.seed} --only {broken[0]}")
    if not cases:
        print(f"no case is named {given.only}")
    return 1 if broken or missing or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
