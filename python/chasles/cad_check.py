"""What an assembly is asked: clashes at rest, ranges of joints and of pairs of joints, least clearances, for `chasles.cad`."""

from __future__ import annotations

import itertools
import time
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np

from ._core import Cancelled, InvalidInput, Limit, RobotChecker, first_contact
from .cad_assembly import Assembly, Part
from .cad_bounds import Array
from .cad_intended import matching
from .cad_joints import MOVING, Joint, limits_of
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
        After this time, what is not decided is unknown, and `Report.is_complete` is False.

    Returns
    -------
    Report

    Raises
    ------
    InvalidInput
        For a name that no part has, numbers out of their range, and joints that do not go together: one that follows a joint
        that is not there, or that is mounted elsewhere than its leader puts it.
    """
    for name, value, is_right, range_ in (
        ("allowed_overlap", allowed_overlap, 0 <= allowed_overlap < np.inf, "at least 0 and finite"),
        ("tolerance", tolerance, 0 < tolerance <= 1, "in (0, 1]"),
        ("seconds", seconds, seconds > 0, "above 0"),
        ("least_seconds", least_seconds, least_seconds >= 0, "at least 0"),
    ):
        if not is_right:
            raise InvalidInput(f"{name}: must be {range_}, not {value}")
    end = time.monotonic() + seconds
    assembly.require_joints()
    meant = matching(assembly.parts, intended)
    bodies, warnings = assembly.bodies(allowed_overlap)
    whole = bodies if allowed_overlap == 0 else assembly.bodies(0.0)[0]
    report = Report(
        name=assembly.name,
        parts=assembly.parts,
        intended=sorted(meant),
        allowed_overlap=allowed_overlap,
        tolerance=tolerance,
        warnings=[*assembly.warnings, *warnings],
        assembly=assembly,
    )
    try:
        with Limit(max(end - time.monotonic(), 1e-6)):
            _at_rest(assembly, bodies, whole, meant, report)
    except Cancelled:
        report.is_rest_decided = False
        return report
    touching = {touch.pair for touch in report.touching}
    report.ignore_touching = ignore_touching
    joints = [joint for joint in assembly.joints if joint.type in MOVING and joint.follows is None]
    if not joints:
        return report
    given = (assembly, bodies, whole, meant | touching, allowed_overlap)
    for joint in joints:
        is_over = time.monotonic() >= end
        report.joints.append(_not_looked_at(assembly, joint) if is_over else _Ranges(*given, [joint], end).of_one(least_seconds))
    together = list(itertools.combinations(joints, 2)) if pairs else []
    for number, two in enumerate(together):
        now = time.monotonic()  # each pair has its share of the time that is left
        until = now + (end - now) / (len(together) - number)
        names = (two[0].name, two[1].name)
        report.pairs.append(
            PairRange(names, "open", 0.0, 0.0, 1.0, None, None, None, 0.0)
            if now >= end
            else _Ranges(*given, two, until).of_two(tolerance)
        )
    return report


def _not_looked_at(assembly: Assembly, joint: Joint) -> JointRange:
    """The range of a joint for which no time was left."""
    lower, upper = _limits(assembly, joint)
    stops = [Stop(None, joint.value, None, None) if end != joint.value else None for end in (lower, upper)]
    return JointRange(joint.name, joint.type, lower, upper, joint.value, [joint.value, joint.value], stops)


def _limits(assembly: Assembly, joint: Joint) -> tuple[float, float]:
    """Where a joint ends. Without a limit, a turn; or so far that nothing of the assembly is left beside the part."""
    way = np.pi if joint.type == "revolute" else 2 * assembly.size
    endless = (joint.value - way, joint.value + way)
    lower, upper = (
        given if np.isfinite(given) else other for given, other in zip(limits_of(joint, assembly.joints), endless, strict=True)
    )
    if max(-lower, upper) > LARGEST:
        raise InvalidInput(
            f"joint {joint.name!r}: reaches {max(-lower, upper):g}, and values end at {LARGEST:g}: give it narrower limits"
        )
    return lower, upper


def _ordered(assembly: Assembly, pair: Any) -> tuple[str, str]:
    names = list(assembly.parts)
    first, second = sorted(pair, key=names.index)
    return first, second


def _at_rest(assembly: Assembly, bodies: Any, whole: Any, meant: set[tuple[str, str]], report: Report) -> None:
    """The pairs that touch as mounted, and the nearest of the others: faces that are moved inwards have no distance of parts."""
    robot, rest = assembly.loose(bodies, meant)
    for pair in RobotChecker(robot).pairs_in_contact(rest):
        first, second = _ordered(assembly, pair)
        report.touching.append(_touch(assembly, first, second, bodies, report.allowed_overlap))
    robot, rest = assembly.loose(whole, meant | {touch.pair for touch in report.touching})
    if len(robot.tested_pairs()) > 0:
        near = RobotChecker(robot).least_distance(rest, rest, 1e-3)
        report.least = _clearance(assembly, near, {})


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


def _clearance(assembly: Assembly, found: Any, values: dict[str, float]) -> Clearance | None:
    """The bracket of the true parts. A point of a body around a part is at most twice its bound away from the part."""
    if found.pair is None or not np.isfinite(found.distance_upper):
        return None  # time was over before any distance was found
    first, second = _ordered(assembly, found.pair)
    off = 2 * sum(assembly.parts[name].bound for name in (first, second))
    return Clearance(
        (first, second), found.distance, found.distance_upper + off, _point(found) if found.contacts else None, values
    )


class _Ranges:
    """Questions about some joints while all others stay as mounted, until a time."""

    def __init__(
        self,
        assembly: Assembly,
        bodies: Any,
        whole: Any,
        left_out: set[tuple[str, str]],
        allowed: float,
        joints: Sequence[Joint],
        end: float,
    ) -> None:
        self.assembly, self.joints, self.allowed, self.end = assembly, joints, allowed, end
        self.began = time.monotonic()
        moving = {joint.name for joint in joints}
        self.robot = assembly.robot_of(bodies, left_out, moving=moving)
        self.whole = self.robot if whole is bodies else assembly.robot_of(whole, left_out, moving=moving)  # for distances
        values = {joint.name: joint.value for joint in joints}
        self.rest = np.array([values[name] for name in self.robot.variables], np.float64)
        self.index = {name: number for number, name in enumerate(self.robot.variables)}

    def left(self) -> float:
        return max(self.end - time.monotonic(), 1e-6)

    def of_one(self, least_seconds: float) -> JointRange:
        """How far the joint goes from where it is mounted, to both sides, and how near anything comes on the way."""
        joint, checker = self.joints[0], RobotChecker(self.robot)
        lower, upper = _limits(self.assembly, joint)
        found = JointRange(joint.name, joint.type, lower, upper, joint.value, [lower, upper])
        for side, end in enumerate((lower, upper)):
            stop = self.way(checker, joint, end)
            if stop is not None:
                found.clear[side], found.stops[side] = stop.clear_until, stop
        if least_seconds > 0 and not any(found.stops):
            path = np.concatenate([self.path(joint, lower)[::-1], self.path(joint, upper)[1:]])
            found.least = self.least(joint, path, least_seconds) if len(path) > 1 and self.robot.tested_pairs() else None
        found.seconds = time.monotonic() - self.began
        return found

    def least(self, joint: Joint, path: Array, seconds: float) -> Clearance | None:
        """The least distance of the whole bodies on a path: below that of samples, and above the largest margin that is proven for the whole path.

        Where one part turns within another one, the distance is the same all the way. There margins are proven much sooner than
        a least distance is found.
        """
        end = time.monotonic() + min(self.left(), seconds)
        number, near, lower = self.index[joint.name], None, 0.0
        checker = RobotChecker(self.whole)
        for value in np.linspace(path[0, number], path[-1, number], SAMPLES):
            near = self.nearer(near, checker, path[0], number, value, end)
        for share in MARGINS:
            if near is None or near.pair is None or not near.distance > 0:
                break  # with an overlap that is allowed, parts may touch where the joint is clear
            with Limit(max(end - time.monotonic(), 1e-6)):
                found = RobotChecker(self.whole, margin=share * near.distance_upper).first_contact_on_path(path)
            if found.verdict == "unknown":
                break
            if found.verdict == "clear":
                lower = share * near.distance_upper
            else:
                near = self.nearer(near, checker, path[0], number, found.configuration[number], end)
        least = None if near is None else _clearance(self.assembly, near, {joint.name: float(near.configuration[number])})
        if least is not None:
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
            if time.monotonic() > self.end:
                raise Cancelled("the time was over")
            row = self.rest.copy()
            row[number] = value
            places = self.assembly.poses(self.robot, row)
            return places[pair[0]], places[pair[1]]

        try:
            return first_proven(Overlap(parts, poses_at(until), np.array(point)), poses_at, until, end)
        except Cancelled:
            return None

    def of_two(self, tolerance: float) -> PairRange:
        """All combinations of both joints."""
        lower, upper = self.rest.copy(), self.rest.copy()
        for joint in self.joints:
            lower[self.index[joint.name]], upper[self.index[joint.name]] = _limits(self.assembly, joint)
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
