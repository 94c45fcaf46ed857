"""Validators for the planners of OMPL: motions are proven instead of sampled.

This module requires the package `ompl` (2.0 or later), and is imported by its name: ``import chasles.ompl``.

    checker = chasles.RobotChecker(robot, scene)
    information.setStateValidityChecker(chasles.ompl.RobotValidityChecker(information, checker))
    information.setMotionValidator(chasles.ompl.RobotMotionValidator(information, checker))

The classes are those of the C++ header chasles/ompl.h and keep the same contract, with three limits of the package
`ompl` (as of 2.0.1):

- A planner in C++ can ask a validator in Python only for "valid or not". Its question for the last valid state arrives
  as this question, and the planner's last valid state and fraction stay as they were. KPIECE1 and BKPIECE1 therefore
  keep no part of a motion that is not valid. `checkMotion` with three arguments is for callers in Python.
- The counters of `SpaceInformation` do not count the motions that a validator in Python answers. Those of the
  validator do.
- `setMotionValidator` keeps the validator, the checker and the space information until the process ends: the package
  hides from Python's garbage collector what a space information refers to. At the end this module lets them go. A
  validator refuses later calls.
"""

import atexit
import threading
import weakref
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import Cancelled, InvalidInput, Polyhedron, Robot, RobotChecker, _free_body, _why_cancelled
from .articles import with_article
from .arrays import finite
from .enums import Verdict
from .extras import extra

with extra("ompl", __name__):
    from ompl import base as _base

__all__ = ["LastValid", "RobotMotionValidator", "RobotValidityChecker", "StateMap", "free_body"]

_ROTATION = ("rot_x", "rot_y", "rot_z", "rot_w")


def free_body(shape: Polyhedron, name: str = "body") -> Robot:
    """A body that moves freely in space, as a robot for an SE3StateSpace.

    Its variables are x, y, z and a quaternion x, y, z, w. OMPL's interpolation, a straight line of the origin and slerp,
    is a straight path of this robot.
    """
    return _free_body(shape, name)


@dataclass
class LastValid:
    """The last valid state of a motion: the pair that OMPL's three-argument `checkMotion` takes."""

    first: Any = None  #: a state to write to, which may be one of both ends of the motion; None for the fraction only
    second: float = 0.0  #: the part of the motion that is proven, in [0, 1]


@dataclass(frozen=True)
class _Layout:
    """The numbers of the states of a space, in the order of `copyToReals`."""

    kinds: list[str]  # of each number: "line", "angle" or one of _ROTATION
    read: Callable[[Any], list[float]]


def _layout(space: Any) -> _Layout:
    """Refuses spaces whose interpolation is not known to be the straight path of a robot."""
    known = next((kind for kind in type(space).__mro__ if kind.__module__.startswith("ompl.")), None)
    if known not in _LAYOUTS or type(space).interpolate is not known.interpolate:
        raise InvalidInput(
            f"space: {type(space).__name__}: its interpolation need not be a straight path of a robot; RealVector, SO2, "
            "SO3, SE2 and SE3 state spaces and compounds of them can be used"
        )
    return _LAYOUTS[known](space)


def _real_vector(space: Any) -> _Layout:
    size = space.getDimension()
    return _Layout(["line"] * size, lambda state: state[0:size])


def _compound(space: Any) -> _Layout:
    parts = [_layout(part) for part in space.getSubspaces()]
    kinds = [kind for part in parts for kind in part.kinds]
    return _Layout(kinds, lambda state: [x for i, part in enumerate(parts) for x in part.read(state[i])])


def _read_so3(state: Any) -> list[float]:
    return [state.x, state.y, state.z, state.w]


_LAYOUTS: dict[Any, Callable[[Any], _Layout]] = {
    _base.RealVectorStateSpace: _real_vector,
    _base.CompoundStateSpace: _compound,
    _base.SO2StateSpace: lambda _: _Layout(["angle"], lambda state: [state.value]),
    _base.SO3StateSpace: lambda _: _Layout([*_ROTATION], _read_so3),
    _base.SE2StateSpace: lambda _: _Layout(
        ["line", "line", "angle"], lambda state: [state.getX(), state.getY(), state.getYaw()]
    ),
    _base.SE3StateSpace: lambda _: _Layout(
        ["line", "line", "line", *_ROTATION],
        lambda state: [state.getX(), state.getY(), state.getZ(), *_read_so3(state.rotation())],
    ),
}


