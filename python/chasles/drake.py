"""Drake's plants as robots, and its trajectories as the polynomials that they are.

This module requires the package `drake`, and is imported by its name: ``import chasles.drake``.

    robot = chasles.drake.robot(plant, scene_graph)
    path = chasles.drake.joint_path(trajectory, robot, plant)
    found = robot.first_contact_on_path(path)

The guide is docs/drake.md. The choices are in docs/decisions/0119-ros-drake-pinocchio.md.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.geometry import Role, SceneGraph, SceneGraphInspector
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import ModelInstanceIndex

from ._core import InvalidInput, JointPath, Robot
from .articles import with_article
from .arrays import numbers
from .drake_joints import name_of_body, tree_of
from .drake_polynomials import polynomials_of
from .drake_shapes import body_of
from .primitive_shapes import Array
from .robot_tree import Tree

__all__ = ["configurations", "joint_path", "robot"]


def robot(
    plant: MultibodyPlant,
    scene_graph: SceneGraph | SceneGraphInspector,
    *,
    rest: npt.ArrayLike | None = None,
    meshes: str = "hull",
    deviation: float = 0.005,
    plane_size: float = 100.0,
    leave_out: Collection[str] = (),
) -> Robot:
    """The robot of a plant: its bodies and joints, its proximity geometries, and the pairs that Drake's filters leave.

    Bodies are links "INSTANCE::BODY", and the root link is "world"; bodies of the default instance have their plain name. Each
    proximity geometry is a link "BODY/GEOMETRY" that is fixed to its body. `configurations` makes configurations of positions.

    Parameters
    ----------
    plant : pydrake.multibody.plant.MultibodyPlant
        Finalized.
    scene_graph : pydrake.geometry.SceneGraph or SceneGraphInspector
        The inspector of a `QueryObject` has the collision filters of its context, and a scene graph those of the model.
    rest : array (plant.num_positions(),), optional
        Free bodies with a quaternion stand still where they are at these positions. By default they are floating joints, for
        which only straight paths can be proven.
    meshes : "hull" or "mesh"
        A `Mesh` is its convex hull, as in Drake's queries of proximity, or the faces of its OBJ file. A `Convex` is its hull.
    deviation : float
        Cylinders and ellipsoids are polyhedra around them that leave them by at most this part of their largest radius.
    plane_size : float
        A half-space is a slab that reaches so far to each side of its origin and down, m. What is farther away is not tested.
    leave_out : collection of str
        Geometries that are not looked at, as "BODY/GEOMETRY"; deformable ones by their names.

    Raises
    ------
    InvalidInput
        With its name, for a joint or a geometry that has no counterpart, and for a plant that is not finalized.
    TypeError
        For what is no plant or scene graph.
    """
    inspector = _inspector_of(scene_graph)
    _check(plant)
    if meshes not in ("hull", "mesh"):
        raise InvalidInput(f"meshes: must be 'hull' or 'mesh', not {meshes!r}")
    if not 1e-6 <= deviation <= 1:
        raise InvalidInput(f"deviation: must be in [1e-6, 1], not {deviation}")
    if not 0 < plane_size < float("inf"):
        raise InvalidInput(f"plane_size: must be above 0 and finite, not {plane_size}")
    tree = tree_of(plant, None if rest is None else _positions_of(plant, rest, "rest"))
    names = _add_geometries(tree, plant, inspector, leave_out, (meshes, deviation, plane_size))
    candidates = inspector.GetCollisionCandidates()
    tested = {frozenset((names[a], names[b])) for a, b in candidates if a in names and b in names}
    tree.disable_all_but(tested, "collision filter")
    return tree.robot(plant.get_name() or "plant")


def configurations(robot: Robot, plant: MultibodyPlant, q: npt.ArrayLike) -> Array:
    """The configurations of the robot of a plant for positions of the plant.

    Parameters
    ----------
    robot : Robot
        Of `chasles.drake.robot`.
    plant : pydrake.multibody.plant.MultibodyPlant
    q : array (plant.num_positions(),) or (n, plant.num_positions())

    Returns
    -------
    array (variables,) or (n, variables)
        In the order of `robot.variables`.

    Raises
    ------
    InvalidInput
        For a wrong shape, for quaternions that are 0, and for a robot that was not made of this plant.
    """
    _check(plant)
    return _tree_like(robot, plant).values_of(q, plant.num_positions())


def joint_path(
    trajectory: Any,
    robot: Robot,
    plant: MultibodyPlant,
    *,
    model_instance: ModelInstanceIndex | None = None,
    rest: npt.ArrayLike | None = None,
) -> JointPath:
    """A trajectory of positions as the polynomials that it is.

    A `PiecewisePolynomial` is taken with its own coefficients. The polynomials of `BsplineTrajectory` and `BezierCurve` are
    computed from the control points in rational numbers; each coefficient is rounded once, to double. A
    `CompositeTrajectory` may hold all of these.

    Parameters
    ----------
    trajectory : pydrake.trajectories.Trajectory
        Of positions, in one column.
    robot : Robot
        Of `chasles.drake.robot`.
    plant : pydrake.multibody.plant.MultibodyPlant
    model_instance : ModelInstanceIndex, optional
        The trajectory has the positions of this instance only. All others stay at `rest`.
    rest : array (plant.num_positions(),), optional
        By default the default positions of the plant.

    Returns
    -------
    JointPath
        Its times are those of the trajectory, s.

    Raises
    ------
    InvalidInput
        For other trajectories, a wrong number of rows, jumps, quaternions, and numbers that are not finite.
    """
    _check(plant)
    tree = _tree_like(robot, plant)
    if any(name.endswith("/rot_w") for name in robot.variables):
        body = next(name for name in robot.variables if name.endswith("/rot_w"))[: -len("/rot_w")]
        raise InvalidInput(
            f"robot: {body!r} is free and has a quaternion, which a polynomial does not keep at the length 1: "
            "give `rest` to chasles.drake.robot, or take configurations and a straight path"
        )
    breaks, given = polynomials_of(trajectory)
    every = np.arange(plant.num_positions())
    rows = every if model_instance is None else plant.GetPositionsFromArray(model_instance, every).astype(np.int64)
    if given.shape[2] != len(rows):
        raise InvalidInput(f"trajectory: has {given.shape[2]} rows, and {len(rows)} positions are needed")
    coefficients = np.zeros((*given.shape[:2], len(every)))
    coefficients[-1] = _positions_of(plant, rest, "rest") if rest is not None else _default_positions(plant)
    coefficients[:, :, rows] = given
    resting = coefficients[:, :, sorted(set(every.tolist()) - set(tree.columns))]
    if not (np.abs(resting[:-1]).max(initial=0) <= 1e-9 and np.abs(np.diff(resting[-1], axis=0)).max(initial=0) <= 1e-9):
        raise InvalidInput("trajectory: moves a free body that rests in the robot: make the robot without `rest`")
    return JointPath.polynomials(robot, breaks, coefficients[:, :, np.array(tree.columns, np.int64)])


def _tree_like(robot: Robot, plant: MultibodyPlant) -> Tree:
    """The tree of the plant, with free bodies at rest where the robot has them so."""
    for at in (None, _default_positions(plant)):
        tree = tree_of(plant, at)
        if tree.variables() == list(robot.variables):
            return tree
    raise InvalidInput("robot: was not made of this plant: its variables are others")


def _add_geometries(
    tree: Tree,
    plant: MultibodyPlant,
    inspector: SceneGraphInspector,
    leave_out: Collection[str],
    options: tuple[str, float, float],
) -> dict[Any, str]:
    """The names of the geometries by their ids."""
    if isinstance(leave_out, str):
        raise InvalidInput(f"leave_out: {leave_out!r} is one text; a collection of names is needed")
    names, left = {}, set(leave_out)
    deformable = inspector.GetAllDeformableGeometryIds()
    for geometry in inspector.GetAllGeometryIds(Role.kProximity):
        own = inspector.GetName(geometry).rpartition("::")[2]
        body = None if geometry in deformable else plant.GetBodyFromFrameId(inspector.GetFrameId(geometry))
        name = own if body is None else f"{name_of_body(plant, body)}/{own}"
        left.discard(name)
        if name in leave_out:
            continue
        if body is None:
            why = "deforms" if geometry in deformable else "is on a frame that is none of the plant"
            raise InvalidInput(f"geometry {name!r}: {why}; name it in leave_out")
        try:
            shape, off = body_of(inspector, geometry, *options)
        except InvalidInput as error:
            raise InvalidInput(f"geometry {name!r}: {error}; leave_out leaves it out") from None
        pose = inspector.GetPoseInFrame(geometry).GetAsMatrix4()
        tree.add_geometry(name, name_of_body(plant, body), shape, pose, off)
        names[geometry] = name
    for name in sorted(left):
        raise InvalidInput(f"leave_out: {name!r}: there is no such geometry")
    return names


def _inspector_of(scene_graph: Any) -> SceneGraphInspector:
    if isinstance(scene_graph, SceneGraph):
        return scene_graph.model_inspector()
    if not isinstance(scene_graph, SceneGraphInspector):
        raise TypeError(f"scene_graph: {with_article(scene_graph)} is no SceneGraph and no SceneGraphInspector")
    return scene_graph


def _check(plant: Any) -> None:
    if not isinstance(plant, MultibodyPlant):
        raise TypeError(f"plant: {with_article(plant)} is not a pydrake.multibody.plant.MultibodyPlant")
    if not plant.is_finalized():
        raise InvalidInput("plant: is not finalized: call plant.Finalize()")


def _default_positions(plant: MultibodyPlant) -> Array:
    return np.asarray(plant.GetPositions(plant.CreateDefaultContext()), np.float64)


def _positions_of(plant: MultibodyPlant, q: npt.ArrayLike, name: str) -> Array:
    result = numbers(q, name)
    if result.shape != (plant.num_positions(),) or not np.isfinite(result).all():
        raise InvalidInput(
            f"{name}: {plant.num_positions()} finite positions are needed, and the shape is {result.shape}"
        )
    return result
