"""A tree of links and joints that grows joint by joint, for the adapters of Drake and Pinocchio.

A joint of a platform is a chain of steps between two links. A step is a joint of a robot, and has the columns of the
platform's configuration that its variables are read from.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, Polyhedron, Robot
from .arrays import Array, numbers

#: The value of a variable: a number of the configuration; the angle of its cosine and sine; or 0.
Column = int | tuple[int, int] | None
X, Y, Z = np.eye(3).tolist()


@dataclass
class Step:
    """A joint of a robot between two links of a chain."""

    suffix: str  #: of its name, where a chain has several steps
    type: str
    columns: Sequence[Column]
    axis: Any = (1.0, 0.0, 0.0)  #: three numbers
    options: dict[str, Any] = field(default_factory=dict)  #: origin, lower, upper, mimic: as for Robot
    follows: float | None = None  #: the multiplier of a step that follows the one before


def turn(suffix: str, axis: Any, column: Column, **options: Any) -> Step:
    return Step(suffix, "revolute", [column], axis, options)


def slide(suffix: str, axis: Any, column: Column, **options: Any) -> Step:
    return Step(suffix, "prismatic", [column], axis, options)


def screw(axis: Any, pitch: float, column: Column, **options: Any) -> list[Step]:
    """A turn, and a slide by `pitch` per radian that follows it."""
    return [turn("turn", axis, column, **options), Step("slide", "prismatic", [], axis, follows=pitch)]


class Tree:
    """Links, joints and geometries of a robot, by their names."""

    def __init__(self, root: str):
        self.links: list[dict[str, Any]] = [{"name": root}]
        self.joints: list[dict[str, Any]] = []
        self.columns: list[Column] = []
        self.geometries: list[str] = []
        self.disabled: list[tuple[str, str, str]] = []
        self.warnings: list[str] = []

    def add_chain(
        self, name: str, ends: tuple[str, str], steps: Sequence[Step], begin: Array, end: Array | None = None
    ) -> None:
        """A joint from a parent link to a new child link.

        `begin` is the pose of its frame in the parent, and `end` that of the child in the frame that has moved; (4, 4).
        """
        parent, child = ends
        steps = list(steps)
        if not steps or (end is not None and not np.array_equal(end, np.eye(4))):
            steps.append(Step("end", "fixed", [], options={"origin": end} if end is not None else {}))
        for number, step in enumerate(steps):
            is_last = number + 1 == len(steps)
            link = child if is_last else f"{child}/{step.suffix}"
            origin = step.options.get("origin", np.eye(4))
            joint = {"name": self.name_of(name, steps, number), "type": step.type, "axis": step.axis, **step.options}
            joint |= {"parent": parent, "child": link, "origin": begin @ origin if number == 0 else origin}
            if step.follows is not None:
                joint["mimic"] = {"joint": self.joints[-1]["name"], "multiplier": step.follows}
            self.links.append({"name": link})
            self.joints.append(joint)
            self.columns += step.columns
            parent = link

    @staticmethod
    def name_of(name: str, steps: Sequence[Step], number: int) -> str:
        """The only step that moves has the name of the whole joint."""
        moving = [step for step in steps if step.columns]
        is_alone = len(moving) == 1 and steps[number] is moving[0]
        return name if is_alone or len(steps) == 1 else f"{name}/{steps[number].suffix}"

    def add_geometry(self, name: str, link: str, body: Polyhedron, pose: Array, deviation: float) -> None:
        self.geometries.append(name)
        self.links.append({"name": name, "collisions": [{"shape": body, "deviation": deviation}]})
        self.joints.append({"name": f"geometry {name}", "type": "fixed", "parent": link, "child": name, "origin": pose})

    def disable_all_but(self, tested: Collection[frozenset[str]], reason: str) -> None:
        """Pairs of geometries are tested if the platform tests them."""
        for pair in itertools.combinations(self.geometries, 2):
            if frozenset(pair) not in tested:
                self.disabled.append((*pair, reason))

    def robot(self, name: str) -> Robot:
        return Robot(
            name=name, links=self.links, joints=self.joints, disabled_pairs=self.disabled, warnings=self.warnings
        )

    def variables(self) -> list[str]:
        """The names that the robot gives its variables."""
        parts = {
            "planar": ("/x", "/y", "/theta"),
            "floating": ("/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z", "/rot_w"),
        }
        moving = [joint for joint in self.joints if joint["type"] != "fixed" and "mimic" not in joint]
        return [joint["name"] + part for joint in moving for part in parts.get(joint["type"], ("",))]

    def values_of(self, configurations: npt.ArrayLike, size: int) -> Array:
        """Configurations (size,) or (n, size) of the platform as those of the robot."""
        q = numbers(configurations, "q")
        if q.ndim not in (1, 2) or q.shape[-1] != size:
            raise InvalidInput(f"q: the shape is {q.shape}; ({size},) or (n, {size}) is needed")
        result = np.zeros((*q.shape[:-1], len(self.columns)))
        names = self.variables()
        for number, column in enumerate(self.columns):
            if isinstance(column, tuple):
                _refuse_no_angle(q[..., list(column)], names[number])
                result[..., number] = np.arctan2(q[..., column[1]], q[..., column[0]])
            elif column is not None:
                result[..., number] = q[..., column]
        for number in (i for i, name in enumerate(names) if name.endswith("/rot_x")):
            _refuse(~result[..., number : number + 4].any(axis=-1), names[number], "the quaternion is zero")
        return result


def _refuse_no_angle(pairs: Array, name: str) -> None:
    """Of cosine and sine. What is NaN has the angle NaN, which every question refuses by name, or marks."""
    _refuse(~pairs.any(axis=-1), name, "the cosine and the sine are both 0, which is no angle")
    _refuse(np.isinf(pairs).any(axis=-1), name, "the cosine or the sine is not finite")


def _refuse(is_bad: Any, name: str, why: str) -> None:
    """With the number of the first configuration."""
    if np.any(is_bad):
        place = f"configuration {int(np.argmax(is_bad))}: " if np.ndim(is_bad) else ""
        raise InvalidInput(f"q: {place}{name}: {why}")


def finite_limits(lower: float, upper: float) -> dict[str, float]:
    """Of a joint; a platform writes infinity, or the largest number, for a joint without limits."""
    largest = 1e300
    ends = {"lower": float(lower), "upper": float(upper)}
    return {name: end for name, end in ends.items() if abs(end) < largest}
