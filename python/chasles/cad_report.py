"""What `chasles.cad.check` found: as text, as JSON for continuous integration, and as a page to look at."""

from __future__ import annotations

import dataclasses
import json
import os
import pathlib
from typing import Any

import numpy as np

CLEAR, CONTACT, UNKNOWN = "clear", "contact", "unknown"
EXIT_STATUS = {CLEAR: 0, CONTACT: 1, UNKNOWN: 3}


@dataclasses.dataclass
class Touch:
    """Two parts that touch as mounted, or come so near that it cannot be told. `is_proven`: the true parts touch or overlap."""

    pair: tuple[str, str]
    point: list[float] | None
    is_proven: bool


@dataclasses.dataclass
class Clearance:
    """The two parts that come nearest, other than those that touch: the true distance is within both ends, mm."""

    pair: tuple[str, str]
    lower: float
    upper: float
    point: list[float] | None
    at: dict[str, float]  # values of joints


@dataclasses.dataclass
class Stop:
    """What stops a joint. It is clear until one value, and proven to touch by another one, or None. Without a pair, time ended."""

    pair: tuple[str, str] | None
    clear_until: float
    touches_by: float | None
    point: list[float] | None


@dataclasses.dataclass
class JointRange:
    """How far a joint goes while all others stay as mounted: radians or mm. `clear` is proven, up to what stops it at each side.

    `lower` and `upper` are its limits within those of its followers; without limits, how far it was looked at.
    """

    name: str
    type: str
    lower: float
    upper: float
    value: float
    clear: list[float]
    stops: list[Stop | None] = dataclasses.field(default_factory=lambda: [None, None])
    least: Clearance | None = None
    seconds: float = 0.0

    @property
    def verdict(self) -> str:
        """ "clear" over the whole range, "contact", or "unknown"."""
        if any(stop is not None and stop.pair is not None for stop in self.stops):
            return CONTACT
        return UNKNOWN if any(self.stops) else CLEAR


@dataclasses.dataclass
class PairRange:
    """All combinations of two joints: shares that are proven clear, in contact, and open. `found` is the `RobotRange`.

    Clear are the true parts, up to an overlap that is allowed. `found` is None if no time was left. In contact are the bodies around them: the true parts touch, or are within twice the sum of their bounds.
    """

    joints: tuple[str, str]
    outcome: str
    clear_share: float
    contact_share: float
    open_share: float
    witness: dict[str, float] | None
    pair: tuple[str, str] | None
    found: Any
    seconds: float

    @property
    def verdict(self) -> str:
        """ "clear" in all combinations, "contact", or "unknown"."""
        return self.outcome if self.outcome in (CLEAR, CONTACT) else UNKNOWN


