"""What an assembly is asked: clashes at rest, ranges of joints and of pairs of joints, least clearances, for `chasles.cad`."""

from __future__ import annotations

import fnmatch
import itertools
import time
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np

from ._core import Cancelled, InvalidInput, Limit, Robot, RobotChecker, first_contact
from .cad_assembly import MOVING, Assembly, Joint, Part
from .cad_bounds import Array
from .cad_proof import Overlap, first_proven
from .cad_report import Clearance, JointRange, PairRange, Report, Stop, Touch

LARGEST = 1000.0  # the values of robots end here
SAMPLES = 25  # places of a joint at which the distance is computed
MARGINS = (
    0.5,
    0.8,
    0.9,
    0.95,
    0.98,
    0.99,
    0.99,
)  # shares of the least one that was found; the last one after a smaller one was found
_QUARTER = np.pi / 2  # straight paths of joints without limits take the shorter way


def check(
    assembly: Assembly,
    *,
    intended: Collection[tuple[str, str]] = (),
    ignore_touching: bool = False,
    allowed_overlap: float = 0.0,
    pairs: bool = True,
    least_seconds: float = 2.0,
    tolerance: float = 0.01,
    seconds: float = 60.0,
) -> Report:
    """Whether anything touches: as mounted, over the range of each joint, and over the ranges of each two joints.

    Parameters
    ----------
    assembly : Assembly
    intended : list of (str, str)
        Pairs of parts whose contacts are intended, as a pin and its clevis. Names may have the wildcards * and ?.
    ignore_touching : bool
        Whether all contacts as mounted are intended.
    allowed_overlap : float
        Two parts that overlap by this much do not touch yet, mm.
    pairs : bool
        Whether each two joints are moved together, too.
    least_seconds : float
        So long the least clearance over the range of each joint is looked for; 0: not at all. Verdicts do not need it.
    tolerance : float
        Of pairs of joints: the search ends once a contact is known and no more than this share of the configurations is open.
    seconds : float
        After this time, what is not decided is unknown.

    Returns
    -------
    Report

    Raises
    ------
    InvalidInput
        For a name that no part has, and numbers out of their range.
    """
    if not (0 <= allowed_overlap < float("inf") and 0 < tolerance <= 1 and seconds > 0 and least_seconds >= 0):
        raise InvalidInput(
            "allowed_overlap, tolerance, seconds, least_seconds: must be at least 0; in (0, 1]; above 0; at least 0"
        )
    end = time.monotonic() + seconds
    meant = _matching(assembly, intended)
    bodies, warnings = assembly.bodies(allowed_overlap)
    report = Report(
        name=assembly.name,
        parts=assembly.parts,
        intended=sorted(meant),
        allowed_overlap=allowed_overlap,
        warnings=[*assembly.warnings, *warnings],
        assembly=assembly,
    )
    try:
        with Limit(seconds):
            _at_rest(assembly, bodies, meant, report, allowed_overlap)
    except Cancelled:
        report.is_complete = False
        return report
    touching = {touch.pair for touch in report.touching}
    report.ignore_touching = ignore_touching
    joints = [joint for joint in assembly.joints if joint.type in MOVING and joint.follows is None]
    if not joints:
        return report
    for joint in joints:
        report.joints.append(_Ranges(assembly, [joint], bodies, meant | touching, allowed_overlap, end).of_one(least_seconds))
    together = list(itertools.combinations(joints, 2)) if pairs else []
    for number, two in enumerate(together):
        now = time.monotonic()  # each pair has its share of the time that is left
        until = now + max(end - now, 0.0) / (len(together) - number)
        report.pairs.append(_Ranges(assembly, two, bodies, meant | touching, allowed_overlap, until).of_two(tolerance))
    return report


def _matching(assembly: Assembly, intended: Collection[tuple[str, str]]) -> set[tuple[str, str]]:
    """Pairs of parts by patterns, in the order of the parts."""
    found = set()
    for patterns in intended:
        if isinstance(patterns, str) or len(patterns) != 2:
            raise InvalidInput(f"intended: {patterns!r} is no pair of names")
        ends = [{name for name in assembly.parts if fnmatch.fnmatchcase(name, pattern)} for pattern in patterns]
        for pattern, names in zip(patterns, ends, strict=True):
            if not names:
                raise InvalidInput(f"intended: {pattern!r} is no part; the parts are {', '.join(assembly.parts)}")
        two = itertools.combinations(assembly.parts, 2)
        found |= {(a, b) for a, b in two if (a in ends[0] and b in ends[1]) or (b in ends[0] and a in ends[1])}
    return found


