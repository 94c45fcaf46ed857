"""One case of abuse, and what came of it."""

import random
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

from setting import Setting


@dataclass(frozen=True)
class Case:
    """`kind/name/number` names one case for `--only`."""

    kind: str
    name: str
    number: int

    @property
    def title(self) -> str:
        return f"{self.kind}/{self.name}/{self.number}"

    def random(self, seed: int) -> random.Random:
        """Depends on nothing but the seed and the case, so that one case can be repeated alone."""
        return random.Random(f"{seed} {self.title}")

    def is_chosen(self, only: str) -> bool:
        return (self.title + "/").startswith(only.rstrip("/") + "/") if only else True


@dataclass
class Outcome:
    """`faults` say what broke a promise; `notes` count what happened."""

    faults: list[str] = field(default_factory=list)
    notes: Counter[str] = field(default_factory=Counter)
    slowest: float = 0.0  # seconds, of what the kind measures
    command: str = ""

    def expect(self, holds: bool, fault: str) -> bool:
        if not holds:
            self.faults.append(fault)
        return holds


@dataclass(frozen=True)
class Kind:
    """A kind of abuse: its cases, and how one of them is run in an empty folder."""

    name: str
    cases: Callable[["Counts"], Iterable[Case]]
    run: Callable[[Setting, Case, Path], Outcome]
    worlds: tuple[str, ...] = ()  # whose inputs are needed
    wholes: Callable[[Case], list[tuple[str, str]]] = lambda case: []  # (world, question) of undisturbed runs to compare with
    is_timed: bool = False  # measured alone, without other cases beside it
    needs: tuple[str, ...] = ()  # notes without which the kind would test nothing


@dataclass(frozen=True)
class Counts:
    """How many cases of each kind."""

    kills: int
    disks: int
    interrupts: int
    damaged: int
