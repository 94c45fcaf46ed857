"""The page of an audit of MuJoCo's states, for `chasles.mujoco`."""

from __future__ import annotations

import os
import pathlib
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import JointPath, Polyhedron, Robot
from .poses import seven_numbers
from .record import recording_page

Array = npt.NDArray[np.float64]
PARTS_OF_CONTACT = 16  # poses of a step with a contact


def write_page(
    robot: Robot,
    configurations: Array,
    times: Array,
    table: np.ndarray,
    planes: dict[str, Array],
    out: str | os.PathLike[str],
    title: str,
) -> pathlib.Path:
    """See `Audit.view`."""
    shapes = {}
    for name in robot.links:
        for shape, _, _ in robot.collisions(name):
            shapes[name] = _thin(shape, planes[name]) if name in planes else shape
    numbers = _numbers_of_poses(robot, configurations, table, times)
    path = JointPath.straight(robot, configurations)
    poses = np.array(
        [[seven_numbers(found[name]) for name in shapes] for found in (robot.link_poses(path.at(at)) for at in numbers)]
    )
    stamps = np.interp(numbers, np.arange(len(times)), times)
    return recording_page(out, shapes, stamps, poses, [_event(row, stamps) for row in table], title=title)


def _numbers_of_poses(robot: Robot, configurations: Array, table: np.ndarray, times: Array) -> Array:
    """Numbers of states, with fractions: bodies turn by less than a quarter turn between two, and contacts are seen as they happen."""
    weights = [{"trans": 0, "rot": 2}.get(name.rpartition("/")[2].split("_")[0], 1) for name in robot.variables]
    turned = np.abs(np.diff(configurations, axis=0)) @ np.array(weights, np.float64)
    parts = np.clip(np.ceil(turned), 1, 64).astype(np.int64)
    parts[table["step"]] = np.maximum(parts[table["step"]], PARTS_OF_CONTACT)
    evenly = [number + np.arange(count) / count for number, count in enumerate(parts)]
    return np.unique(np.concatenate([*evenly, [len(parts)], np.interp(table["time"], times, np.arange(len(times)))]))


def _thin(slab: Polyhedron, size: Array) -> Polyhedron:
    """The slab of a plane as it is drawn: as long and wide as MuJoCo draws it, half of it in `size`; endless where that is 0."""
    vertices = slab.vertices.copy()
    top = vertices[:, 2].max()
    half = np.where(size > 0, size, np.abs(vertices[:, :2]).max(axis=0))
    vertices[:, :2] = np.sign(vertices[:, :2]) * half
    vertices[:, 2] = np.where(vertices[:, 2] < top, top - 0.01 * half.min(), top)
    return Polyhedron(vertices, slab.faces)


def _event(row: np.void, stamps: Array) -> dict[str, Any]:
    time = float(np.clip(row["time"], stamps[0], stamps[-1]))
    has_place = bool(np.isfinite(row["px"]))
    return {
        "time": time,
        "time_upper": max(time, float(row["time_upper"])),
        "pair": (row["first"], row["second"]),
        "kind": str(row["what"]),
        "certain": bool(row["certain"]),
        "points": [[row["px"], row["py"], row["pz"]]] if has_place else [],
        "normals": [[row["nx"], row["ny"], row["nz"]]] if has_place else [],
    }
