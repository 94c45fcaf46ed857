"""Steps for the pipelines of LeRobot: actions of a policy pass a `chasles.policy.PolicyGate` before they reach the robot.

This module requires the package `lerobot` (0.4 or later), and is imported by its name: ``import chasles.lerobot``.

    joints = chasles.lerobot.JointMap(robot, ["waist", "elbow", None], scale=math.pi / 180)
    step = chasles.lerobot.ChunkGateStep(gate, joints, present=lambda: latest_state)
    postprocessor.steps.append(step)          # after the step that undoes the normalisation
    step.decision.record()                    # also in the transition, as info["chasles_gate"]

What does not pass is replaced by the last action that did, or by the present state: the robot stops there, and a chunk keeps
its shape. A step cannot say in a file what its gate and its robot are: ``from_pretrained`` takes them by `overrides`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from lerobot.processor import PolicyActionProcessorStep, ProcessorStepRegistry, RobotActionProcessorStep, TransitionKey

from ._core import InvalidInput, Robot
from .articles import with_article
from .arrays import finite, numbers
from .gate_decision import Floats, GateDecision
from .policy import PolicyGate

__all__ = ["ActionGateStep", "ChunkGateStep", "JointMap"]


class JointMap:
    """How the numbers of an action are the variables of a robot: variable = scale * number + offset.

    Parameters
    ----------
    robot : Robot
    variables : sequence of str or None
        The variable of each number of an action; None for a number that moves no part of the robot's description.
    scale, offset : float or array (numbers,)
        From the unit of the numbers to radians, or to the mesh unit: `math.pi / 180` for degrees.
    others : array (variables,), optional
        The values of all variables that an action does not have; `robot.neutral()` by default.

    Raises
    ------
    InvalidInput
        For unknown names, one name twice, no name at all, other shapes, and for a scale of 0.
    """

    def __init__(
        self,
        robot: Robot,
        variables: Sequence[str | None],
        *,
        scale: npt.ArrayLike = 1.0,
        offset: npt.ArrayLike = 0.0,
        others: npt.ArrayLike | None = None,
    ):
        if not isinstance(robot, Robot):
            raise TypeError(f"robot: {with_article(robot)} is not a chasles.Robot")
        if isinstance(variables, str):
            raise InvalidInput(f"variables: {variables!r} is one text; a sequence of names is needed")
        self._count, known = len(variables), robot.variables
        self._columns = [i for i, name in enumerate(variables) if name is not None]
        named = [name for name in variables if name is not None]
        for i, name in enumerate(named):
            if name not in known:
                raise InvalidInput(f"variables: {name}: the robot has no such variable; it has {', '.join(known)}")
            if name in named[:i]:
                raise InvalidInput(f"variables: {name}: is named twice")
        if not named:
            raise InvalidInput("variables: names no variable of the robot, so nothing could be proven of an action")
        self._targets = [known.index(name) for name in named]
        self._scale, self._offset = self._numbers("scale", scale), self._numbers("offset", offset)
        if np.any(self._scale[self._columns] == 0):
            raise InvalidInput("scale: is 0, so no action would move the robot")
        self._others = np.array(robot.neutral() if others is None else finite(others, "others"))
        if self._others.shape != (len(known),):
            raise InvalidInput(f"others: the shape is {self._others.shape}; ({len(known)},) is needed")

    @property
    def count(self) -> int:
        """Of the numbers of an action."""
        return self._count

    def configurations(self, actions: npt.ArrayLike) -> Floats:
        """The configurations (..., variables) of actions (..., numbers)."""
        rows = numbers(actions, "actions")
        if rows.shape[-1:] != (self._count,):
            raise InvalidInput(f"actions: the shape is {rows.shape}; (..., {self._count}) is needed")
        result = np.tile(self._others, (*rows.shape[:-1], 1))
        result[..., self._targets] = (self._scale * rows + self._offset)[..., self._columns]
        return result

    def _numbers(self, name: str, values: npt.ArrayLike) -> Floats:
        array = np.array(numbers(values, name))
        if array.shape not in ((), (self._count,)) or not np.isfinite(array).all():
            raise InvalidInput(f"{name}: one finite number, or {self._count} of them, are needed")
        return np.broadcast_to(array, (self._count,))


class _GateStep:
    """What both steps share."""

    def __init__(self, gate: PolicyGate | None = None, joints: JointMap | None = None):
        if not isinstance(gate, PolicyGate):
            raise InvalidInput(
                f"gate: {with_article(gate)} is not a chasles.policy.PolicyGate; a pipeline that is loaded takes gate and "
                f'joints by overrides={{"{self._registry_name}": {{"gate": gate, "joints": joints}}}}'  # type: ignore[attr-defined]
            )
        if not isinstance(joints, JointMap):
            raise InvalidInput(f"joints: {with_article(joints)} is not a chasles.lerobot.JointMap")
        if len(joints.configurations(np.zeros(joints.count))) != len(gate.robot.variables):
            raise InvalidInput("joints: is the map of another robot than the gate's")
        if gate.mode == "scale" and not gate.is_straight:
            raise InvalidInput(
                'gate: the mode "scale" with another interpolation than "straight" says when actions are due, and the '
                "pipeline has a fixed period: it would need actions between actions, which make another path"
            )
        self.gate, self.joints = gate, joints
        self.decision: GateDecision | None = None  #: of the last call
        self._stopped: Floats | None = None

    def get_config(self) -> dict[str, Any]:
        """Nothing: a gate cannot be written to a file."""
        return {}

    def transform_features(self, features: Any) -> Any:
        """Features stay as they are."""
        return features

    def reset(self) -> None:
        """Forgets where the robot was told to stop."""
        self._stopped = None

    def _gated(self, present: Floats, actions: Floats) -> Floats:
        """As many actions as were given, (n, numbers): what passes, then where the robot stops."""
        if not np.isfinite(present).all():
            raise InvalidInput(
                f"present: {present.tolist()}: has values that are no numbers, so the robot could not be told to stop"
            )
        configurations = self.joints.configurations(np.vstack([present, actions]))
        decision = self.decision = self.gate(configurations[0], configurations[1:])
        self._tell(decision)
        passed = decision.at_period(present, actions)[: len(actions)]
        stop = passed[-1] if len(passed) else self._stop(present)
        self._stopped = None if len(passed) else stop
        return np.vstack([passed, np.tile(stop, (len(actions) - len(passed), 1))])

    def _stop(self, present: Floats) -> Floats:
        """Where a robot that was stopped already is told to stay, if it may go there: it would follow its own sag down."""
        if self._stopped is None:
            return present
        there = self.joints.configurations(np.vstack([present, self._stopped]))
        return present if self.gate(there[0], there[1:]).verdict == "refused" else self._stopped

    def _tell(self, decision: GateDecision) -> None:
        """Puts the record where later steps, and hooks, find it."""
        transition = self.transition  # type: ignore[attr-defined]
        transition[TransitionKey.INFO] = {**(transition.get(TransitionKey.INFO) or {}), "chasles_gate": decision.record()}


class ChunkGateStep(_GateStep, PolicyActionProcessorStep):
    """Chunks of a policy pass a gate, in the units of the robot: the last step of a postprocessor.

    Takes tensors (1, n, numbers), as of `predict_action_chunk`, and (1, numbers) or (numbers,), a chunk of one action. Each
    chunk is the way from the present state on. A pipeline that hands over the later actions of a chunk one at a time, as the
    policy server of LeRobot does, needs `ActionGateStep` at the robot instead.

    Parameters
    ----------
    gate : PolicyGate
    joints : JointMap
    present : function
        Returns the state of the robot now, (numbers,), in the units of the actions: a postprocessor does not know it.

    Raises
    ------
    InvalidInput
        For other types, and for a gate that cannot work at a fixed period. In a call: for tensors of other shapes, a batch of
        several robots, and a state that has no numbers.
    """

    def __init__(
        self,
        gate: PolicyGate | None = None,
        joints: JointMap | None = None,
        present: Callable[[], npt.ArrayLike] | None = None,
    ):
        super().__init__(gate, joints)
        if not callable(present):
            raise InvalidInput("present: a function is needed that returns the state of the robot, in the units of the actions")
        self.present = present

    def action(self, action: torch.Tensor) -> torch.Tensor:
        """The actions that pass, and then the one at which the robot stops, in the same shape."""
        shape = tuple(action.shape)
        if not 1 <= len(shape) <= 3 or shape[-1] != self.joints.count or 0 in shape:
            raise InvalidInput(
                f"action: the shape is {shape}; (1, n, {self.joints.count}) or (1, {self.joints.count}) is needed"
            )
        if len(shape) > 1 and shape[0] != 1:
            raise InvalidInput(f"action: a batch of {shape[0]} robots; a gate is about one: give each robot a step of its own")
        present = numbers(self.present(), "present")
        if present.shape != (self.joints.count,):
            raise InvalidInput(f"present: the shape is {present.shape}; ({self.joints.count},) is needed")
        rows = action.detach().to("cpu", torch.float64).numpy().reshape(-1, self.joints.count)
        return torch.from_numpy(self._gated(present, rows)).reshape(shape).to(action)


class ActionGateStep(_GateStep, RobotActionProcessorStep):
    """Single actions pass a gate, on the way from the observed state: the last step before the robot.

    Parameters
    ----------
    gate : PolicyGate
    joints : JointMap
    keys : sequence of str
        Of the numbers of an action, in the order of `joints`, as in ``"elbow.pos"``. The observation has them, too.

    Raises
    ------
    InvalidInput
        For other types, and for a gate that cannot work at a fixed period. In a call: for actions with other keys, and
        without an observation that has them.
    """

    def __init__(self, gate: PolicyGate | None = None, joints: JointMap | None = None, keys: Sequence[str] = ()):
        super().__init__(gate, joints)
        if isinstance(keys, str) or len(keys) != self.joints.count or len(set(keys)) != len(keys):
            raise InvalidInput(
                f"keys: {keys!r}: {self.joints.count} different names are needed, one for each number of the joints"
            )
        self.keys = list(keys)

    def action(self, action: dict[str, Any]) -> dict[str, Any]:
        """The action, or where the robot stops."""
        for key in action:
            if key not in self.keys:
                raise InvalidInput(
                    f"action: {key}: is none of the keys; name it, with None among the variables if it moves nothing"
                )
        present = self._row("observation", self.transition.get(TransitionKey.OBSERVATION))
        asked = self._row("action", action)
        given = self._gated(present, asked[None])[0]
        return action if np.array_equal(given, asked) else dict(zip(self.keys, given.tolist(), strict=True))

    def _row(self, what: str, values: Mapping[str, Any] | None) -> Floats:
        missing = [key for key in self.keys if key not in (values or {})]
        if values is None or missing:
            raise InvalidInput(f"{what}: has no {', '.join(missing)}; the gate needs the state of the robot and its action")
        row = [numbers(values[key], f"{what}: {key}") for key in self.keys]
        for key, number in zip(self.keys, row, strict=True):
            if number.size != 1:
                raise InvalidInput(f"{what}: {key}: the shape is {number.shape}; one number is needed")
        return np.array([number.item() for number in row])


for _step, _name in ((ChunkGateStep, "chasles_chunk_gate"), (ActionGateStep, "chasles_action_gate")):
    ProcessorStepRegistry.register(_name)(_step)  # no decorators: the site's mock of one would take the place of the class
