"""A gate for the actions of a policy: what is not proven does not reach the robot.

    gate = chasles.policy.PolicyGate(robot, scene, margin=0.01, mode="shorten", milliseconds=5)
    decision = gate(present, actions)
    decision.verdict, decision.actions, decision.reason

A chunk is checked as the path that the controller makes of it, from the present configuration on, against the robot itself
and a scene at rest. What is not decided within the budget of time counts as not proven. For LeRobot see `chasles.lerobot`.
Reasons: docs/decisions/0116-policy-gate.md.
"""

import math
import time
from collections.abc import Callable
from typing import Literal, NoReturn

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, JointPath, Limit, Motion, Robot, RobotChecker, Scene
from .articles import with_article
from .arrays import numbers
from .gate_decision import Floats, GateDecision
from .gate_question import BANDS, SINGLE, GateQuestion

__all__ = ["GateDecision", "PolicyGate"]

Interpolation = Literal["straight", "natural_spline"] | Callable[[Robot, Floats, Floats], JointPath]

_MODES = ("refuse", "shorten", "scale")
_RESERVE = 0.3e-3  # seconds of a budget, in which a search ends and the decision is made: measured, see the decision note


class PolicyGate:
    """Lets pass what is proven of the actions of a policy. Several threads may call one gate.

    Parameters
    ----------
    robot : Robot
    scene : Scene, optional
        The world, whose bodies stand still; without it the robot itself only. `set_scene` takes another one.
    margin : float
        Distance that counts as contact, mesh unit. It has to cover how far the robot strays from the path.
    hold : float, optional
        What is within the margin at the present configuration may move on, but comes no nearer than this. Half of the
        margin by default. Not for "scale".
    mode : "refuse", "shorten" or "scale"
        Of a chunk that is not proven as a whole: nothing passes, or the first actions that are proven. "scale": the
        first actions that are proven, at a speed by the proven distance: 0 at the margin, full from `full_speed_from`
        on, in steps of an eighth below the straight line between them. The speed falls within a chunk, and never rises.
    full_speed_from : float, optional
        Distance, mesh unit; with "scale" only, and greater than the margin.
    interpolation : "straight", "natural_spline" or a function
        What the controller makes of the actions. A function takes the robot, times (n + 1,) from 0 to n, and
        configurations (n + 1, variables), the present one first; it returns a JointPath. With another one than "straight",
        fewer actions are another path, which is proven again, and "scale" slows the whole chunk or refuses it.
    milliseconds : float
        The budget of a call.

    Raises
    ------
    InvalidInput
        For an option out of its range, and for bodies of the scene that move.
    """

    def __init__(
        self,
        robot: Robot,
        scene: Scene | None = None,
        *,
        margin: float = 0.0,
        hold: float | None = None,
        mode: str = "refuse",
        full_speed_from: float | None = None,
        interpolation: Interpolation = "straight",
        milliseconds: float = 5.0,
    ):
        if not isinstance(robot, Robot):
            raise TypeError(f"robot: {with_article(robot)} is not a chasles.Robot")
        self._robot, self._margin = robot, float(margin)
        _checked_mode(mode, self._margin, hold, full_speed_from)
        _checked_interpolation(interpolation)
        self._mode, self._interpolation = mode, interpolation
        self._hold = self._margin / 2 if hold is None and self._margin > 0 and mode != "scale" else hold
        if not (math.isfinite(milliseconds) and milliseconds > 0):
            raise InvalidInput(f"milliseconds: {milliseconds} is not a positive number")
        self._seconds = milliseconds / 1000
        top = self._margin if full_speed_from is None else float(full_speed_from)
        self._levels = np.linspace(self._margin, top, 1 if full_speed_from is None else BANDS + 1)
        self._limits, self._continuous = robot.limits, np.array(robot.continuous, bool)
        self._slack = SINGLE * np.abs(np.nan_to_num(self._limits, posinf=0, neginf=0))
        self.set_scene(scene)

    @property
    def robot(self) -> Robot:
        """As it was given."""
        return self._robot

    @property
    def mode(self) -> str:
        """As it was given."""
        return self._mode

    @property
    def is_straight(self) -> bool:
        """Whether the controller goes straight from action to action."""
        return self._interpolation == "straight"

    def set_scene(self, scene: Scene | None) -> None:
        """Take another world, and the robot with its parts, as they are now, for all later calls.

        Raises InvalidInput for bodies that move.
        """
        for name in _movers(scene):
            raise InvalidInput(
                f"scene: {name}: moves, and a gate is about a world at rest, in which the robot may stop: give the body "
                "the pose that it has now, or one body that encloses its way"
            )
        plain = [RobotChecker(self._robot, scene, margin=level) for level in self._levels]
        held = None if self._hold is None else RobotChecker(self._robot, scene, margin=self._margin, hold=self._hold)
        self._checkers = plain, held  # at once, for threads that ask

    def __call__(self, present: npt.ArrayLike, actions: npt.ArrayLike) -> GateDecision:
        """What may be sent of a chunk.

        Parameters
        ----------
        present : array (variables,)
            Where the robot is, in the order of `robot.variables`: radians, or the mesh unit.
        actions : array (n, variables)
            Where it is to be, one period after another.

        Raises
        ------
        InvalidInput
            For other shapes, and what is no array of numbers. Values that no robot can take (not finite, beyond the limits) are refused by the decision.
        """
        begin = time.perf_counter()
        rows = _rows(present, actions, len(self._limits))
        with Limit(max(self._seconds / 2, self._seconds - _RESERVE)) as limit:
            question = GateQuestion(self, rows, limit)
            speeds = question.speeds()
        return question.decision(speeds, 1000 * (time.perf_counter() - begin))

    def __reduce__(self) -> NoReturn:
        what = "cannot pickle or copy a chasles.policy.PolicyGate"
        raise TypeError(f"{what}: pickle its robot and its scene, and make another one")

    def _path(self, rows: Floats) -> JointPath:
        """What the controller makes of the present configuration and the actions."""
        times = np.arange(len(rows), dtype=np.float64)
        if self._interpolation == "straight":
            return JointPath.straight(self._robot, rows)
        if self._interpolation == "natural_spline":
            return JointPath.natural_spline(self._robot, times, rows)
        path = self._interpolation(self._robot, times, rows)
        if not isinstance(path, JointPath):
            raise TypeError(f"interpolation: returned {with_article(path)}, not a chasles.JointPath")
        if path.times[0] != 0 or path.times[-1] != times[-1]:
            raise InvalidInput(
                f"interpolation: its path has the times {path.times[0]} to {path.times[-1]}; 0 to {times[-1]} are needed"
            )
        if not np.allclose(path.at(0.0), rows[0], rtol=0, atol=1e-6):
            raise InvalidInput("interpolation: its path does not begin at the present configuration")
        return path


