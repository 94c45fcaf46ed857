"""Trajectories of ROS as the motion that controllers make of them, for `chasles.ros`."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from numbers import Real
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, JointPath, Robot
from .arrays import Array, numbers
from .ros_followers import Follower, follower_named, require_agreement

Point = tuple[float, list[Array]]  # its time, and its positions, velocities and accelerations as far as it has them
BEFORE = 0.001  # s
DEEPEST = 8  # messages around a trajectory


class Read(NamedTuple):
    """A path, and what a caller may want to say about it."""

    path: JointPath
    points: Array  #: the configurations of the message's points
    warnings: list[str]


def joint_path(message: Any, robot: Robot, *, start: npt.ArrayLike | None = None, tolerance: float = 0.01) -> JointPath:
    """The motion that ros2_control's joint_trajectory_controller makes of a trajectory.

    Between two points it is straight in joint space; cubic if both have velocities; quintic if both have accelerations, too.
    Values are taken as they are: a step of more than half a turn is the long way.

    Parameters
    ----------
    message : trajectory_msgs/JointTrajectory
        Of rclpy, of rosbags, or of dicts and lists as in YAML and JSON; or a message that contains one.
    robot : Robot
        Its variables have the names of the message's joints. A joint that follows another one may be named, too, if its values
        are those that it follows to, to 1e-4 radians or m.
    start : array (variables,), optional
        Where the robot rests at time 0: the begin of the way to a first point that comes later, straight or, if that has
        velocities, cubic. Continuous joints start with the whole turns that make this way the shorter one. Variables
        that are not in the message stay there. By default the path begins at the first point.
    tolerance : float
        A first point that is due at once may be so far from `start`, radians or m. The straight way to it is then proven,
        too, in the millisecond before time 0.

    Returns
    -------
    JointPath
        Times are those of `time_from_start`, s.

    Raises
    ------
    InvalidInput
        With the number of the point, counted from 0.
    """
    return read(message, robot, start, tolerance).path


def read(message: Any, robot: Robot, start: npt.ArrayLike | None, tolerance: float) -> Read:
    """As `joint_path`."""
    if not tolerance >= 0:
        raise InvalidInput(f"tolerance: must be at least 0, not {tolerance}")
    trajectory = _trajectory_in(message)
    names = _list(trajectory, "joint_names")
    rest = robot.neutral() if start is None else _start(start, robot)
    columns, followers = _columns_of(names, robot, start is not None)
    given = [_point(number, point, names) for number, point in enumerate(_list(trajectory, "points"))]
    _require_ascending(given)
    points = [(time, [state[list(columns)] for state in states]) for time, states in given]
    rows = [_whole(states, rest, list(columns.values())) for _, states in points]
    for number, (_, states) in enumerate(given):
        require_agreement(number, states, rows[number], followers, robot)
    before = _before(points[0], robot, rest, list(columns.values()), tolerance) if start is not None and points else []
    whole = [*(_whole(states, rest, list(columns.values())) for _, states in before), *rows]
    if len(whole) < 2:
        raise InvalidInput(f"points: a path needs at least two, and there are {len(whole)}; start is the state before them")
    try:
        path = _path(robot, [time for time, _ in [*before, *points]], whole)
    except InvalidInput as error:
        raise InvalidInput(_by_point(str(error), len(before))) from None
    warnings = [f"joint_names: ignored joints: {f.name!r}, which follows {f.leader!r}" for f in followers]
    return Read(path, np.array([row[0] for row in rows]), warnings)


def is_message(document: Any, depth: int = 0) -> bool:
    """Whether a document has a trajectory, which may be one that `joint_path` refuses."""
    if _get(document, "points") is not None or _get(document, "multi_dof_joint_trajectory") is not None:
        return True
    parts = [_get(document, key) for key in ("joint_trajectory", "trajectory", "goal")]
    inner = [entry for part in parts for entry in (part if isinstance(part, list | tuple) else [part])]
    return depth < DEEPEST and any(is_message(part, depth + 1) for part in inner if part is not None)


def _by_point(why: str, before: int) -> str:
    """The message of a path that counts its configurations, of which some are before the first point."""
    found = re.match(r"path: (segment|\w+) (\d+): ", why)
    if not found:
        return why
    place = int(found[2]) - before
    if found[1] == "segment":
        return f"points: the way to point {place + 1}: {why[found.end() :]}"
    return (f"points: point {place}: " if place >= 0 else "start: ") + why[found.end() :]


def _start(start: npt.ArrayLike, robot: Robot) -> Array:
    values = numbers(start, "start")
    if values.shape != (len(robot.variables),):
        raise InvalidInput(f"start: the shape is {values.shape}; ({len(robot.variables)},) is needed")
    _require_finite(values, robot.variables, "start")
    return values


def _require_finite(values: Array, names: Sequence[str], place: str) -> None:
    for name, value in zip(names, values.tolist(), strict=True):
        if not np.isfinite(value):
            raise InvalidInput(f"{place}: {name!r} is {value}; finite numbers are needed")


def _require_ascending(points: list[Point]) -> None:
    for number in range(1, len(points)):
        if not points[number][0] > points[number - 1][0]:
            why = f"{points[number][0]:g} s is not later than {points[number - 1][0]:g} s, that of the point before"
            raise InvalidInput(f"points: point {number}: time_from_start: {why}")


def _trajectory_in(message: Any) -> Any:
    """Wrappers hold it in one of these members, alone or as the only one of a list."""
    inner, depth = message, 0
    while _get(inner, "points") is None:
        depth += 1
        if _get(_get(inner, "multi_dof_joint_trajectory"), "joint_names"):
            raise InvalidInput("multi_dof_joint_trajectory: has joints, which are not read")
        inner = next(
            (part for key in ("joint_trajectory", "trajectory", "goal") if (part := _get(inner, key)) is not None), None
        )
        if isinstance(inner, list | tuple):
            if len(inner) != 1:
                raise InvalidInput(f"trajectory: there are {len(inner)}; give one of them")
            inner = inner[0]
        if inner is None or depth > DEEPEST:
            raise InvalidInput("message: has no points, and no trajectory or joint_trajectory that has them")
    return inner


def _get(message: Any, name: str) -> Any:
    return message.get(name) if isinstance(message, Mapping) else getattr(message, name, None)


def _list(message: Any, name: str) -> Sequence[Any]:
    value = _get(message, name)
    if value is None or isinstance(value, str | Mapping) or not hasattr(value, "__len__"):
        raise InvalidInput(f"{name}: must be a list, not {value!r}")
    return value  # type: ignore[no-any-return]


def _columns_of(names: Sequence[Any], robot: Robot, has_start: bool) -> tuple[dict[int, int], list[Follower]]:
    """The variables of the joints of a message by their places in it, and the joints in it that follow others."""
    number = {name: i for i, name in enumerate(robot.variables)}
    columns, followers = {}, []
    for place, name in enumerate(names):
        if isinstance(name, str) and name in number:
            columns[place] = number[name]
        elif follower := follower_named(name, place, robot):
            followers.append(follower)
        else:
            raise InvalidInput(
                f"joint_names: {name!r} is no variable of the robot, which has {', '.join(robot.variables)}"
            )
    if len(set(names)) < len(names):
        raise InvalidInput("joint_names: a name comes twice")
    missing = [name for name in robot.variables if name not in names]
    if not has_start and missing:
        raise InvalidInput(
            f"joint_names: {missing[0]!r} is missing: give start, where joints stay that are not in the message"
        )
    return columns, followers


def _point(number: int, point: Any, names: Sequence[str]) -> Point:
    states, joints = [], len(names)
    for name in ("positions", "velocities", "accelerations"):
        place, given = f"points: point {number}: {name}", _get(point, name)
        values = numbers([] if given is None else given, place)
        if values.ndim != 1:
            raise InvalidInput(f"{place}: the shape is {values.shape}; a list is needed, with a number for each of joint_names")
        if values.shape not in ((0,), (joints,)):
            raise InvalidInput(f"{place}: {values.size} found, and joint_names has {joints}")
        _require_finite(values, names[: len(values)], place)
        states.append(values)
    has = [state.size == joints for state in states]
    if not has[0]:
        raise InvalidInput(
            f"points: point {number}: has no positions; controllers that integrate velocities are not followed"
        )
    if has[2] and not has[1]:
        raise InvalidInput(
            f"points: point {number}: has accelerations and no velocities, for which controllers have no spline"
        )
    return _seconds(number, _get(point, "time_from_start")), [
        state for state, given in zip(states, has, strict=True) if given
    ]


def _seconds(number: int, duration: Any) -> float:
    """ROS 2 has sec and nanosec, ROS 1 secs and nsecs, and recordings nsec, too; others write the seconds. No part is dropped."""
    place = f"points: point {number}: time_from_start: "
    if isinstance(duration, Real):
        return _number(duration, place[:-2])
    spellings = ("sec", "secs"), ("nanosec", "nanosecs", "nsec", "nsecs")
    if isinstance(duration, Mapping) and (others := set(duration) - set(sum(spellings, ()))):
        raise InvalidInput(f"{place}unknown key {sorted(map(str, others))[0]!r}; a time has sec or secs, and {', '.join(spellings[1])}")
    parts = [[value for key in keys if (value := _get(duration, key)) is not None] for keys in spellings]
    if any(len(part) > 1 for part in parts):
        raise InvalidInput(f"{place}has a part in two spellings: leave one")
    if not any(parts):
        raise InvalidInput(f"{place}has neither sec nor nanosec, and is no number of seconds")
    whole, rest = (_number(part[0], place[:-2]) if part else 0.0 for part in parts)
    return whole + 1e-9 * rest


def _number(given: Any, place: str) -> float:
    value = numbers(given, place)
    if value.ndim or not np.isfinite(value):
        raise InvalidInput(f"{place}: {given!r} is no finite number")
    return float(value)


def _before(first: Point, robot: Robot, start: Array, columns: list[int], tolerance: float) -> list[Point]:
    """The state before the first point, as far as that is elsewhere. It has no acceleration, so the way is no quintic."""
    turns = np.round((first[1][0] - start[columns]) / (2 * np.pi)) * np.asarray(robot.continuous)[columns]
    begin = start[columns] + 2 * np.pi * turns
    if first[0] > 0:
        return [(0.0, [begin, np.zeros_like(begin)][: min(len(first[1]), 2)])]
    ways = np.abs(first[1][0] - begin)
    if ways.max(initial=0) > tolerance:
        name = robot.variables[columns[int(ways.argmax())]]
        where = f"{name!r} is {ways.max():.3g} from where the robot starts, which is more than the tolerance of {tolerance:g}"
        raise InvalidInput(f"points: point 0: is due at once, and {where}: give it a later time_from_start")
    return [(first[0] - BEFORE, [begin])] if ways.any() else []


def _whole(states: list[Array], rest: Array, columns: list[int]) -> list[Array]:
    """Of all variables: those that are not in the message stay."""
    result = [rest.copy(), *(np.zeros_like(rest) for _ in states[1:])]
    for values, state in zip(result, states, strict=True):
        values[columns] = state
    return result


def _path(robot: Robot, times: list[float], points: list[list[Array]]) -> JointPath:
    orders = {min(len(a), len(b)) for a, b in zip(points[:-1], points[1:], strict=True)}
    rows = [np.array([point[order] for point in points]) for order in range(min(len(point) for point in points))]
    turns = np.abs(np.diff(rows[0], axis=0))[:, np.asarray(robot.continuous, bool)]
    if orders == {3}:
        return JointPath.quintic(robot, times, *rows[:3])
    if orders == {2}:
        return JointPath.cubic(robot, times, *rows[:2])
    if orders == {1} and not (turns >= np.pi).any():
        return JointPath.straight(robot, rows[0], times)
    return _mixed_path(robot, times, points)


def _mixed_path(robot: Robot, times: list[float], points: list[list[Array]]) -> JointPath:
    """Segments of different orders. Coefficients are computed in rational numbers, and rounded once."""
    JointPath.straight(robot, [point[0] for point in points], times)  # refuses times and values that cannot be used
    coefficients = np.zeros((6, len(points) - 1, len(robot.variables)))
    for s, (a, b) in enumerate(zip(points[:-1], points[1:], strict=True)):
        duration, order = Fraction(times[s + 1]) - Fraction(times[s]), min(len(a), len(b))
        for i in range(len(robot.variables)):
            ends = [[Fraction(float(state[i])) for state in point[:order]] for point in (a, b)]
            try:
                coefficients[6 - 2 * order :, s, i] = [float(number) for number in _hermite(duration, *ends)][::-1]
            except OverflowError:
                raise InvalidInput(f"path: segment {s}: {robot.variables[i]} moves too fast for floating point") from None
    return JointPath.polynomials(robot, times, coefficients)


def _hermite(duration: Fraction, start: list[Fraction], goal: list[Fraction]) -> list[Fraction]:
    """The polynomial in time through the given positions, velocities and accelerations at both ends."""
    t, d = duration, goal[0] - start[0]
    if len(start) == 1:
        return [start[0], d / t]
    v, w = start[1] * t, goal[1] * t
    if len(start) == 2:
        scaled = [start[0], v, 3 * d - 2 * v - w, v + w - 2 * d]
    else:
        a, b = start[2] * t * t, goal[2] * t * t
        scaled = [start[0], v, a / 2, 10 * d - 6 * v - 4 * w - 3 * a / 2 + b / 2]
        scaled += [8 * v + 7 * w + 3 * a / 2 - b - 15 * d, 6 * d - 3 * (v + w) - a / 2 + b / 2]
    return [number / t**power for power, number in enumerate(scaled)]
