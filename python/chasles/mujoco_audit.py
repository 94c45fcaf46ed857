"""Who passed through whom between recorded states of a MuJoCo model: the answer of `chasles.mujoco.audit`."""

from __future__ import annotations

import copy
import os
import pathlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import Cancelled, InvalidInput, Robot, RobotChecker, RobotContact, _why_cancelled
from .enums import Verdict
from .mujoco_page import write_page
from .mujoco_pairs import Geoms

Array = npt.NDArray[np.float64]
Pair = tuple[str, str]

MOST_STEPS = 1000  # of one question

#: One contact of two geoms.
audit_dtype = np.dtype(
    [
        ("what", "U8"),
        ("first", object),
        ("second", object),
        ("step", np.int64),
        ("last_step", np.int64),
        ("time", np.float64),
        ("time_upper", np.float64),
        ("certain", np.bool_),
        *((name, np.float64) for name in ("px", "py", "pz", "nx", "ny", "nz")),
    ]
)


@dataclass
class Audit:
    """Who passed through whom. Between states that no row names, all tested pairs are proven to stay apart.

    "Apart" is about geoms whose faces are moved inwards by half of the allowed overlap. So two geoms of a certain row overlap by
    the allowed overlap or more; for thin geoms that is less, as `robot.warnings` says. Corners and edges move farther than faces:
    two boxes without a row may overlap there by up to 1.74 times the allowed overlap, and sharper bodies by more.
    """

    #: One row for each contact, in the order of time. `what` is "passes" if neither the state before nor the one after shows the
    #: contact; "enters" if the state after shows it; "overlaps" if the first state does. The contact begins between the states
    #: `step` and `step` + 1, within the bracket from `time` to `time_upper`; it lasts, perhaps with short breaks, until some time
    #: between `last_step` and `last_step` + 1. `first` and `second` are the names "BODY/GEOM". If `certain` is false, a contact
    #: could not be told from a miss, as with cylinders and ellipsoids that are nearer than the deviation of their polyhedra.
    #: `px`, `py`, `pz` is a point of the contact at its begin, and `nx`, `ny`, `nz` its normal from `second` to `first`; NaN if none
    #: is known.
    table: np.ndarray
    steps: int  #: steps that are audited, from the first one on; fewer than were recorded only at a `chasles.Limit`
    recorded_steps: int
    allowed_overlap: float
    tested: int  #: pairs of geoms
    untested: dict[str, int]  #: pairs of geoms by reason, as `chasles.mujoco.untested`
    left_out: list[str]  #: names of geoms and flexes
    robot: Robot = field(repr=False)
    configurations: Array = field(repr=False)  #: of the robot, one for each state
    times: Array = field(repr=False)
    planes: dict[str, Array] = field(repr=False)  #: half of the length and width with which a page draws the planes

    @property
    def is_clear(self) -> bool:
        """Whether all recorded steps are proven clear."""
        return len(self.table) == 0 and self.steps == self.recorded_steps

    def __bool__(self) -> bool:
        raise TypeError("an Audit has no truth value; use `is_clear`")

    def __str__(self) -> str:
        left = ", ".join(f"{count} {reason}" for reason, count in self.untested.items())
        lines = [
            f"{self.steps} of {self.recorded_steps} steps, {_counted(self.tested, 'pair')} of geoms, allowed overlap "
            f"{self.allowed_overlap:g}: {_counted(len(self.table), 'contact')}",
            f"not tested, as in MuJoCo: {left or 'no pair'}",
            *([f"left out: {', '.join(self.left_out)}"] if self.left_out else []),
            *self.robot.warnings,
        ]
        for row in self.table:
            until = f" to {row['last_step']}" if row["last_step"] > row["step"] else ""
            doubt = "" if row["certain"] else " (not certain)"
            when = f"step {row['step']}{until}, time {row['time']:.9g}"
            lines.append(f"{row['what']:9}{row['first']} | {row['second']}  {when}{doubt}")
        return "\n".join(lines)

    def view(self, out: str | os.PathLike[str] = "audit.html", *, title: str = "Audit") -> pathlib.Path:
        """Write a page of HTML with all tested geoms on their way and a list of the contacts, and return its path.

        The page is one file and needs no network. It has the states, and poses between them in steps that turn a body far or
        have a contact. Geoms have the size that was audited. Planes are drawn as thin slabs of their size in the model.

        Raises
        ------
        InvalidInput
            If the package was built without the viewer.
        """
        return write_page(self.robot, self.configurations, self.times, self.table, self.planes, out, title)


@dataclass
class Question:
    """What `Search` needs to know."""

    robot: Robot
    configurations: Array
    times: Array
    curved: set[str]  #: geoms whose polyhedra are enclosures
    inner: Callable[[str, str], Robot]  #: two geoms alone, as bodies inside of them


