"""Bodies and joints of a MuJoCo model as links and joints of a robot, for `chasles.mujoco`."""

from __future__ import annotations

from typing import Any

import mujoco as mj
import numpy as np
import numpy.typing as npt

from ._core import InvalidInput
from .arrays import numbers

Array = npt.NDArray[np.float64]
_FREE, _BALL, _SLIDE, _HINGE = (
    mj.mjtJoint.mjJNT_FREE,
    mj.mjtJoint.mjJNT_BALL,
    mj.mjtJoint.mjJNT_SLIDE,
    mj.mjtJoint.mjJNT_HINGE,
)
_AT_ORIGIN = (np.zeros(3), np.array([1.0, 0, 0, 0]))


def body_names(model: Any) -> list[str]:
    """The names of all bodies; "body 3" for one without a name."""
    names = [mj.mj_id2name(model, mj.mjtObj.mjOBJ_BODY, body) or f"body {body}" for body in range(model.nbody)]
    return ["world", *names[1:]]


def joints_of(model: Any) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """The links, one for each body in order, then those between joints of one body; and the joints in the order of MuJoCo's."""
    names = body_names(model)
    links, between, joints = [{"name": name} for name in names], [], []
    for body in range(1, model.nbody):
        chain = _chain(model, body, names[body])
        parent = names[model.body_parentid[body]]
        for number, joint in enumerate(chain):
            is_last = number + 1 == len(chain)
            child = names[body] if is_last else f"{names[body]}/joint {number}"
            between += [] if is_last else [{"name": child}]
            joints.append({**joint, "parent": parent, "child": child})
            parent = child
    return links + between, joints


def _chain(model: Any, body: int, name: str) -> list[dict[str, Any]]:
    """The joints from the parent of a body to it. MuJoCo's joints turn about an anchor in the body; a fixed one leads back."""
    if model.body_mocapid[body] >= 0:
        return [{"name": f"mocap {name}", "type": "floating"}]
    place, chain = (model.body_pos[body], model.body_quat[body]), []
    for joint in range(model.body_jntadr[body], model.body_jntadr[body] + model.body_jntnum[body]):
        joint_name = mj.mj_id2name(model, mj.mjtObj.mjOBJ_JOINT, joint) or f"{name} joint {joint}"
        kind, anchor, axis = model.jnt_type[joint], np.array(model.jnt_pos[joint]), np.array(model.jnt_axis[joint])
        if kind == _FREE:
            return [{"name": joint_name, "type": "floating"}]
        described: dict[str, Any] = {"name": joint_name, "type": "floating"}
        if kind != _BALL:
            described |= {"type": "revolute" if kind == _HINGE else "prismatic", "axis": axis, **_limits(model, joint)}
        at_zero = -float(model.qpos0[model.jnt_qposadr[joint]]) if kind != _BALL else 0.0
        if kind == _SLIDE:
            described["origin"], place = _pose(*_moved(place, at_zero * axis)), _AT_ORIGIN
        else:
            position, turn = _moved(place, anchor)
            described["origin"], place = _pose(position, _product(turn, _turn(axis, at_zero))), (-anchor, _AT_ORIGIN[1])
        chain.append(described)
    if not chain or place[0].any():
        chain.append({"name": f"fixed {name}", "type": "fixed", "origin": _pose(*place)})
    return chain


def place_of_geom(model: Any, geom: int) -> list[float]:
    """The pose of a geom in its body. What is within 1e-6 of the body's frame or of the inertial one, MuJoCo places there."""
    body, frame = (
        model.geom_bodyid[geom],
        mj.mjtSameFrame(int(model.geom_sameframe[geom])).name.removeprefix("mjSAMEFRAME_"),
    )
    position, quaternion = model.geom_pos[geom], model.geom_quat[geom]
    if frame.startswith("BODY"):
        quaternion = _AT_ORIGIN[1]
        position = _AT_ORIGIN[0] if frame == "BODY" else position
    elif frame.startswith("INERTIA"):
        quaternion = model.body_iquat[body]
        position = model.body_ipos[body] if frame == "INERTIA" else position
    return _pose(position, quaternion)


def _limits(model: Any, joint: int) -> dict[str, float]:
    lower, upper = (float(end) for end in model.jnt_range[joint])
    return {"lower": lower, "upper": upper} if model.jnt_limited[joint] else {}


def _moved(place: tuple[Any, Any], way: Array) -> tuple[Array, Array]:
    """A place after a shift along its own axes."""
    turned = np.zeros(3)
    mj.mju_rotVecQuat(turned, np.asarray(way, np.float64), np.asarray(place[1], np.float64))
    return np.asarray(place[0]) + turned, np.asarray(place[1])


