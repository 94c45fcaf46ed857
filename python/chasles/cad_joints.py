"""What joints of an assembly are, what they follow, and what of them is refused, for `chasles.cad`."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Sequence

import numpy as np

from ._core import InvalidInput
from .cad_bounds import Array

WORLD = "world"
MOVING = ("revolute", "prismatic")
_SAME = 1e-9  # of the value: what a leader's value, a factor and an offset may be off by rounding


@dataclasses.dataclass
class Joint:
    """What moves a part, or an assembly of parts, against another one. All values are those of the mounted assembly's world.

    Attributes
    ----------
    name : str
    type : "revolute", "prismatic" or "fixed"
    parent, child : str
        Paths of parts or assemblies. The parent may be "world".
    point, axis : array (3,)
        The axis goes through the point.
    lower, upper : float
        Limits, radians or mm; infinite without one.
    value : float
        Where the assembly is mounted, radians or mm.
    follows : (str, float, float) or None
        The value is that of another joint, times a factor, plus an offset: gears, parallel cranks.
    """

    name: str
    type: str
    parent: str
    child: str
    point: Array = dataclasses.field(default_factory=lambda: np.zeros(3))
    axis: Array = dataclasses.field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    lower: float = -np.inf
    upper: float = np.inf
    value: float = 0.0
    follows: tuple[str, float, float] | None = None


def require_joint(joint: Joint, joints: Sequence[Joint], paths: Collection[str]) -> None:
    """Raises InvalidInput for a joint that is none beside the others; what it follows may come later."""
    where = f"joint {joint.name!r}"
    if joint.type not in (*MOVING, "fixed"):
        raise InvalidInput(f"{where}: type: must be 'revolute', 'prismatic' or 'fixed', not {joint.type!r}")
    if joint.parent not in {WORLD, *paths, *(other.child for other in joints)}:
        raise InvalidInput(f"{where}: {joint.parent!r} is no part of the assembly; its parts are {', '.join(sorted(paths))}")
    if sum(other.name == joint.name for other in joints) > 1:
        raise InvalidInput(f"{where}: comes twice")
    if sum(other.child == joint.child for other in joints) > 1:
        raise InvalidInput(
            f"{where}: another joint moves {joint.child!r} already; for a turn and a slide of one part, put it in an assembly: one "
            "joint moves 'arm', the other one 'arm/pin'; a closed loop needs `follows`, or a path"
        )
    if joint.point.shape != (3,) or joint.axis.shape != (3,) or not np.isfinite([joint.point, joint.axis]).all():
        raise InvalidInput(f"{where}: point, axis: three finite numbers each are needed")
    if not joint.axis.any():
        raise InvalidInput(f"{where}: axis: is zero")
    if not joint.lower <= joint.upper or not np.isfinite(joint.value):
        raise InvalidInput(f"{where}: lower, upper, value: {joint.lower} to {joint.upper}, at {joint.value}, is no range")
    if joint.follows is not None:
        _require_follows(joint)
    if not joint.lower <= joint.value <= joint.upper:
        raise InvalidInput(f"{where}: value: is mounted at {joint.value}, outside of {joint.lower} to {joint.upper}")


def _require_follows(joint: Joint) -> None:
    follows = joint.follows
    is_one = isinstance(follows, (tuple, list)) and len(follows) == 3 and isinstance(follows[0], str)
    if not is_one or not np.isfinite(np.array(follows[1:], float)).all():  # type: ignore[index]
        raise InvalidInput(f"joint {joint.name!r}: follows: must be the name of a joint, a factor and an offset, not {follows!r}")
    if joint.type not in MOVING:
        raise InvalidInput(f"joint {joint.name!r}: follows: a fixed joint has no value")


def leader_of(joint: Joint, joints: Sequence[Joint]) -> tuple[Joint, float, float]:
    """The joint that a follower follows in the end, with the factor and the offset from its value; without `follows`, itself."""
    by_name = {other.name: other for other in joints}
    factor, offset, way = 1.0, 0.0, [joint.name]
    leader = joint
    while leader.follows is not None:
        name, times, plus = leader.follows
        if name not in by_name:
            raise InvalidInput(f"joint {leader.name!r}: follows {name!r}, which is no joint; the joints are {', '.join(by_name)}")
        if name in way:
            raise InvalidInput(f"joint {leader.name!r}: follows itself: {' -> '.join([*way, name])}")
        offset, factor = offset + factor * plus, factor * times
        leader = by_name[name]
        way.append(name)
    if leader is not joint and leader.type not in MOVING:
        raise InvalidInput(f"joint {joint.name!r}: follows {leader.name!r}, which is fixed and has no value")
    return leader, factor, offset


def limits_of(joint: Joint, joints: Sequence[Joint]) -> tuple[float, float]:
    """The limits of a joint within those of its followers; where it is mounted is within them."""
    lower, upper = joint.lower, joint.upper
    for other in joints:
        if other.follows is None:
            continue
        leader, factor, offset = leader_of(other, joints)
        if leader is joint and factor != 0:
            ends = sorted(((other.lower - offset) / factor, (other.upper - offset) / factor))
            lower, upper = max(lower, ends[0]), min(upper, ends[1])
    return min(lower, joint.value), max(upper, joint.value)


def require_joints(joints: Sequence[Joint], paths: Collection[str]) -> None:
    """Raises InvalidInput unless all joints are ones, and followers are mounted where their leaders put them."""
    known = {WORLD, *paths, *(joint.parent for joint in joints)}
    for joint in joints:
        require_joint(joint, joints, paths)
        if joint.child not in known:
            raise InvalidInput(f"joint {joint.name!r}: {joint.child!r} is no part of the assembly, and carries none")
    for joint in joints:
        if joint.follows is None:
            continue
        leader, factor, offset = leader_of(joint, joints)
        value = factor * leader.value + offset
        if abs(joint.value - value) > _SAME * (1 + abs(value)):
            raise InvalidInput(
                f"joint {joint.name!r}: value: is mounted at {joint.value:.12g}, but follows {leader.name!r}, which is mounted at "
                f"{leader.value:.12g}: its value is {value!r} there; give this value, or another offset"
            )


def turn(axis: Array, angle: float) -> Array:
    """The matrix of a turn about a unit vector (formula of Rodrigues)."""
    cross = np.cross(np.eye(3), axis)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