class StateMap:
    """How the numbers of a state are the variables of a robot.

    The numbers are those of a RealVectorStateSpace, SO2StateSpace (where `robot.continuous` is true), SE2StateSpace
    (for planar joints), SE3StateSpace (for floating ones) or a compound of them, in the order of `copyToReals`.

    Parameters
    ----------
    robot : Robot
    names : sequence of str, optional
        The variables of the robot, one for each number of a state; all of them in order by default.
    others : array (variables,), optional
        The values of all variables that a state does not have; `robot.neutral()` by default.

    Raises
    ------
    InvalidInput
        For an unknown name, one name twice, and for a wrong number of values.
    """

    def __init__(self, robot: Robot, names: Sequence[str] | None = None, others: npt.ArrayLike | None = None):
        if not isinstance(robot, Robot):
            raise TypeError(f"robot: {with_article(robot)} is not a chasles.Robot")
        if isinstance(names, str):
            raise InvalidInput(f"names: {names!r} is one text; a sequence of names is needed")
        all_names = robot.variables
        self._names = list(all_names if names is None else names)
        for i, name in enumerate(self._names):
            if name not in all_names:
                raise InvalidInput(f"robot: {name}: there is no such variable of a joint")
            if name in self._names[:i]:
                raise InvalidInput(f"names: {name}: is named twice")
        self._indices = np.array([all_names.index(name) for name in self._names], np.intp)
        self._is_identity = self._names == all_names
        self._is_continuous = [robot.continuous[i] for i in self._indices]
        self._others = _values(robot, others)

    def __call__(self, space: Any, state: Any) -> npt.NDArray[np.float64]:
        """The configuration (variables,) of a state. Raises InvalidInput for a space that does not fit."""
        return self.reader(space)(state)

    def reader(self, space: Any) -> Callable[[Any], npt.NDArray[np.float64]]:
        """The function from states of a space to configurations. Raises InvalidInput for a space that does not fit."""
        layout = _layout(space)
        self._check(layout.kinds)
        read, others, indices = layout.read, self._others, self._indices
        if self._is_identity:
            return lambda state: np.array(read(state), np.float64)

        def values(state: Any) -> npt.NDArray[np.float64]:
            configuration = others.copy()
            configuration[indices] = read(state)
            return configuration

        return values

    def configurations(self, space: Any, path: Any) -> npt.NDArray[np.float64]:
        """The configurations (n, variables) of the states of an `ompl.geometric.PathGeometric`."""
        read = self.reader(space)
        return np.array([read(path.getState(i)) for i in range(path.getStateCount())])

    def _check(self, kinds: list[str]) -> None:
        if len(kinds) != len(self._names):
            raise InvalidInput(f"state: has {len(kinds)} numbers, and {len(self._names)} variables are named")
        for i, (kind, name, is_continuous) in enumerate(zip(kinds, self._names, self._is_continuous, strict=True)):
            joint, _, suffix = name.rpartition("/")
            wanted = "angle" if is_continuous else suffix if suffix in _ROTATION else "line"
            first = i - _ROTATION.index(suffix) if suffix in _ROTATION else i
            if kind != wanted or (suffix in _ROTATION and self._names[first].rpartition("/")[0] != joint):
                raise InvalidInput(f"space: number {i}: {_MISFITS[wanted].format(name)}")


_MISFITS = {
    "angle": "{} goes the shorter way round, as a number of an SO2StateSpace or the last one of an SE2StateSpace does",
    "line": "{} goes straight, as a number of a RealVectorStateSpace does",
    **{part: "{} is part of a quaternion, as in an SO3StateSpace or an SE3StateSpace" for part in _ROTATION},
}


def _values(robot: Robot, others: npt.ArrayLike | None) -> npt.NDArray[np.float64]:
    values = np.array(robot.neutral() if others is None else finite(others, "others"))
    if values.shape != (len(robot.variables),):
        raise InvalidInput(f"others: the shape is {values.shape}; ({len(robot.variables)},) is needed")
    return values


def _reader(information: Any, checker: Any, state_map: Any) -> Callable[[Any], npt.NDArray[np.float64]]:
    """From states to configurations. Refuses a space that does not fit."""
    if not isinstance(information, _base.SpaceInformation):
        raise TypeError(f"information: {with_article(information)} is not an ompl.base.SpaceInformation")
    if not isinstance(checker, RobotChecker):
        raise TypeError(f"checker: {with_article(checker)} is not a chasles.RobotChecker")
    if state_map is None:
        state_map = StateMap(checker.robot)
    if not isinstance(state_map, StateMap):
        raise TypeError(f"state_map: {with_article(state_map)} is not a chasles.ompl.StateMap")
    if len(state_map._others) != len(checker.robot.variables):
        raise InvalidInput("state_map: is that of another robot")
    return state_map.reader(information.getStateSpace())


class _Released:
    """Stands for the space information of a validator after the end of the process has begun."""

    def __getattr__(self, name: str) -> Any:
        raise RuntimeError("chasles.ompl: the process is ending, and the validator has let its space information go")


_validators: "weakref.WeakSet[Any]" = weakref.WeakSet()


@atexit.register
def _release() -> None:
    """Breaks the cycles of validators and space informations, so that nothing is left at the end."""
    for validator in list(_validators):
        validator._information = _Released()
        if hasattr(validator, "_local"):
            validator._local = threading.local()