class Search:
    """Goes from step to step. Steps that are clear are passed many at a time."""

    def __init__(self, question: Question):
        self._question = question
        self._checker = RobotChecker(question.robot)
        self._rows: list[list[Any]] = []
        self._latest: dict[Pair, list[Any]] = {}  # the last row of each pair
        self.steps = 0  # finished

    def run(self) -> np.ndarray:
        """Until the last step, or a limit of time."""
        states = self._question.configurations
        try:
            touching = self._touching(0)
            while self.steps + 1 < len(states):
                if not touching and self._skip():
                    continue
                following = self._touching(self.steps + 1)
                self._step(touching, following)
                touching = following
        except Cancelled:
            pass
        return self._table()

    def _touching(self, state: int) -> set[Pair]:
        return {_sorted(pair) for pair in self._checker.pairs_in_contact(self._question.configurations[state])}

    def _skip(self) -> bool:
        """Passes many steps that are clear, or those before the next one with a contact. Whether all of them are clear."""
        states = self._question.configurations[self.steps : self.steps + MOST_STEPS + 1]
        found = _finished(self._checker.first_contact_on_path(states))
        is_clear = found.verdict == Verdict.clear
        self.steps += len(states) - 1 if is_clear else found.segment
        return is_clear

    def _step(self, before: set[Pair], after: set[Pair]) -> None:
        """All contacts of one step, one after another. What touches before it only goes on."""
        rows: list[list[Any]] = []
        robot = copy.copy(self._question.robot)
        for pair in before:
            robot.ignore(*pair)
            self._goes_on(pair, rows)
        start, goal = self._question.configurations[self.steps : self.steps + 2]
        while True:
            found = _finished(robot.first_contact(start, goal))
            if found.pair is None:
                break
            robot.ignore(*found.pair)
            rows.append(self._row("enters" if _sorted(found.pair) in after else "passes", found))
        self._rows += rows
        self._latest |= {_sorted((row[1], row[2])): row for row in rows}
        self.steps += 1

    def _goes_on(self, pair: Pair, rows: list[list[Any]]) -> None:
        latest = self._latest.get(pair)
        if latest is not None and latest[4] == self.steps - 1:
            latest[4] = self.steps
            return
        alone = copy.copy(self._question.robot)
        for other in alone.tested_pairs():
            if _sorted(other) != pair:
                alone.ignore(*other)
        start, goal = self._question.configurations[self.steps : self.steps + 2]
        found = _finished(alone.first_contact(start, goal))
        if found.pair is not None:
            rows.append(self._row("overlaps", found))

    def _row(self, what: str, found: RobotContact) -> list[Any]:
        first, second = found.pair or ("", "")
        upper, certain = found.time_upper, found.certain
        if not certain or first in self._question.curved or second in self._question.curved:
            upper, certain = self._bracket(found)
        times = self._question.times[self.steps : self.steps + 2]
        stamps = [float(times[0] + part * (times[1] - times[0])) for part in (found.time, upper)]
        place = [*found.contacts[0].point, *found.contacts[0].normal] if found.contacts else [np.nan] * 6
        return [what, first, second, self.steps, self.steps, *stamps, certain, *place]

    def _bracket(self, found: RobotContact) -> tuple[float, bool]:
        """By when smaller bodies inside of both touch, and so both do."""
        assert found.pair is not None
        try:
            pair = self._question.inner(*found.pair)
        except InvalidInput:  # nothing is left inside of such a thin geom
            return found.time_upper, False
        ends = self._question.configurations[self.steps : self.steps + 2]
        touch = _finished(pair.first_contact(*ends))
        if touch.pair is not None and touch.certain:
            return touch.time_upper, True
        return found.time_upper, False

    def _table(self) -> np.ndarray:
        table = np.zeros(len(self._rows), audit_dtype)
        for number, row in enumerate(self._rows):
            table[number] = tuple(row)
        return table[np.lexsort((table["second"], table["first"], table["time"]))]


def _counted(number: int, thing: str) -> str:
    return f"{number or 'no'} {thing}{'s' * (number != 1)}"


def _sorted(pair: Pair) -> Pair:
    return (pair[0], pair[1]) if pair[0] < pair[1] else (pair[1], pair[0])


def _finished(found: RobotContact) -> RobotContact:
    if found.verdict == Verdict.unknown:
        raise Cancelled(_why_cancelled)
    return found


def audit_of(question: Question, allowed_overlap: float, geoms: Geoms, planes: dict[str, Array]) -> Audit:
    """The whole answer."""
    search = Search(question)
    table = search.run()
    return Audit(
        table=table,
        steps=search.steps,
        recorded_steps=len(question.configurations) - 1,
        allowed_overlap=allowed_overlap,
        tested=geoms.tested,
        untested=geoms.untested,
        left_out=geoms.left_out,
        robot=question.robot,
        configurations=question.configurations,
        times=question.times,
        planes=planes,
    )
