"""Bodies and joints of a plant of Drake as links and joints of a robot, for `chasles.drake`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from pydrake.common.eigen_geometry import Quaternion
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant

from ._core import InvalidInput
from .primitive_shapes import Array
from .robot_tree import Step, Tree, X, Y, Z, finite_limits, screw, slide, turn

_PLAIN = ("WorldModelInstance", "DefaultModelInstance")


def name_of_body(plant: MultibodyPlant, body: Any) -> str:
    return _scoped(plant, body.model_instance(), body.name())


def _scoped(plant: MultibodyPlant, instance: Any, name: str) -> str:
    model = plant.GetModelInstanceName(instance)
    return name if model in _PLAIN else f"{model}::{name}"


def tree_of(plant: MultibodyPlant, rest: Array | None) -> Tree:
    """With `rest`, free bodies stand still where they are at these positions."""
    tree = Tree(name_of_body(plant, plant.world_body()))
    moved, no_steps = {tree.links[0]["name"]}, list[Step]()
    for index in plant.GetJointIndices():
        joint: Any = plant.get_joint(index)
        name = _scoped(plant, joint.model_instance(), joint.name())
        ends = name_of_body(plant, joint.parent_body()), name_of_body(plant, joint.child_body())
        if ends[1] in moved:
            raise InvalidInput(
                f"joint {name!r}: {ends[1]!r} is the world or has another joint above it: swap its parent and its child"
            )
        moved.add(ends[1])
        begin = joint.frame_on_parent().GetFixedPoseInBodyFrame()
        end = joint.frame_on_child().GetFixedPoseInBodyFrame().inverse()
        if joint.type_name() == "weld":
            begin, steps = begin @ joint.X_FM(), no_steps
        elif joint.type_name() == "quaternion_floating" and rest is not None:
            begin, steps = begin @ _free_pose(rest[joint.position_start() :]), no_steps
        else:
            steps = _steps(plant, joint, name)
        tree.add_chain(name, ends, steps, begin.GetAsMatrix4(), end.GetAsMatrix4())
    if plant.num_constraints():
        tree.warnings.append(
            f"{plant.num_constraints()} constraints of the plant are not read: give positions that obey them"
        )
    return tree


def _free_pose(q: Array) -> RigidTransform:
    return RigidTransform(Quaternion(q[:4] / np.linalg.norm(q[:4])), q[4:7])


def _steps(plant: MultibodyPlant, joint: Any, name: str) -> list[Step]:
    kind, q = joint.type_name(), joint.position_start()
    ends = zip(joint.position_lower_limits(), joint.position_upper_limits(), strict=True)
    limits = [finite_limits(lower, upper) for lower, upper in ends]
    if kind == "revolute":
        return [turn("turn", joint.revolute_axis(), q, **limits[0])]
    if kind == "prismatic":
        return [slide("slide", joint.translation_axis(), q, **limits[0])]
    if kind == "screw":
        return screw(_screw_axis(plant, joint), joint.screw_pitch() / (2 * math.pi), q, **limits[0])
    if kind == "universal":
        return [turn("qx", X, q, **limits[0]), turn("qy", Y, q + 1, **limits[1])]
    if kind == "planar":
        return [Step("plane", "planar", range(q, q + 3), Z)]
    if kind == "quaternion_floating":  # w x y z, then the place
        return [Step("free", "floating", [q + 4, q + 5, q + 6, q + 1, q + 2, q + 3, q])]
    if kind in ("ball_rpy", "rpy_floating"):  # roll, pitch and yaw come first, and yaw turns first
        turns = [turn(f"q{'xyz'[i]}", (X, Y, Z)[i], q + i, **limits[i]) for i in (2, 1, 0)]
        ways = [slide("xyz"[i], (X, Y, Z)[i], q + 3 + i, **limits[3 + i]) for i in range(joint.num_positions() - 3)]
        return ways + turns
    raise InvalidInput(f"joint {name!r}: a joint of the type {kind} has no counterpart")


def _screw_axis(plant: MultibodyPlant, joint: Any) -> Array:
    """Python cannot read it, so it is that of the pose at one radian."""
    context = plant.CreateDefaultContext()
    q = plant.GetPositions(context)
    q[joint.position_start()] = 1
    plant.SetPositions(context, q)
    pose = joint.frame_on_child().CalcPose(context, joint.frame_on_parent())
    return np.asarray(pose.rotation().ToAngleAxis().axis(), np.float64)
