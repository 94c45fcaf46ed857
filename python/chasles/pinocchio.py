"""Pinocchio's models as robots: a `pin.Model` with its `pin.GeometryModel`, without a second file.

This module requires the package `pin`, and is imported by its name: ``import chasles.pinocchio``.

    robot = chasles.pinocchio.robot(model, geometry_model)
    found = robot.first_contact(*chasles.pinocchio.configurations(model, [q0, q1]))

The guide is docs/pinocchio.md. The choices are in docs/decisions/0119-ros-drake-pinocchio.md.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import coal
import numpy as np
import numpy.typing as npt
import pinocchio as pin

from ._core import InvalidInput, Polyhedron, Robot, capsule, sphere
from .articles import with_article
from .primitive_shapes import Array, Mesh, box, cone, ellipsoid, prism, slab
from .robot_tree import Step, Tree, X, Y, Z, finite_limits, screw, slide, turn

__all__ = ["configurations", "robot"]

_AXES = {"X": X, "Y": Y, "Z": Z}


def robot(
    model: pin.Model,
    geometry_model: pin.GeometryModel,
    *,
    deviation: float = 0.005,
    plane_size: float = 100.0,
    leave_out: Collection[str] = (),
) -> Robot:
    """The robot of a model of Pinocchio, and the collision pairs of its geometry model.

    Each joint of the model moves a link of its name, and the root link is "universe". Each geometry object that is in a
    collision pair is a link of its own name that is fixed to the link of its joint. `configurations` makes configurations of
    Pinocchio's `q`.

    Parameters
    ----------
    model : pinocchio.Model
    geometry_model : pinocchio.GeometryModel
        With the collision pairs to test, and with `coal` geometries.
    deviation : float
        Cylinders, cones and ellipsoids are polyhedra around them that leave them by at most this part of their largest radius.
    plane_size : float
        A half-space is a slab, and a plane a square, that reaches so far to each side of its middle; length unit. What is farther
        away is not tested.
    leave_out : collection of str
        Geometry objects that are not looked at.

    Raises
    ------
    InvalidInput
        With its name, for a joint or a geometry that has no counterpart, and for a geometry model without collision pairs.
    TypeError
        For what is no model of Pinocchio.
    """
    tree = _tree_of(model)
    if not isinstance(geometry_model, pin.GeometryModel):
        raise TypeError(f"geometry_model: {with_article(geometry_model)} is not a pinocchio.GeometryModel")
    if not 1e-6 <= deviation <= 1:
        raise InvalidInput(f"deviation: must be in [1e-6, 1], not {deviation}")
    if not 0 < plane_size < float("inf"):
        raise InvalidInput(f"plane_size: must be above 0 and finite, not {plane_size}")
    objects = list(geometry_model.geometryObjects)
    for item in objects:
        if item.parentJoint >= model.njoints:
            raise InvalidInput(
                f"geometry {item.name!r}: joint {item.parentJoint} is not in the model, which has {model.njoints}"
            )
    pairs = _pairs_of(geometry_model, objects, leave_out)
    taken = set(model.names)
    names = [f"{o.name} (geometry)" if o.name in taken else o.name for o in objects]
    for number in sorted({number for pair in pairs for number in pair}):
        item = objects[number]
        try:
            body, off = _body_of(item.geometry, deviation, plane_size)
        except InvalidInput as error:
            raise InvalidInput(f"geometry {item.name!r}: {error}; leave_out leaves it out") from None
        tree.add_geometry(names[number], model.names[item.parentJoint], body, item.placement.homogeneous, off)
    tree.disable_all_but({frozenset((names[a], names[b])) for a, b in pairs}, "no collision pair")
    return tree.robot(model.name)


def configurations(model: pin.Model, q: npt.ArrayLike) -> Array:
    """The configurations of the robot of a model for configurations of Pinocchio.

    Parameters
    ----------
    model : pinocchio.Model
    q : array (model.nq,) or (n, model.nq)
        Cosines and sines of unbounded joints may have any common length above 0, as quaternions.

    Returns
    -------
    array (variables,) or (n, variables)
        In the order of `robot(model, geometry_model).variables`. The angle of an unbounded joint is in [-pi, pi].

    Raises
    ------
    InvalidInput
        For a wrong shape, cosines and sines that are both 0 or infinite, and quaternions that are 0.
    """
    return _tree_of(model).values_of(q, model.nq)


def _tree_of(model: pin.Model) -> Tree:
    if not isinstance(model, pin.Model):
        raise TypeError(f"model: {with_article(model)} is not a pinocchio.Model")
    tree = Tree(model.names[0])
    for joint in range(1, model.njoints):
        name, parent = model.names[joint], model.names[model.parents[joint]]
        try:
            steps = (
                _mimic(model, joint) if _kind(model.joints[joint]) == "Mimic" else _steps(model, model.joints[joint])
            )
        except InvalidInput as error:
            raise InvalidInput(f"joint {name!r}: {error}") from None
        tree.add_chain(name, (parent, name), steps, model.jointPlacements[joint].homogeneous)
    return tree


def _kind(joint: Any) -> str:
    return str(joint.shortname()).removeprefix("JointModel")


def _steps(model: pin.Model, joint: Any) -> list[Step]:
    kind, q = _kind(joint), joint.idx_q
    limits = finite_limits(model.lowerPositionLimit[q], model.upperPositionLimit[q]) if joint.nq == 1 else {}
    own = joint.extract() if hasattr(joint, "extract") else joint
    axis = _AXES.get(kind[-1])
    if axis and kind in ("RX", "RY", "RZ"):
        return [turn("turn", axis, q, **limits)]
    if axis and kind in ("PX", "PY", "PZ"):
        return [slide("slide", axis, q, **limits)]
    if axis and kind in ("HX", "HY", "HZ"):
        return screw(axis, own.pitch, q, **limits)
    if axis and kind.startswith("RUB"):
        return [Step("turn", "continuous", [(q, q + 1)], axis)]
    return _other_steps(model, kind, own, limits)


def _other_steps(model: pin.Model, kind: str, joint: Any, limits: dict[str, float]) -> list[Step]:
    q = joint.idx_q
    if kind == "RevoluteUnaligned":
        return [turn("turn", joint.axis, q, **limits)]
    if kind == "RevoluteUnboundedUnaligned":
        return [Step("turn", "continuous", [(q, q + 1)], _motion_at(model, joint, joint, 1.0).angular)]
    if kind == "PrismaticUnaligned":
        return [slide("slide", joint.axis, q, **limits)]
    if kind == "HelicalUnaligned":
        return screw(joint.axis, joint.pitch, q, **limits)
    if kind == "FreeFlyer":
        return [Step("free", "floating", range(q, q + 7))]
    if kind == "Spherical":  # a floating joint that stays at its place
        return [Step("ball", "floating", [None, None, None, *range(q, q + 4)])]
    if kind == "Planar":
        return [Step("plane", "planar", [q, q + 1, (q + 2, q + 3)], Z)]
    if kind == "SphericalZYX":
        return [turn("z", Z, q), turn("y", Y, q + 1), turn("x", X, q + 2)]
    if kind == "Translation":
        return [slide("x", X, q), slide("y", Y, q + 1), slide("z", Z, q + 2)]
    if kind == "Universal":
        return [turn("1", joint.axis1, q), turn("2", joint.axis2, q + 1)]
    if kind == "Composite":
        return _composite(model, joint)
    raise InvalidInput(f"a joint of the type {kind} has no counterpart; pinocchio.buildReducedModel can lock it")


def _composite(model: pin.Model, joint: Any) -> list[Step]:
    result: list[Step] = []
    for number, (part, placement) in enumerate(zip(joint.joints, joint.jointPlacements, strict=True), 1):
        steps = _steps(model, part)
        steps[0].options["origin"] = placement.homogeneous
        for step in steps:
            step.suffix = f"{number}/{step.suffix}"
        result += steps
    return result


def _motion_at(model: pin.Model, joint: Any, leader: Any, value: float) -> pin.Motion:
    """The logarithm of the pose of a joint, whose axis cannot be read in Python, at a value of the joint that it follows."""
    q = pin.neutral(model)
    q[leader.idx_q : leader.idx_q + leader.nq] = value if leader.nq == 1 else [np.cos(value), np.sin(value)]
    data = joint.createData()
    joint.calc(data, q)
    return pin.log6(data.M)


def _mimic(model: pin.Model, number: int) -> list[Step]:
    joint = model.joints[number].extract()
    followed = model.mimicked_joints[list(model.mimicking_joints).index(number)]
    leader = model.joints[followed]
    if leader.nq > 2 or joint.scaling == 0:
        raise InvalidInput("a mimic joint needs a leader with one angle or way, and a scaling that is not 0")
    way = _motion_at(model, joint, leader, (1 - joint.offset) / joint.scaling)
    has_turn, has_way = np.abs(way.angular).max() > 1e-9, np.abs(way.linear).max() > 1e-9
    if has_turn and has_way:
        raise InvalidInput("a mimic joint that turns and slides has no counterpart")
    kind, axis = ("revolute", way.angular) if has_turn else ("prismatic", way.linear)
    follows = {"joint": model.names[followed], "multiplier": joint.scaling, "offset": joint.offset}
    return [Step("mimic", kind, [], axis, {"mimic": follows})]


def _pairs_of(
    geometry_model: pin.GeometryModel, objects: list[Any], leave_out: Collection[str]
) -> list[tuple[int, int]]:
    if isinstance(leave_out, str):
        raise InvalidInput(f"leave_out: {leave_out!r} is one text; a collection of names is needed")
    for name in sorted(set(leave_out) - {item.name for item in objects}):
        raise InvalidInput(f"leave_out: {name!r}: there is no such geometry object")
    if not len(geometry_model.collisionPairs):
        raise InvalidInput(
            "geometry_model: has no collision pairs, so nothing would be tested: addAllCollisionPairs adds them"
        )
    is_used = [not item.disableCollision and item.name not in leave_out for item in objects]
    pairs = [(int(pair.first), int(pair.second)) for pair in geometry_model.collisionPairs]
    return [(a, b) for a, b in pairs if is_used[a] and is_used[b]]


def _body_of(shape: Any, deviation: float, plane_size: float) -> tuple[Polyhedron, float]:
    """A body, and by how much it is larger than the shape."""
    body, off = _plain_body_of(shape, deviation, plane_size)
    swept = shape.getSweptSphereRadius() if isinstance(shape, coal.ShapeBase) else 0.0
    return (body.with_radius(body.radius + swept) if swept else body), off


def _plain_body_of(shape: Any, deviation: float, plane_size: float) -> tuple[Polyhedron, float]:
    if isinstance(shape, coal.Sphere):
        return sphere(shape.radius), 0.0
    if isinstance(shape, coal.Capsule):
        return capsule(shape.radius, 2 * shape.halfLength), 0.0
    if isinstance(shape, coal.Box):
        return box(-shape.halfSide, shape.halfSide), 0.0
    if isinstance(shape, coal.Cylinder):
        return Polyhedron(*prism(shape.radius, shape.halfLength, deviation)), deviation * shape.radius
    if isinstance(shape, coal.Cone):
        return Polyhedron(*cone(shape.radius, shape.halfLength, deviation)), deviation * shape.radius
    if isinstance(shape, coal.Ellipsoid):
        return Polyhedron(*ellipsoid(shape.radii, deviation)), deviation * float(shape.radii.max())
    if isinstance(shape, coal.Halfspace):
        return slab(shape.n, shape.d, plane_size), 0.0
    return Polyhedron(*_mesh_of(shape)), 0.0


def _mesh_of(shape: Any) -> Mesh:
    if isinstance(shape, coal.BVHModelBase) and shape.num_tris:
        return np.array(shape.vertices()), [_corners(shape.tri_indices(i)) for i in range(shape.num_tris)]
    if isinstance(shape, coal.Convex):
        return np.array(shape.points()), [_corners(shape.polygons(i)) for i in range(shape.num_polygons)]
    raise InvalidInput(f"{with_article(shape)} has no polyhedron")


def _corners(triangle: Any) -> list[int]:
    return [int(triangle[i]) for i in range(3)]  # it does not end where one iterates over it
