"""Parts and joints of build123d, for `chasles.cad`."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ._core import InvalidInput
from .cad_assembly import Assembly
from .cad_bounds import Array
from .cad_joints import WORLD, turn
from .cad_tree import Node, matrix_of, split, walk, without_place

_SAME = 1e-7  # of the size: poses of build123d and of the axes found here agree to rounding, others are off by far more


def is_its(thing: Any) -> bool:
    """Whether it is a shape or a builder of build123d."""
    return any(type_.__module__.startswith("build123d.") for type_ in type(thing).__mro__)


def tree_of(thing: Any) -> Node:
    """The tree of a part, of a compound with children, or of a builder of a part."""
    thing = getattr(thing, "part", None) or thing
    if _is_empty(thing):
        name = getattr(thing, "label", "") or type(thing).__name__
        raise InvalidInput(f"{name}: has no shape; an assembly is a Compound(children=[...]) of at least one part")
    colour = getattr(thing, "color", None)
    red, green, blue = tuple(colour)[:3] if colour is not None else (0, 0, 0)
    node = Node(thing.label, matrix_of(thing.location.wrapped), (red, green, blue) if colour is not None else None, source=thing)
    node.children = [tree_of(child) for child in thing.children]
    if not node.children:
        node.shape = without_place(thing.wrapped)
        node.name = node.name or type(thing).__name__
        split(node)
    return node


def _is_empty(thing: Any) -> bool:
    try:
        return getattr(thing, "wrapped", None) is None
    except AssertionError:  # what build123d says of a Compound without children
        return True


def add_joints(assembly: Assembly, root: Node) -> None:
    """The joints that connect parts of a tree, where they are now."""
    places = {id(root.source): (WORLD, root.place)} | {id(node.source): (path, place) for path, node, place in walk(root)}
    sources = [root.source, *(node.source for _, node, _ in walk(root))]
    for source in dict((id(source), source) for source in sources).values():
        for joint in getattr(source, "joints", {}).values():  # curves have none, nor have solids of a part
            if joint.connected_to is not None:
                _add(assembly, joint, places)


def _add(assembly: Assembly, joint: Any, places: dict[int, tuple[str, Array]]) -> None:
    name, other = f"{joint.parent.label or 'part'}.{joint.label}", joint.connected_to
    for end in (joint.parent, other.parent):
        if id(end) not in places:
            raise InvalidInput(f"joint {name!r}: {end.label or 'its part'!r} is no part of the assembly: add it to its children")
    (parent, above), (child, below) = places[id(joint.parent)], places[id(other.parent)]
    freedoms = _freedoms(joint, other)
    size = 1 + float(np.abs(below[:3, 3] - above[:3, 3]).max())
    moves = _moves(joint, other, freedoms, size, name)
    values = _values(
        moves, _relative(joint, other, freedoms, [f.lower_in_range for f in freedoms]), np.linalg.inv(above) @ below, size, name
    )
    if not moves:
        assembly.add_joint(name, "fixed", parent, child)
    carrier = above
    for number, (move, value) in enumerate(zip(moves, values, strict=True)):
        names = [f"{name} {number}" if number else parent, f"{name} {number + 1}" if number + 1 < len(moves) else child]
        assembly.add_joint(
            name if len(moves) == 1 else f"{name}.{move.freedom.label}",
            move.freedom.type,
            *names,
            point=carrier[:3, :3] @ move.point + carrier[:3, 3],
            axis=carrier[:3, :3] @ move.axis,
            lower=move.freedom.lower,
            upper=move.freedom.upper,
            value=value,
        )
        carrier = carrier @ move.matrix(value)


@dataclasses.dataclass
class _Freedom:
    """One number of a joint, in radians or mm."""

    label: str
    type: str
    lower: float
    upper: float

    @property
    def lower_in_range(self) -> float:
        return self.lower if np.isfinite(self.lower) else min(self.upper, 0.0)

    @property
    def step(self) -> float:
        """Far enough to see the axis, and less than half a turn."""
        return 1.0 if self.type == "revolute" else min(10.0, self.upper - self.lower)


def _freedoms(joint: Any, other: Any) -> list[_Freedom]:
    kinds = [type(end).__name__ for end in (joint, other)]
    kind = next((kind for kind in kinds if kind != "RigidJoint"), "RigidJoint")
    moving = joint if type(joint).__name__ == kind else other
    if kind == "RigidJoint":
        return []
    if kind == "BallJoint":
        found = [_angle(label, ends) for label, ends in zip("xyz", moving.angular_range, strict=True)]
    elif kind == "RevoluteJoint":
        found = [_angle("angle", moving.angular_range)]
    elif kind in ("LinearJoint", "CylindricalJoint"):
        found = [_Freedom("position", "prismatic", *map(float, moving.linear_range))]
        turning = moving if kind == "CylindricalJoint" else other if kinds[1] == "RevoluteJoint" else None
        found += [] if turning is None else [_angle("angle", turning.angular_range)]
    else:
        raise InvalidInput(f"joint {joint.label!r}: {kind} is no joint that is known; add it by add_joint")
    return found


def _angle(label: str, ends: Sequence[float]) -> _Freedom:
    return _Freedom(label, "revolute", *map(float, np.radians(ends)))


def _relative(joint: Any, other: Any, freedoms: list[_Freedom], values: Sequence[float]) -> Array:
    """The pose of the child in its parent, by build123d. It notes values in the joints, which get their own back."""
    given = {f.label: float(np.degrees(v)) if f.type == "revolute" else float(v) for f, v in zip(freedoms, values, strict=True)}
    options = {"angles": tuple(given.values())} if set(given) == {"x", "y", "z"} else given
    before = [(end, dict(vars(end))) for end in (joint, other)]
    endless = (-np.inf, np.inf)
    try:
        for end, names in before:
            ranges = {"linear_range": endless, "angular_range": (endless,) * 3 if type(end).__name__ == "BallJoint" else endless}
            vars(end).update({name: ends for name, ends in ranges.items() if name in names})
        return matrix_of(joint.relative_to(other, **options).wrapped)
    finally:
        for end, names in before:
            vars(end).clear()
            vars(end).update(names)


@dataclasses.dataclass
class _Move:
    """A freedom about or along an axis in the frame of the parent, where all freedoms are at their lower ends."""

    freedom: _Freedom
    point: Array
    axis: Array

    def matrix(self, value: float) -> Array:
        result, way = np.eye(4), value - self.freedom.lower_in_range
        if self.freedom.type == "prismatic":
            result[:3, 3] = way * self.axis
        else:
            result[:3, :3] = turn(self.axis, way)
            result[:3, 3] = self.point - result[:3, :3] @ self.point
        return result


def _moves(joint: Any, other: Any, freedoms: list[_Freedom], size: float, name: str) -> list[_Move]:
    """The axes, from poses of build123d; in the order that gives its poses at other values, too."""
    lower = [freedom.lower_in_range for freedom in freedoms]
    base = _relative(joint, other, freedoms, lower)
    found = []
    for number, freedom in enumerate(freedoms):
        stepped = [*lower]
        stepped[number] += freedom.step
        way = _relative(joint, other, freedoms, stepped) @ np.linalg.inv(base)
        found.append(_Move(freedom, *_axis(way, freedom)))
    for order in itertools.permutations(found):
        if _gives_the_same(order, lambda values: _relative(joint, other, freedoms, values), freedoms, base, size):
            return list(order)
    raise InvalidInput(f"joint {name!r}: its parts do not move about axes that stay; add it by add_joint")


def _axis(way: Array, freedom: _Freedom) -> tuple[Array, Array]:
    """The point and the direction of a step."""
    if freedom.type == "prismatic":
        return np.zeros(3), way[:3, 3] / freedom.step
    r = way[:3, :3]
    axis = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / (2 * np.sin(freedom.step))
    point: Array = np.asarray(np.linalg.lstsq(np.eye(3) - r, way[:3, 3], rcond=1e-9)[0], np.float64)
    return point, axis / max(float(np.linalg.norm(axis)), 1e-300)


def _gives_the_same(
    order: Sequence[_Move], pose: Callable[[list[float]], Array], freedoms: list[_Freedom], base: Array, size: float
) -> bool:
    for shares in ((0.3, 0.7, 0.9), (0.8, 0.2, 0.5), (0.6, 1.0, 0.1)):
        values = [
            f.lower_in_range + share * (2.5 if f.type == "revolute" else f.step)
            for f, share in zip(freedoms, shares, strict=False)
        ]
        by_freedom = {id(freedom): value for freedom, value in zip(freedoms, values, strict=True)}
        if np.abs(_chain(order, [by_freedom[id(move.freedom)] for move in order], base) - pose(values)).max() > _SAME * size:
            return False
    return True


def _chain(moves: Sequence[_Move], values: Sequence[float] | Array, base: Array) -> Array:
    for move, value in zip(reversed(moves), reversed(values), strict=True):
        base = move.matrix(value) @ base
    return base


def _values(moves: list[_Move], base: Array, now: Array, size: float, name: str) -> list[float]:
    """The values at which the chain is where the parts are, by Newton's method from several starts."""
    starts = itertools.product(*[(0.3, 2.0, 3.5, 5.0) if move.freedom.type == "revolute" else (0.0,) for move in moves])
    for start in starts:
        values = np.array(start, float) + [move.freedom.lower_in_range for move in moves]
        for _ in range(20 if moves else 0):
            off = (_chain(moves, values, base) - now)[:3].ravel()
            steps = [(_chain(moves, values + 1e-6 * unit, base) - now)[:3].ravel() for unit in np.eye(len(moves))]
            values = values - np.linalg.lstsq((np.array(steps) - off).T / 1e-6, off, rcond=1e-9)[0]
        if np.abs(_chain(moves, values, base) - now).max() <= _SAME * size:
            return [_within(move.freedom, value, name) for move, value in zip(moves, values, strict=True)]
    raise InvalidInput(f"joint {name!r}: its parts are not where it connects them; connect them again")


def _within(freedom: _Freedom, value: float, name: str) -> float:
    """The value within its limits; whole turns are taken off."""
    if freedom.type == "revolute":
        value = freedom.lower_in_range + (value - freedom.lower_in_range + 1e-9) % (2 * np.pi) - 1e-9
    slack = 1e-7 * (1 + abs(value))
    if not freedom.lower - slack <= value <= freedom.upper + slack:
        raise InvalidInput(f"joint {name!r}: {freedom.label}: is {value:g}, outside of {freedom.lower:g} to {freedom.upper:g}")
    value = float(np.clip(value, freedom.lower, freedom.upper))
    nearest = round(value, 9)  # what was typed, rather than it with the rounding of Newton's method
    return nearest if abs(value - nearest) < 1e-10 and freedom.lower <= nearest <= freedom.upper else value