@dataclasses.dataclass
class Report:
    """The answer of `chasles.cad.check`.

    Attributes
    ----------
    touching : list of Touch
        Pairs that touch as mounted. They are not looked at while joints move.
    least : Clearance or None
        The nearest pair as mounted, besides pairs that touch.
    joints : list of JointRange
    pairs : list of PairRange
    intended : list of (str, str)
        Pairs that are not looked at.
    ignore_touching : bool
        Whether `touching` is intended.
    """

    name: str
    parts: dict[str, Any]
    intended: list[tuple[str, str]]
    allowed_overlap: float
    warnings: list[str]
    assembly: Any
    touching: list[Touch] = dataclasses.field(default_factory=list)
    ignore_touching: bool = False
    least: Clearance | None = None
    joints: list[JointRange] = dataclasses.field(default_factory=list)
    pairs: list[PairRange] = dataclasses.field(default_factory=list)
    tolerance: float = 1.0  # the share of two joints that may stay open once a contact is known
    is_rest_decided: bool = True  # False where time ended before all pairs as mounted were looked at

    @property
    def verdict(self) -> str:
        """ "contact" if anything touches that is not intended, else "unknown" if time ended, else "clear"."""
        if self.touching and not self.ignore_touching:
            return CONTACT
        verdicts = self._verdicts()
        return next((verdict for verdict in (CONTACT, UNKNOWN) if verdict in verdicts), CLEAR)

    @property
    def is_complete(self) -> bool:
        """Whether time did not end before all was decided: what touches as mounted, each way of each joint, and shares of two."""
        ways = [stop for joint in self.joints for stop in joint.stops if stop is not None]
        return (
            UNKNOWN not in self._verdicts()
            and all(stop.pair is not None for stop in ways)
            and all(pair.open_share <= self.tolerance for pair in self.pairs)
        )

    def _verdicts(self) -> set[str]:
        found = {joint.verdict for joint in self.joints} | {pair.verdict for pair in self.pairs}
        return found if self.is_rest_decided else {*found, UNKNOWN}

    @property
    def exit_status(self) -> int:
        """0 clear, 1 contact, 3 out of time."""
        return EXIT_STATUS[self.verdict]

    @property
    def is_proven(self) -> bool:
        """Whether the answer is about the true parts. With free-form faces it is about the tessellation."""
        return all(part.is_proven for part in self.parts.values())

    def as_dict(self) -> dict[str, Any]:
        """All numbers, as of the JSON file."""
        parts = {
            name: {"bound": part.bound, "proven": part.is_proven, "faces": part.kinds, "colour": part.colour}
            for name, part in self.parts.items()
        }
        rows = {
            "touching": [dataclasses.asdict(touch) for touch in self.touching],
            "joints": [dataclasses.asdict(joint) | {"verdict": joint.verdict} for joint in self.joints],
            "pairs": [_without_found(pair) | {"verdict": pair.verdict} for pair in self.pairs],
        }
        return {
            "name": self.name,
            "verdict": self.verdict,
            "about": "the true parts" if self.is_proven else "the tessellation",
            "unit": "mm and radians",
            "parts": parts,
            "intended": self.intended,
            "ignore_touching": self.ignore_touching,
            "allowed_overlap": self.allowed_overlap,
            "warnings": self.warnings,
            "is_complete": self.is_complete,
            "least": None if self.least is None else dataclasses.asdict(self.least),
            **rows,
        }

    def to_json(self) -> str:
        """A text of JSON: see docs/cad.md for its keys."""
        return json.dumps(self.as_dict(), indent=1, allow_nan=False) + "\n"

    def view(self, out: str | os.PathLike[str] = "cad.html", *, title: str | None = None) -> pathlib.Path:
        """Write a page on which each joint goes to its ends and back, with all contacts to click, and return its path."""
        from .cad_page import write_page

        return write_page(self, out, title or self.name)

    def __str__(self) -> str:
        about = "" if self.is_proven else ", for the tessellation: some faces are free-form"
        lines = [f"{self.name}: {self.verdict}, {len(self.parts)} parts, {len(self.joints)} joints{about}"]
        for touch in self.touching:
            what = "touches, proven" if touch.is_proven else "touches, or comes nearer than the tessellation tells"
            lines.append(f"at rest: {_pair(touch.pair)} {what}{' (ignored)' if self.ignore_touching else ''}")
        if self.least is not None:
            lines.append(f"at rest: {_least(self.least)}")
        lines += [_line(joint) for joint in self.joints]
        lines += [_shares(pair) for pair in self.pairs]
        if self.intended:
            lines.append("intended, not looked at: " + ", ".join(_pair(pair) for pair in self.intended))
        return "\n".join([*lines, *(f"warning: {warning}" for warning in self.warnings)])

    def __repr__(self) -> str:
        return f"<chasles.cad.Report: {str(self).splitlines()[0]}>"


def _without_found(pair: PairRange) -> dict[str, Any]:
    return {field.name: getattr(pair, field.name) for field in dataclasses.fields(pair) if field.name != "found"}


def _pair(pair: tuple[str, str]) -> str:
    return " | ".join(pair)


def _value(kind: str, value: float) -> str:
    return f"{np.degrees(value):.6g} deg" if kind == "revolute" else f"{value:.6g} mm"


def _least(least: Clearance) -> str:
    place = "" if least.point is None else f" at ({', '.join(f'{value:.4g}' for value in least.point)})"
    return f"the nearest pair is {_pair(least.pair)}: {least.lower:.6g} to {least.upper:.6g} mm{place}"


def _line(joint: JointRange) -> str:
    ends = f"{_value(joint.type, joint.lower)} to {_value(joint.type, joint.upper)}"
    clear = f"{_value(joint.type, joint.clear[0])} to {_value(joint.type, joint.clear[1])}"
    if joint.verdict == CLEAR:
        if joint.least is None:
            return f"joint {joint.name}: clear from {ends}"
        at = "".join(f" when it is at {_value(joint.type, value)}" for value in joint.least.at.values())
        return f"joint {joint.name}: clear from {ends}; {_least(joint.least)}{at}"
    stops = [stop for stop in joint.stops if stop is not None]
    what = " and ".join("time" if stop.pair is None else _pair(stop.pair) for stop in stops)
    return f"joint {joint.name}: clear from {clear} of {ends}, stopped by {what}"


def _shares(pair: PairRange) -> str:
    shares = f"clear {pair.clear_share:.1%}, contact {pair.contact_share:.1%}, open {pair.open_share:.1%}"
    return f"joints {_pair(pair.joints)}: {pair.verdict}: {shares}" + (f", {_pair(pair.pair)}" if pair.pair else "")