def _ordered(assembly: Assembly, pair: Any) -> tuple[str, str]:
    names = list(assembly.parts)
    first, second = sorted(pair, key=names.index)
    return first, second


def _at_rest(assembly: Assembly, bodies: Any, meant: set[tuple[str, str]], report: Report, allowed: float) -> None:
    """The pairs that touch as mounted, and the nearest of the others."""
    robot, rest = assembly.loose(bodies, meant)
    for pair in RobotChecker(robot).pairs_in_contact(rest):
        first, second = _ordered(assembly, pair)
        report.touching.append(_touch(assembly, first, second, bodies, allowed))
    robot, rest = assembly.loose(bodies, meant | {touch.pair for touch in report.touching})
    if len(robot.tested_pairs()) > 0:
        near = RobotChecker(robot).least_distance(rest, rest, 1e-3)
        report.least = _clearance(assembly, near, {}, allowed) if near.pair is not None else None


def _touch(assembly: Assembly, first: str, second: str, bodies: Any, allowed: float) -> Touch:
    """Where two parts touch as mounted, and whether the true ones are proven to."""
    places = (assembly.parts[first].place, assembly.parts[second].place)
    found = None
    for moving, fixed in itertools.product(bodies[first], bodies[second]):
        found = first_contact(moving, fixed, places[0], places[0], fixed_start=places[1], fixed_goal=places[1])
        if found.verdict != "clear":
            break
    point = _point(found)
    parts = (assembly.parts[first], assembly.parts[second])
    is_proven = False
    if allowed == 0 and found is not None and all(part.is_proven for part in parts):
        is_proven = _is_true(found, parts) or (point is not None and Overlap(parts, places, np.array(point)).is_proven(places))
    return Touch((first, second), point, is_proven)


def _is_true(found: Any, parts: tuple[Part, Part]) -> bool:
    """Whether a contact is one of the true parts, because their triangles are exact."""
    return bool(found.certain and all(part.bound == 0 for part in parts))


def _point(found: Any) -> list[float] | None:
    if found is None:
        return None
    if found.contacts:
        return [float(value) for value in found.contacts[0].point]
    place = found.inside_point if found.inside_point is not None else getattr(found.overlap, "point", None)
    return None if place is None else [float(value) for value in place]


def _clearance(assembly: Assembly, found: Any, values: dict[str, float], allowed: float) -> Clearance:
    """The bracket of the true parts. A point of a body around a part is at most twice its bound away from the part."""
    first, second = _ordered(assembly, found.pair)
    off = 2 * sum(assembly.parts[name].bound for name in (first, second)) + allowed
    return Clearance(
        (first, second), found.distance, found.distance_upper + off, _point(found) if found.contacts else None, values
    )


