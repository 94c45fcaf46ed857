"""The answer of `chasles.gltf`: a contact of two bodies of an animation, with times in seconds."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import SceneContact
from .enums import Verdict
from .poses import seven_numbers

Array = npt.NDArray[np.float64]

MOST_SHOWN = 3  # pairs of each reason in texts


@dataclass
class TimedContact:
    """One feature pair in contact, in the coordinates of the file's scene at `time`. Fields are those of `chasles.Contact`."""

    kind: str
    moving: Any
    fixed: Any
    point: Array  #: (3,), on the feature of the fixed body
    normal: Array  #: (3,), unit, from the fixed body to the moving one
    gap: float
    approach_speed: float  #: per second


@dataclass
class Untested:
    """The pairs of bodies that a question leaves out."""

    tested: int
    #: Names by reason, at most 100 of each: "at_rest" stand still, in the world or against each other; "ignored" and
    #: "touching_at_start" are left out by the question.
    named: dict[str, list[tuple[str, str]]]
    reasons: dict[str, int]  #: the number of pairs by reason

    @property
    def pairs(self) -> int:
        """The number of all untested pairs."""
        return sum(self.reasons.values())

    def __str__(self) -> str:
        texts = []
        for reason, count in self.reasons.items():
            names = [" and ".join(pair) for pair in self.named[reason][:MOST_SHOWN]]
            more = f", and {count - len(names)} more" if count > len(names) else ""
            texts.append(f"{count} {REASONS[reason]} ({', '.join(names)}{more})")
        return f"{self.pairs} pair{'s' * (self.pairs != 1)}: {', '.join(texts)}"


REASONS = {"at_rest": "at rest", "ignored": "ignored", "touching_at_start": "touching at the start"}


@dataclass
class AnimationContact:
    """What is proven about an animation, or about one pair of its bodies. Times are seconds of the animation."""

    #: "clear", "contact", "contact_at_start", or "unknown" at a `chasles.Limit`. A verdict has no truth value.
    verdict: Verdict
    pair: tuple[str, str] | None = None  #: names of the moving and the fixed body; None if all is clear
    time: float = 0.0  #: lower end of the bracket of the first contact, rounded outward; 0 if clear
    time_upper: float = 0.0
    certain: bool = True  #: false where a contact cannot be told from a miss
    contacts: list[TimedContact] = field(default_factory=list)
    clear_until: float = 0.0  #: until then all tested pairs are proven apart; the duration if clear
    duration: float = 0.0
    simultaneous: list[tuple[str, str]] = field(default_factory=list)  #: further pairs that may touch at the same time
    at_jump: bool = False  #: a key of STEP puts one body onto the other one
    inside: str | None = None  #: as of `chasles.SceneContact`, and so are the next two
    inside_point: Array | None = None
    overlap_point: Array | None = None  #: where surfaces pass through each other at the start or after a jump
    pose: Array | None = None  #: (4, 4), of the moving body at `time`
    untested: Untested | None = None  #: only of `first_contact`
    warnings: list[str] = field(default_factory=list)
    animations: dict[int, str] = field(default_factory=dict)  #: names of the animations by their numbers in the file
    kinds: str = ""  #: of interpolation
    margin: float = 0.0
    scene_size: float = 1.0  #: the diagonal of the box around all bodies at the start
    work: dict[str, int] = field(default_factory=dict)

    def __bool__(self) -> bool:
        raise TypeError("an answer has no truth value; compare its verdict")

    def __str__(self) -> str:
        lines = [self._headline()]
        if self.pair is not None:
            lines += [
                f"  pair      {' on '.join(self.pair)}",
                f"  time      {self.time!r} to {self.time_upper!r} s" if self.time_upper > 0 else "  time      0 s",
                f"  certain   {'yes' if self.certain else 'no'}",
            ]
            lines += [f"  touching  {_text_of(contact)}" for contact in self.contacts]
            if self.at_jump:
                lines.append("  jump      a key of STEP puts one body onto the other one")
            if self.inside is not None:
                lines.append(f"  inside    the {self.inside} body is inside of the other one")
            if self.overlap_point is not None:
                lines.append(f"  overlap   the surfaces pass through each other at {_numbers(self.overlap_point)}")
            lines += [f"  also      {' on '.join(pair)}" for pair in self.simultaneous]
        if self.untested is not None and self.untested.pairs:
            lines.append(f"  untested  {self.untested}")
        return "\n".join(lines)

    def _headline(self) -> str:
        what = f"; animation {', '.join(map(repr, self.animations.values()))}, {self.kinds}"
        touch = "touches" if self.margin == 0 else f"comes within {self.margin:g}"
        if self.verdict == Verdict.clear:
            if self.untested is not None and not self.untested.tested:
                return "CLEAR: no pair is tested" + what
            pair = "tested pair" if self.untested is None or self.untested.pairs else "pair"
            return f"CLEAR: proven that no {pair} {touch} during the whole {self.duration:g} s{what}"
        if self.verdict == Verdict.unknown:
            return f"UNKNOWN: the time was over; clear until {self.clear_until:.12g} s of {self.duration:g} s{what}"
        near = "CONTACT" if self.margin == 0 else f"WITHIN {self.margin:g}"
        if self.verdict == Verdict.contact_at_start:
            return f"{near} AT THE START{what}"
        return f"{near} at {self.time:.12g} s of {self.duration:g} s{what}"

    def as_json(self) -> dict[str, Any]:
        """The answer as `chasles animation --json` prints it."""
        result: dict[str, Any] = {"verdict": str(self.verdict.value), "clear_until": self.clear_until}
        if self.pair is not None:
            result |= self.event()
            result["simultaneous"] = [list(pair) for pair in self.simultaneous]
        if self.untested is not None:
            result["untested"] = untested_json(self.untested)
        motion = {"kind": self.kinds, "animations": list(self.animations.values()), "duration": self.duration}
        return result | {"warnings": self.warnings, "work": self.work, "motion": motion}

    def event(self) -> dict[str, Any]:
        """The contact alone."""
        result: dict[str, Any] = {
            "pair": list(self.pair or ()),
            "time": self.time,
            "time_upper": self.time_upper,
            "certain": self.certain,
            "contacts": [_json_of(contact) for contact in self.contacts],
        }
        if self.pose is not None:
            result["pose"] = seven_numbers(self.pose).tolist()
        if self.at_jump:
            result["at_jump"] = True
        if self.inside is not None and self.inside_point is not None:
            result |= {"inside": self.inside, "inside_point": self.inside_point.tolist()}
        if self.overlap_point is not None:
            result["overlap"] = {"point": self.overlap_point.tolist()}
        return result