def _product(first: Array, second: Array) -> Array:
    result = np.zeros(4)
    mj.mju_mulQuat(result, np.asarray(first, np.float64), second)
    return result


def _turn(axis: Array, angle: float) -> Array:
    result = np.zeros(4)
    mj.mju_axisAngle2Quat(result, axis, angle)
    return result


def _pose(position: Any, quaternion: Any) -> list[float]:
    return [*map(float, position), *map(float, quaternion)]


def numbers_of(given: npt.ArrayLike, name: str) -> Array:
    """An array of numbers. Refuses an MjData, whose `qpos` is meant."""
    if type(given).__name__ == "MjData":
        raise InvalidInput(f"{name}: is an MjData; give arrays of its numbers, such as a copy of its qpos for each state")
    return numbers(given, name)


def _rows(given: npt.ArrayLike, name: str, shape: tuple[int, ...]) -> Array:
    array = numbers_of(given, name)
    if array.shape[-len(shape) :] != shape or array.ndim not in (len(shape), len(shape) + 1):
        several = f"(states, {', '.join(map(str, shape))})"
        raise InvalidInput(f"{name}: the shape is {array.shape}; {shape} or {several} is needed")
    return array


def values_of(model: Any, qpos: npt.ArrayLike, mocap: npt.ArrayLike | None) -> Array:
    """The values of all variables, in the order of `joints_of`. A ball is a floating joint that stays at its place."""
    states = _rows(qpos, "qpos", (model.nq,))
    poses = mocap_of(model, mocap)
    if poses.ndim == 3 and (states.ndim != 2 or len(poses) != len(states)):
        raise InvalidInput(f"mocap: has {len(poses)} states, and qpos has the shape {states.shape}")
    columns = [np.zeros((*states.shape[:-1], 0))]
    for body in range(1, model.nbody):
        if model.body_mocapid[body] >= 0:
            pose = np.broadcast_to(poses[..., model.body_mocapid[body], :], (*states.shape[:-1], 7))
            columns.append(pose[..., [0, 1, 2, 4, 5, 6, 3]])
        for joint in range(model.body_jntadr[body], model.body_jntadr[body] + model.body_jntnum[body]):
            columns.append(_values(states[..., model.jnt_qposadr[joint] :], model.jnt_type[joint]))
    return np.concatenate(columns, axis=-1)


def _values(states: Array, kind: int) -> Array:
    """Of a joint whose values come first. Quaternions are w x y z in MuJoCo, and x y z w in a robot."""
    if kind == _FREE:
        return states[..., [0, 1, 2, 4, 5, 6, 3]]
    if kind == _BALL:
        return np.concatenate([np.zeros((*states.shape[:-1], 3)), states[..., [1, 2, 3, 0]]], axis=-1)
    return states[..., :1]


def mocap_of(model: Any, mocap: npt.ArrayLike | None) -> Array:
    """Poses (nmocap, 7) or (states, nmocap, 7): the given ones, or those of the model."""
    if mocap is not None:
        return _rows(mocap, "mocap", (model.nmocap, 7))
    bodies = [int(np.flatnonzero(model.body_mocapid == number)[0]) for number in range(model.nmocap)]
    return np.concatenate([model.body_pos[bodies], model.body_quat[bodies]], axis=1).reshape(-1, 7)


def reach_of(model: Any, qpos: Array, mocap: npt.ArrayLike | None) -> float:
    """No point of a geom is farther from the origin at any time between these states."""
    lengths = np.linalg.norm(model.body_pos, axis=1)
    for joint in range(model.njnt):
        kind, at = model.jnt_type[joint], model.jnt_qposadr[joint]
        lengths[model.jnt_bodyid[joint]] += 2 * np.linalg.norm(model.jnt_pos[joint])
        if kind == _SLIDE:
            lengths[model.jnt_bodyid[joint]] += np.abs(qpos[:, at] - model.qpos0[at]).max()
        if kind == _FREE:
            lengths[model.jnt_bodyid[joint]] = np.linalg.norm(qpos[:, at : at + 3], axis=1).max()
    for number, poses in enumerate(np.moveaxis(mocap_of(model, mocap), -2, 0)):
        lengths[model.body_mocapid == number] = np.linalg.norm(poses[..., :3], axis=-1).max()
    for body in range(1, model.nbody):  # parents come before their children
        lengths[body] += lengths[model.body_parentid[body]]
    of_geoms = np.linalg.norm(model.geom_pos, axis=1) + model.geom_rbound
    return float((lengths[model.geom_bodyid] + of_geoms).max(initial=0.0))
