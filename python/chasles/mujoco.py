"""MuJoCo's models as robots, and an audit of recorded states: who passed through whom between two of them.

This module requires the package `mujoco` (3.2 or later), and is imported by its name: ``import chasles.mujoco``.

    robot = chasles.mujoco.robot(model)
    found = chasles.mujoco.audit(model, qpos, allowed_overlap=0.001)   # qpos: (states, model.nq)
    print(found)
    found.view("audit.html")

The guide is docs/mujoco.md. The choices are in docs/decisions/0115-mujoco.md.
"""

from __future__ import annotations

import functools
from collections.abc import Collection
from typing import Any

import mujoco as mj
import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, JointPath, Polyhedron, Robot
from .articles import with_article
from .arrays import numbers
from .mujoco_audit import Audit, Question, audit_of
from .mujoco_pairs import Geoms, geoms_of
from .mujoco_shapes import CURVED, Array, inset_of, kind_of, shape_of
from .mujoco_tree import joints_of, numbers_of, place_of_geom, reach_of, values_of

__all__ = ["Audit", "audit", "configurations", "robot", "untested"]


def robot(
    model: Any,
    *,
    allowed_overlap: float = 0.0,
    meshes: str = "hull",
    deviation: float = 0.005,
    plane_size: float | None = None,
    leave_out: Collection[str] = (),
) -> Robot:
    """The robot of a MuJoCo model: all that its bodies can do, and all pairs of geoms that MuJoCo tests.

    The root link is "world". Each body is a link of its name, and each geom that MuJoCo collides with anything is a link
    "BODY/GEOM" that is fixed to it. Poses of links are MuJoCo's `xpos`, `xquat`, `geom_xpos` and `geom_xmat`. Hinges and
    slides have MuJoCo's values; a free joint, a ball and a body that is moved by `mocap_pos` are floating joints.
    `configurations` makes configurations of `qpos`.

    Parameters
    ----------
    model : mujoco.MjModel
    allowed_overlap : float
        Two geoms that overlap by this much do not touch yet: the faces of both are moved inwards by half of it, but by
        at most nine tenths of the radius of the largest ball in a geom. `Robot.warnings` names geoms that are so thin.
        Length unit. Distances of this robot are those of the moved faces, which are larger than those of the geoms.
    meshes : "hull" or "mesh"
        A mesh is the convex hull that MuJoCo collides, or its faces.
    deviation : float
        Cylinders and ellipsoids are polyhedra around them that leave them by at most this part of their largest radius.
    plane_size : float, optional
        A plane is a slab that reaches so far to each side and down, length unit: by default 100 times the size of the model
        (`model.stat.extent`). Nothing is proven about what is farther away from the plane's middle.
    leave_out : collection of str
        Geoms and flexes that are not looked at, by their names in the model, or "BODY/GEOM".

    Raises
    ------
    InvalidInput
        With the name of the geom or flex, for what has no polyhedron (signed distance fields, flexes), and with meshes="mesh" for
        a mesh whose faces cannot be moved inwards.
    TypeError
        For what is no MjModel.
    """
    _check(model, allowed_overlap, meshes, deviation)
    plane_size = 100 * float(model.stat.extent) if plane_size is None else plane_size
    if not 0 < plane_size < float("inf"):
        raise InvalidInput(f"plane_size: must be above 0 and finite, not {plane_size}")
    geoms = geoms_of(model, leave_out)
    shaping = {"inset": allowed_overlap / 2, "meshes": meshes, "deviation": deviation, "plane": plane_size}
    return _robot(model, geoms, dict.fromkeys(geoms.ids, 0.0), shaping, inner=False)


def configurations(model: Any, qpos: npt.ArrayLike, mocap: npt.ArrayLike | None = None) -> Array:
    """The configurations of the robot of a model for states of MuJoCo.

    Parameters
    ----------
    model : mujoco.MjModel
    qpos : array (model.nq,) or (states, model.nq)
        As in `mjData.qpos`.
    mocap : array (model.nmocap, 7) or (states, model.nmocap, 7), optional
        Poses x y z qw qx qy qz of mocap bodies, as in `mocap_pos` and `mocap_quat`. By default where the model has them.

    Returns
    -------
    array (variables,) or (states, variables)
        Radians, or the length unit, in the order of `robot(model).variables`.

    Raises
    ------
    InvalidInput
        For a wrong shape.
    """
    _check_model(model)
    return values_of(model, qpos, mocap)


def untested(model: Any, leave_out: Collection[str] = ()) -> dict[str, int]:
    """How many pairs of geoms MuJoCo, and therefore this module, does not test, by reason.

    The reasons are "welded" (one body, or bodies without a joint between them), "parent" (a body and the one that
    carries it), "exclude" (an element of the model), "contype" (the bits of `contype` and `conaffinity`), and
    "left out".
    """
    _check_model(model)
    return geoms_of(model, leave_out).untested


