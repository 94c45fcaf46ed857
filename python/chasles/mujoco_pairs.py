"""Which geoms of a MuJoCo model are tested against each other, for `chasles.mujoco`: those that MuJoCo tests."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import mujoco as mj
import numpy as np
import numpy.typing as npt

from ._core import InvalidInput
from .mujoco_tree import body_names

REASONS = ("welded", "parent", "exclude", "contype", "left out")


@dataclass(frozen=True)
class Geoms:
    """The geoms that are looked at, and why others are not."""

    names: list[str]  #: of all geoms: "BODY/GEOM"
    ids: list[int]  #: of the geoms that are tested against any other one
    disabled: list[tuple[int, int, str]]  #: pairs of them that are not tested, and that joints move against each other
    tested: int  #: pairs
    untested: dict[str, int]  #: pairs by reason
    left_out: list[str]  #: as they were named


def geoms_of(model: Any, leave_out: Collection[str]) -> Geoms:
    """Raises InvalidInput for unknown names, and for what touches in MuJoCo but has no shape here."""
    if isinstance(leave_out, str):
        raise InvalidInput(f"leave_out: {leave_out!r} is one text; a collection of names is needed")
    own = [mj.mj_id2name(model, mj.mjtObj.mjOBJ_GEOM, geom) or f"geom {geom}" for geom in range(model.ngeom)]
    bodies = body_names(model)
    names = [f"{bodies[body]}/{name}" for body, name in zip(model.geom_bodyid, own, strict=True)]
    names = [
        f"{name} (geom)" if name in bodies else name for name in names
    ]  # attached models have bodies "a" and "a/b"
    left = _left_out(model, own, names, set(leave_out))
    reasons = _reasons(model)
    reasons[left, :] = reasons[:, left] = REASONS.index("left out")
    upper = np.triu(np.ones_like(reasons, dtype=bool), 1)
    is_tested = (reasons < 0) & upper
    is_used = is_tested.any(axis=0) | is_tested.any(axis=1)
    for geom in np.flatnonzero(is_used & (model.geom_type == int(mj.mjtGeom.mjGEOM_SDF))):
        raise InvalidInput(f"geom {names[geom]!r}: signed distance fields have no polyhedron; name it in leave_out")
    both = is_used[:, None] & is_used[None, :] & upper & (reasons >= 0) & _moves(model)
    disabled = [(int(a), int(b), REASONS[reasons[a, b]]) for a, b in np.argwhere(both)]
    counts = np.bincount(reasons[upper & (reasons >= 0)], minlength=len(REASONS))
    untested = {reason: int(count) for reason, count in zip(REASONS, counts, strict=True) if count}
    return Geoms(
        names,
        [int(geom) for geom in np.flatnonzero(is_used)],
        disabled,
        int(is_tested.sum()),
        untested,
        sorted(leave_out),
    )


def _left_out(model: Any, own: list[str], names: list[str], wanted: set[str]) -> list[int]:
    """The geoms to leave out. All flexes that touch something have to be among the names."""
    flexes = [mj.mj_id2name(model, mj.mjtObj.mjOBJ_FLEX, flex) or f"flex {flex}" for flex in range(model.nflex)]
    for flex, name in enumerate(flexes):
        if (model.flex_contype[flex] or model.flex_conaffinity[flex]) and name not in wanted:
            raise InvalidInput(f"flex {name!r}: deforms, and only rigid bodies can be proven; name it in leave_out")
    left = [geom for geom in range(model.ngeom) if own[geom] in wanted or names[geom] in wanted]
    known = {*flexes, *own, *names}
    for name in sorted(wanted - known):
        raise InvalidInput(f"leave_out: {name!r}: there is no such geom or flex")
    return left


def _reasons(model: Any) -> npt.NDArray[np.int64]:
    """Of each pair of geoms why MuJoCo does not test it, a number in REASONS; -1 if it does. The last reason wins."""
    weld = model.body_weldid[model.geom_bodyid]
    parent = model.body_weldid[model.body_parentid[weld]]
    result = np.full((model.ngeom, model.ngeom), -1, np.int64)
    bits = (model.geom_contype[:, None] & model.geom_conaffinity[None, :]) != 0
    result[~(bits | bits.T)] = REASONS.index("contype")
    result[_is_excluded(model)] = REASONS.index("exclude")
    if not model.opt.disableflags & mj.mjtDisableBit.mjDSBL_FILTERPARENT:
        is_child = (weld[:, None] == parent[None, :]) & (weld[:, None] != 0) & (weld[None, :] != 0)
        result[is_child | is_child.T] = REASONS.index("parent")
    result[weld[:, None] == weld[None, :]] = REASONS.index("welded")
    moves = _moves(model)
    for a, b in zip(model.pair_geom1, model.pair_geom2, strict=True):  # MuJoCo takes these pairs whatever else is said
        if moves[a, b]:
            result[a, b] = result[b, a] = -1
    return result


def _is_excluded(model: Any) -> npt.NDArray[np.bool_]:
    of_bodies = np.zeros((model.nbody, model.nbody), bool)
    for signature in model.exclude_signature:
        a, b = int(signature) >> 16, int(signature) & 0xFFFF
        of_bodies[a, b] = of_bodies[b, a] = True
    return of_bodies[model.geom_bodyid[:, None], model.geom_bodyid[None, :]]


def _moves(model: Any) -> npt.NDArray[np.bool_]:
    """Whether joints or mocap poses move two geoms against each other."""
    groups = np.array(model.body_weldid)
    for body in range(1, model.nbody):  # a mocap body is welded to the world in MuJoCo's eyes; its children follow it
        parent = model.body_parentid[body]
        if model.body_mocapid[body] >= 0:
            groups[body] = body
        elif model.body_jntnum[body] == 0:
            groups[body] = groups[parent]
    of_geoms = groups[model.geom_bodyid]
    return of_geoms[:, None] != of_geoms[None, :]
