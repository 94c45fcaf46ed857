"""One chunk before a gate (`chasles.policy`): which of its actions are proven, and what stands against more."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ._core import Cancelled, Limit, RobotContact
from .enums import Verdict
from .gate_decision import Floats, GateDecision

if TYPE_CHECKING:
    from .policy import PolicyGate

BANDS = 8  # of distance, between the margin and full speed
SINGLE = 2.0**-22  # part of a limit by which a command of it in single precision may be beyond it
_PORTION = 64  # segments: of straight paths, between which the time is looked at
_LARGEST = 1000.0  # value of a joint that a path can have


class GateQuestion:
    """A question of `PolicyGate`: `speeds`, then `decision`."""

    def __init__(self, gate: PolicyGate, rows: Floats, limit: Limit):
        self._gate, self._rows, self._limit = gate, rows, limit
        self._plain, self._held = gate._checkers
        self._usable, self._fault = _usable(gate, rows)
        self._found: RobotContact | None = None  # the last one that is not clear
        self._offset, self._margin = 0, gate._margin  # its times count from this action; what it was asked with
        self._is_late = False

    def speeds(self) -> Floats:
        """Those of the actions that may be sent."""
        is_all_or_none = self._gate.mode == "refuse"
        if self._usable == 0 or (is_all_or_none and self._fault):
            return np.zeros(0)
        try:
            if self._gate.mode == "scale":
                return self._scaled()
            proven = self._straight() if self._gate.is_straight else self._bent()
        except Cancelled:  # not by a question about a path, which would say what is proven
            self._is_late, proven = True, 0
        return np.ones(0 if is_all_or_none and proven < self._usable else proven)

    def _straight(self) -> int:
        """The number of actions that may be sent at full speed."""
        done = 0
        while done < self._usable and self._has_time():
            whole, found = self._ask(0, done, self._usable)
            done += whole
            if found.verdict != Verdict.clear:
                break
        return done

    def _bent(self) -> int:
        """That number where fewer actions are another path."""
        count = self._usable
        while count > 0 and self._has_time():
            whole, found = self._ask(0, 0, count)
            if found.verdict == Verdict.clear:
                return count
            count = 0 if self._gate.mode == "refuse" else whole
        return 0

    def _scaled(self) -> Floats:
        """Band by band, the farthest one first: each answers up to the first action that comes nearer."""
        speeds, done, band = np.zeros(self._usable), 0, BANDS
        while done < self._usable and band > 0 and self._has_time():
            whole, found = self._ask(band, done, self._usable)
            if self._gate.is_straight or found.verdict == Verdict.clear:
                speeds[done : done + whole] = band / BANDS
                done += whole
            if found.verdict != Verdict.clear:
                band = self._next_band(found, band)
        return speeds[:done]

    def _has_time(self) -> bool:
        self._is_late = self._limit.is_over
        return not self._is_late

    def _ask(self, band: int, done: int, end: int) -> tuple[int, RobotContact]:
        """How many actions after those that are done are proven, and the answer."""
        if self._gate.is_straight:
            end = min(end, done + _PORTION)
        path = self._gate._path(self._rows[done : end + 1])
        found = self._plain[band].first_contact_on_path(path)
        if self._held is not None and found.verdict == Verdict.contact_at_start:
            found = self._held.first_contact_on_path(path)  # expensive, and makes a difference only here
        if found.verdict == Verdict.clear:
            return end - done, found
        self._found, self._offset, self._margin = found, done, self._gate._levels[band]
        return math.floor(path.times[found.segment]), found  # all segments before are proven

    def _next_band(self, found: RobotContact, band: int) -> int:
        """The farthest band that the pair leaves possible: at the start it is no farther apart than its gap."""
        if found.verdict != Verdict.contact_at_start:
            return band - 1
        gap = min((contact.gap for contact in found.contacts), default=0.0)
        return int(np.searchsorted(self._gate._levels[:band], gap, side="right")) - 1

    def decision(self, speeds: Floats, milliseconds: float) -> GateDecision:
        """With what stands against more."""
        count, passed, found = len(self._rows) - 1, len(speeds), self._found
        is_slow = passed > 0 and speeds.min() < 1
        verdict = "refused" if passed == 0 else "shortened" if passed < count else "slowed" if is_slow else "passed"
        clear_until = max(float(passed), 0.0 if found is None else self._offset + found.clear_until)
        answer = GateDecision(verdict, self._rows[1 : passed + 1], speeds, clear_until=clear_until, milliseconds=milliseconds)
        if verdict == "passed":
            return answer
        if self._fault and (found is None or passed == self._usable):
            return replace(answer, reason=self._fault)
        if found is None or found.verdict == Verdict.unknown or self._is_late:
            return replace(answer, reason=f"not proven within {1000 * self._gate._seconds:g} ms")
        when = self._offset + found.time
        return replace(answer, reason=self._reason(found, when), pair=found.pair, time=when, place=_place(found))

    def _reason(self, contact: RobotContact, when: float) -> str:
        how = ("" if contact.certain else "may ") + ("touch" if self._margin == 0 else f"come within {self._margin:g}")
        where = f"on the way to action {math.ceil(when) - 1}" if when > 0 else "at the present configuration"
        return f"{' and '.join(contact.pair or ())} {how} {where}"


def _usable(gate: PolicyGate, rows: Floats) -> tuple[int, str]:
    """The number of actions before the first one that no robot can take, and why it cannot."""
    lower, upper = gate._limits[:, 0] - gate._slack[:, 0], gate._limits[:, 1] + gate._slack[:, 1]
    unusable = ~(np.abs(rows) <= _LARGEST)  # and what is not a number
    beyond = (rows < lower) | (rows > upper)
    beyond[0] = False  # the robot is where it is
    steps = np.zeros(rows.shape, bool)
    steps[1:] = gate._continuous & (np.abs(np.diff(np.nan_to_num(rows), axis=0)) >= math.pi)
    bad = unusable | beyond | steps
    if not bad.any():
        return len(rows) - 1, ""
    row, column = divmod(int(np.argmax(bad)), rows.shape[1])
    where = f"action {row - 1}" if row else "present"
    name, value = gate._robot.variables[column], rows[row, column]
    if unusable[row, column]:
        return max(0, row - 1), f"{where}: {name}: {value} is no value that a joint can take"
    if beyond[row, column]:
        return row - 1, f"{where}: {name}: {value} is beyond its limits, {gate._limits[column].tolist()}"
    return row - 1, f"{where}: {name}: turns by half a turn or more, and it may go either way round"


def _place(contact: RobotContact) -> Floats | None:
    """A point of the contact in the world."""
    if contact.contacts:
        return contact.contacts[0].point
    if contact.overlap is not None:
        return contact.overlap.point
    return contact.inside_point