def audit(
    model: Any,
    qpos: npt.ArrayLike,
    allowed_overlap: float = 0.0,
    *,
    times: npt.ArrayLike | None = None,
    mocap: npt.ArrayLike | None = None,
    meshes: str = "hull",
    deviation: float = 0.005,
    leave_out: Collection[str] = (),
) -> Audit:
    """Who passed through whom between recorded states, proven for all times between them.

    Between two states all joints move evenly at the same time: hinges and slides straight from value to value, free joints and
    balls on a straight line and about one axis, the shorter way round. So do MuJoCo's `mj_differentiatePos` and
    `mj_integratePos`.

    Parameters
    ----------
    model : mujoco.MjModel
    qpos : array (states, model.nq)
        Recorded states, as of `mjData.qpos` after each step.
    allowed_overlap : float
        Two geoms that overlap by this much do not touch yet; contacts of MuJoCo are soft. Length unit.
    times : array (states,), optional
        Ascending times of the states, any unit. By default the numbers of the states.
    mocap : array (states, model.nmocap, 7), optional
        As for `configurations`.
    meshes, deviation, leave_out
        As for `robot`.

    Returns
    -------
    Audit

    Raises
    ------
    InvalidInput
        As `robot` and `configurations`; for times that do not ascend, and for values beyond 1000.
    """
    _check(model, allowed_overlap, meshes, deviation)
    states = numbers_of(qpos, "qpos")
    if states.ndim != 2 or len(states) < 2 or states.shape[1] != model.nq:
        raise InvalidInput(f"qpos: the shape is {states.shape}; (states, {model.nq}) with two states or more is needed")
    geoms = geoms_of(model, leave_out)
    plane = 2 * reach_of(model, states, mocap) + 1  # the middle of a plane may be as far from the origin as any geom
    shaping = {"inset": allowed_overlap / 2, "meshes": meshes, "deviation": deviation, "plane": plane}

    @functools.cache
    def inner(first: str, second: str) -> Robot:
        # A little smaller than they are, and not equally: then flush sides of both are not in one plane.
        ids = [geom for geom in geoms.ids if geoms.names[geom] in (first, second)]
        return _robot(model, geoms, dict(zip(ids, (1e-8 * plane, 2e-8 * plane), strict=True)), shaping, inner=True)

    question = Question(
        robot=_robot(model, geoms, dict.fromkeys(geoms.ids, 0.0), shaping, inner=False),
        configurations=configurations(model, states, mocap),
        times=_times(times, len(states)),
        curved={geoms.names[geom] for geom in geoms.ids if kind_of(model, geom) in CURVED},
        inner=inner,
    )
    JointPath.straight(
        question.robot, question.configurations
    )  # refuses bad values, with the number of their state
    planes = {geoms.names[g]: model.geom_size[g, :2].copy() for g in geoms.ids if kind_of(model, g) == "PLANE"}
    return audit_of(question, allowed_overlap, geoms, planes)


def _robot(model: Any, geoms: Geoms, ids: dict[int, float], shaping: dict[str, Any], *, inner: bool) -> Robot:
    """With these geoms. The numbers are by how much their faces move inwards beyond the allowed overlap."""
    links, joints = joints_of(model)
    known: dict[Any, tuple[Any, float]] = {}
    thin = []
    for geom, more in ids.items():
        name, size = geoms.names[geom], model.geom_size[geom]
        key = (kind_of(model, geom), int(model.geom_dataid[geom]), more, *size)
        try:
            known[key] = known.get(key) or _shape(model, geom, more, inner=inner, **shaping)
        except InvalidInput as error:
            raise InvalidInput(f"geom {name!r}: {error}; leave_out leaves it out") from None
        shape, inset = known[key]
        radius = float({"CYLINDER": size[0], "ELLIPSOID": size.max()}.get(kind_of(model, geom), 0.0))
        links.append({"name": name, "collisions": [{"shape": shape, "deviation": shaping["deviation"] * radius}]})
        body = links[model.geom_bodyid[geom]]["name"]
        joints.append(
            {
                "name": f"geom {name}",
                "type": "fixed",
                "parent": body,
                "child": name,
                "origin": place_of_geom(model, geom),
            }
        )
        if inset < shaping["inset"]:
            thin.append(
                f"{name}: is thin; beside geoms that are not, an overlap of {shaping['inset'] + inset:.3g} is allowed"
            )
    disabled = [(geoms.names[a], geoms.names[b], why) for a, b, why in geoms.disabled if a in ids and b in ids]
    title = bytes(model.names).split(b"\0")[0].decode() or "model"
    return Robot(name=title, links=links, joints=joints, disabled_pairs=disabled, warnings=thin)


def _shape(
    model: Any, geom: int, more: float, *, inset: float, meshes: str, **options: Any
) -> tuple[Polyhedron, float]:
    inset = inset_of(model, geom, inset, meshes)
    return shape_of(model, geom, inset + more, meshes=meshes, **options), inset


def _times(times: npt.ArrayLike | None, count: int) -> Array:
    if times is None:
        return np.arange(count, dtype=np.float64)
    result = numbers(times, "times")
    if result.shape != (count,) or not np.isfinite(result).all() or (np.diff(result) <= 0).any():
        raise InvalidInput(f"times: {count} finite times that ascend are needed")
    return result


def _check_model(model: Any) -> None:
    if not isinstance(model, mj.MjModel):
        raise TypeError(f"model: {with_article(model)} is not a mujoco.MjModel")


def _check(model: Any, allowed_overlap: float, meshes: str, deviation: float) -> None:
    _check_model(model)
    if not 0 <= allowed_overlap < float("inf"):
        raise InvalidInput(f"allowed_overlap: must be at least 0 and finite, not {allowed_overlap}")
    if meshes not in ("hull", "mesh"):
        raise InvalidInput(f"meshes: must be 'hull' or 'mesh', not {meshes!r}")
    if not 1e-6 <= deviation <= 1:
        raise InvalidInput(f"deviation: must be in [1e-6, 1], not {deviation}")