def _checked_mode(mode: str, margin: float, hold: float | None, full_speed_from: float | None) -> None:
    if mode not in _MODES:
        raise InvalidInput(f"mode: {mode!r} is none of {', '.join(_MODES)}")
    if (mode == "scale") != (full_speed_from is not None):
        raise InvalidInput(f'full_speed_from: {full_speed_from} with the mode "{mode}"; it belongs to "scale", which needs it')
    if full_speed_from is not None and not margin < full_speed_from < math.inf:
        raise InvalidInput(f"full_speed_from: {full_speed_from} is not greater than the margin, {margin:g}")
    if mode == "scale" and hold is not None:
        raise InvalidInput('hold: has no effect with the mode "scale", which stops at the margin')


def _checked_interpolation(interpolation: Interpolation) -> None:
    if not callable(interpolation) and interpolation not in ("straight", "natural_spline"):
        raise InvalidInput(
            f'interpolation: {interpolation!r} is neither "straight" nor "natural_spline"; give a function for others'
        )


def _movers(scene: Scene | None) -> list[str]:
    bodies = [] if scene is None else scene.__getstate__()[0]
    return [name for name, _, motion, _ in bodies if not (isinstance(motion, Motion) and _is_rest(motion))]


def _is_rest(motion: Motion) -> bool:
    recipe = motion.__getstate__()
    return len(recipe) == 1 and recipe[0][0] == "rest"


def _rows(present: npt.ArrayLike, actions: npt.ArrayLike, variables: int) -> Floats:
    """The present configuration and the actions, (n + 1, variables)."""
    first, rest = numbers(present, "present"), numbers(actions, "actions")
    if first.shape != (variables,):
        raise InvalidInput(f"present: the shape is {first.shape}; ({variables},) is needed")
    if rest.ndim != 2 or rest.shape[1] != variables or len(rest) == 0:
        raise InvalidInput(f"actions: the shape is {rest.shape}; (n, {variables}) is needed, with n of at least 1")
    return np.vstack([first, rest])