class _Ranges:
    """Questions about some joints while all others stay as mounted, until a time."""

    def __init__(
        self, assembly: Assembly, joints: Sequence[Joint], bodies: Any, left_out: set[tuple[str, str]], allowed: float, end: float
    ) -> None:
        self.assembly, self.joints, self.allowed, self.end = assembly, joints, allowed, end
        self.began = time.monotonic()
        self.robot = assembly.robot_of(bodies, left_out, moving={joint.name for joint in joints})
        values = {joint.name: joint.value for joint in joints}
        self.rest = np.array([values[name] for name in self.robot.variables], np.float64)
        self.index = {name: number for number, name in enumerate(self.robot.variables)}

    def left(self) -> float:
        return max(self.end - time.monotonic(), 1e-6)

    def limits(self, joint: Joint) -> tuple[float, float]:
        """Where a joint ends. Without a limit, a turn; or so far that nothing of the assembly is left beside the part."""
        way = np.pi if joint.type == "revolute" else 2 * self.assembly.size
        endless = (joint.value - way, joint.value + way)
        lower, upper = (
            given if np.isfinite(given) else other for given, other in zip((joint.lower, joint.upper), endless, strict=True)
        )
        if max(-lower, upper) > LARGEST:
            raise InvalidInput(
                f"joint {joint.name!r}: reaches {max(-lower, upper):g}, and values end at {LARGEST:g}: give it narrower limits"
            )
        return lower, upper

    def of_one(self, least_seconds: float) -> JointRange:
        """How far the joint goes from where it is mounted, to both sides, and how near anything comes on the way."""
        joint, checker = self.joints[0], RobotChecker(self.robot)
        lower, upper = self.limits(joint)
        found = JointRange(joint.name, joint.type, lower, upper, joint.value, [lower, upper])
        for side, end in enumerate((lower, upper)):
            stop = self.way(checker, joint, end)
            if stop is not None:
                found.clear[side], found.stops[side] = stop.clear_until, stop
        if least_seconds > 0 and not any(found.stops):
            path = np.concatenate([self.path(joint, lower)[::-1], self.path(joint, upper)[1:]])
            found.least = self.least(checker, joint, path, least_seconds) if len(path) > 1 and self.robot.tested_pairs() else None
        found.seconds = time.monotonic() - self.began
        return found

    def least(self, checker: RobotChecker, joint: Joint, path: Array, seconds: float) -> Clearance | None:
        """The least distance on a path: below that of samples, and above the largest margin that is proven for the whole path.

        Where one part turns within another one, the distance is the same all the way. There margins are proven much sooner than
        a least distance is found.
        """
        end = time.monotonic() + min(self.left(), seconds)
        number, near, lower = self.index[joint.name], None, 0.0
        for value in np.linspace(path[0, number], path[-1, number], SAMPLES):
            near = self.nearer(near, checker, path[0], number, value, end)
        for share in MARGINS:
            if near is None or near.pair is None or not near.distance_upper > 0:
                break
            with Limit(max(end - time.monotonic(), 1e-6)):
                found = RobotChecker(self.robot, margin=share * near.distance_upper).first_contact_on_path(path)
            if found.verdict == "unknown":
                break
            if found.verdict == "clear":
                lower = share * near.distance_upper
            else:
                near = self.nearer(near, checker, path[0], number, found.configuration[number], end)
        if near is None or near.pair is None:
            return None
        least = _clearance(self.assembly, near, {joint.name: float(near.configuration[number])}, self.allowed)
        least.lower = min(lower, near.distance)
        return least

    def nearer(self, near: Any, checker: RobotChecker, row: Array, number: int, value: float, end: float) -> Any:
        """The nearest one so far, and that at another value."""
        row = row.copy()
        row[number] = value
        with Limit(max(end - time.monotonic(), 1e-6)):
            found = checker.least_distance(row, row, 1e-3)
        is_nearer = found.pair is not None and found.contacts and (near is None or found.distance_upper < near.distance_upper)
        return found if is_nearer else near

    def path(self, joint: Joint, end: float) -> Array:
        """Configurations from where the assembly is mounted; straight paths take the shorter way, so a turn is four."""
        parts = max(1, int(np.ceil(abs(end - joint.value) / _QUARTER))) if joint.type == "revolute" else 1
        rows = np.tile(self.rest, (parts + 1, 1))
        rows[:, self.index[joint.name]] = np.linspace(joint.value, end, parts + 1)
        return rows

    def way(self, checker: RobotChecker, joint: Joint, end: float) -> Stop | None:
        """What stops a joint on its way to an end."""
        if end == joint.value:
            return None
        with Limit(self.left()):
            found = checker.first_contact_on_path(self.path(joint, end))
        if found.verdict == "clear":
            return None
        until = float(found.clear_configuration[self.index[joint.name]])
        if found.verdict == "unknown":
            return Stop(None, until, None, None)
        return Stop(_ordered(self.assembly, found.pair), until, self.proven_by(joint, end, found, until), _point(found))

    def proven_by(self, joint: Joint, end: float, found: Any, until: float) -> float | None:
        """The value by which the true parts are proven to touch."""
        pair = _ordered(self.assembly, found.pair)
        parts = (self.assembly.parts[pair[0]], self.assembly.parts[pair[1]])
        point, number = _point(found), self.index[joint.name]
        if self.allowed > 0 or point is None or not all(part.is_proven for part in parts):
            return None
        if _is_true(found, parts):
            rows = self.path(joint, end)[:, number]
            return float(np.interp(found.segment + found.time_upper, np.arange(len(rows)), rows))

        def poses_at(value: float) -> tuple[Array, Array]:
            row = self.rest.copy()
            row[number] = value
            places = self.assembly.poses(self.robot, row)
            return places[pair[0]], places[pair[1]]

        return first_proven(Overlap(parts, poses_at(until), np.array(point)), poses_at, until, end)

    def of_two(self, tolerance: float) -> PairRange:
        """All combinations of both joints."""
        lower, upper = self.rest.copy(), self.rest.copy()
        for joint in self.joints:
            lower[self.index[joint.name]], upper[self.index[joint.name]] = self.limits(joint)
        found = self.robot.range(lower, upper, tolerance=tolerance, seconds=self.left())
        return PairRange(
            (self.joints[0].name, self.joints[1].name),
            found.verdict,
            found.clear_share,
            found.contact_share,
            found.open_share,
            self.witness(found.witness),
            None if found.pair is None else _ordered(self.assembly, found.pair),
            found,
            time.monotonic() - self.began,
        )

    def witness(self, values: Array | None) -> dict[str, float] | None:
        return None if values is None else {name: float(values[number]) for name, number in self.index.items()}