def timed_contacts(found: SceneContact, length: float) -> list[TimedContact]:
    """The contacts of an answer whose time from 0 to 1 takes so many seconds."""
    return [
        TimedContact(
            str(contact.kind.value), contact.moving, contact.fixed, contact.point, contact.normal, contact.gap,
            contact.approach_speed / length,
        )
        for contact in found.contacts
    ]  # fmt: skip


def work_of(answers: list[SceneContact]) -> dict[str, int]:
    """The sum of the work of questions."""
    names = ("node_pairs", "face_pairs", "elementary_tests", "root_brackets", "refined", "exact")
    return {name: sum(int(getattr(found.work, name)) for found in answers) for name in names}


def untested_json(untested: Untested) -> dict[str, Any]:
    """As the command line prints it for scenes."""
    reasons = [
        {"reason": reason, "count": count, "pairs": [list(pair) for pair in untested.named[reason]]}
        for reason, count in untested.reasons.items()
    ]
    return {"tested": untested.tested, "pairs": untested.pairs, "reasons": reasons}


def outward(start: float, part: float, length: float, *, up: bool) -> float:
    """The time start + part * length, rounded down or up."""
    if part == 0.0:
        return start
    time = start + part * length
    if start > 0:  # the begin of an interval after a jump is rounded as a part of the duration
        time += 2.0**-51 * (start + length) * (1 if up else -1)
    for _ in range(2):  # two roundings of half a unit
        time = math.nextafter(time, math.inf if up else 0.0)
    return max(time, 0.0)


def _text_of(contact: TimedContact) -> str:
    kinds = contact.kind.split("_")
    features = [
        f"{kind} {'-'.join(map(str, _ids(feature)))}" for kind, feature in zip(kinds, (contact.moving, contact.fixed))
    ]
    where = f"at {_numbers(contact.point)}, normal {_numbers(contact.normal)}"
    return f"{' on '.join(features)} {where}, approach speed {contact.approach_speed:.6g}"


def _json_of(contact: TimedContact) -> dict[str, Any]:
    kinds = contact.kind.split("_")
    return {
        "kind": contact.kind,
        "moving_feature": _feature(kinds[0], contact.moving),
        "fixed_feature": _feature(kinds[1], contact.fixed),
        "point": contact.point.tolist(),
        "normal": contact.normal.tolist(),
        "gap": contact.gap,
        "approach_speed": contact.approach_speed,
    }


def _feature(kind: str, feature: Any) -> int | list[int]:
    """A vertex is a number, a face a list of one number, an edge a list of its two vertices."""
    return _ids(feature)[0] if kind == "vertex" else _ids(feature)


def _ids(feature: Any) -> list[int]:
    return [int(number) for number in np.atleast_1d(feature)]


def _numbers(vector: Array) -> str:
    return "(" + ", ".join(f"{number:.9g}" for number in vector) + ")"