class RobotValidityChecker(_base.StateValidityChecker):
    """A state is valid within the bounds of its space, if the robot touches nothing there.

    Parameters
    ----------
    information : ompl.base.SpaceInformation
    checker : RobotChecker
    state_map : StateMap, optional
        All variables in order by default.

    Raises
    ------
    InvalidInput
        For a space that does not fit the robot, or whose interpolation need not be straight.
    """

    def __init__(self, information: Any, checker: RobotChecker, state_map: StateMap | None = None):
        self._values = _reader(information, checker, state_map)
        super().__init__(information)
        self._information, self._checker = information, checker
        _validators.add(self)

    def isValid(self, state: Any) -> bool:  # noqa: N802 (OMPL's name)
        """Whether a state is valid."""
        return self._information.satisfiesBounds(state) and self._checker.is_clear(self._values(state))


class RobotMotionValidator(_base.MotionValidator):
    """A motion is valid if it is proven that the robot touches nothing on the way, and if its end is valid.

    Parameters and errors are those of `RobotValidityChecker`. The validity checker has to be set in `information`, too.
    """

    def __init__(self, information: Any, checker: RobotChecker, state_map: StateMap | None = None):
        self._values = _reader(information, checker, state_map)
        super().__init__(information)
        self._information, self._checker = information, checker
        _validators.add(self)
        self._lock, self._local = threading.Lock(), threading.local()
        self.resetMotionCounter()

    def checkMotion(self, s1: Any, s2: Any, last: LastValid | None = None) -> bool:  # noqa: N802
        """Whether the motion between two states is valid.

        Parameters
        ----------
        s1, s2 : states
            `s1` counts as valid, as in OMPL.
        last : LastValid, optional
            Stays as it is if the motion is valid. Otherwise `second` is a proven lower bound: the motion is clear up to
            there, and the state there is valid itself. This state is written to `first`, unless it is None. The motion
            to it, rounded as it is, is proven both ways.
        """
        if last is not None and not isinstance(last, LastValid):
            raise TypeError(f"last: {with_article(last)} is not a chasles.ompl.LastValid")
        if self._information.getStateValidityChecker() is None:  # OMPL would read through a null pointer
            raise InvalidInput("information: has no validity checker; call setStateValidityChecker or setup first")
        is_valid = self._is_valid(s1, s2) if last is None else self._is_valid_or_last(s1, s2, last)
        with self._lock:
            self._counts[0 if is_valid else 1] += 1
        return is_valid

    def _is_valid(self, s1: Any, s2: Any) -> bool:
        return self._information.isValid(s2) and self._checker.is_clear(self._values(s1), self._values(s2))

    def _is_valid_or_last(self, s1: Any, s2: Any, last: LastValid) -> bool:
        found = self._checker.first_contact(self._values(s1), self._values(s2))
        if found.verdict == Verdict.unknown:
            raise Cancelled(_why_cancelled)
        is_clear = found.verdict == Verdict.clear
        if is_clear and self._information.isValid(s2):
            return True
        self._set_last(s1, s2, 1.0 if is_clear else found.clear_until, last)
        return False

    def _set_last(self, s1: Any, s2: Any, clear_until: float, last: LastValid) -> None:
        """States are rounded, so the one at the end of the clear part may touch: it is approached from before, until the
        motion to it and back is proven."""
        information, between = self._information, self._scratch()
        space = information.getStateSpace()
        for k in range(17):  # steps of 1e-10 to 0.43 of the motion
            fraction = clear_until - 1e-10 * 4.0**k
            if fraction <= 0:
                break
            space.interpolate(s1, s2, fraction, between)
            if information.isValid(between) and self._is_clear_both_ways(s1, between):
                break
        else:
            fraction = 0.0
        if fraction <= 0:
            fraction = 0.0
            information.copyState(between, s1)
        if last.first is not None:
            information.copyState(last.first, between)
        last.second = fraction

    def _is_clear_both_ways(self, s1: Any, s2: Any) -> bool:
        a, b = self._values(s1), self._values(s2)
        return self._checker.is_clear(b, a) and self._checker.is_clear(a, b)

    def _scratch(self) -> Any:
        """A state of this thread. It is made once, because the package may free states twice, or never."""
        if not hasattr(self._local, "state"):
            self._local.state = self._information.allocState()
        return self._local.state

    def getValidMotionCount(self) -> int:  # noqa: N802
        """How many motions were valid."""
        return self._counts[0]

    def getInvalidMotionCount(self) -> int:  # noqa: N802
        """How many motions were not valid."""
        return self._counts[1]

    def getCheckedMotionCount(self) -> int:  # noqa: N802
        """How many motions were checked."""
        return sum(self._counts)

    def getValidMotionFraction(self) -> float:  # noqa: N802
        """The part of the checked motions that were valid; 0 if none was checked."""
        checked = self.getCheckedMotionCount()
        return self._counts[0] / checked if checked else 0.0

    def resetMotionCounter(self) -> None:  # noqa: N802
        """Counts from zero again."""
        self._counts = [0, 0]
