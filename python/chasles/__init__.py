"""Exact continuous collision detection of rigid polyhedra: when, where and how two moving bodies first touch.

    import chasles

    peg, hole = chasles.load("peg.obj"), chasles.load("hole.obj")
    found = chasles.first_contact(peg, hole, start, goal)  # poses: (4, 4), or (7,) for x y z qw qx qy qz
    if found.verdict == "contact":
        print(found.time, found.contacts[0].normal)

Lengths are in the meshes' own unit, angles in radians, times in [0, 1]. The guide is docs/python.md.
"""

from typing import Any

from ._core import (
    Cancelled,
    ClearBox,
    ConstantTwist,
    ConstantVelocity,
    Contact,
    DistanceMatrix,
    DistanceProfile,
    DragContact,
    DragEvent,
    DraggedBody,
    DragLock,
    DragStep,
    FirstContact,
    InvalidInput,
    JointPath,
    LeastDistance,
    Limit,
    MassProperties,
    MeshReport,
    Motion,
    Overlap,
    PairMemory,
    PairProof,
    PathContact,
    Polyhedron,
    Robot,
    RobotChecker,
    RobotClearance,
    RobotContact,
    RobotRange,
    Scene,
    SceneContact,
    ScrewMotion,
    Spline,
    StepEvent,
    Stepper,
    SweepMotion,
    TimedPoses,
    Trajectory,
    UntestedPairs,
    Work,
    __version__,
    capsule,
    constraint_rows,
    first_contact,
    first_contact_on_path,
    least_distance,
    load,
    load_parts,
    load_points,
    points,
    profile,
    relative,
    rest_of,
    sphere,
    verify,
)
from .batch import BatchInterrupted, certificate_batch, first_contact_batch, least_distance_batch, path_is_clear_batch
from .collision import CollisionManager
from .end_of_process import prepare as _prepare_end_of_process
from .enums import ContactKind, Find, Verdict
from .meshes import from_trimesh, parts_from_trimesh
from .no_truth_value import prepare as _refuse_truth_values
from .not_pickled import prepare as _refuse_pickles
from .record import recording_page, write_scene_page
from .robots import edge_dtype, first_contacts_on_edges, write_robot_page
from .saved_scene import reduce_scene
from .table import empty_table, least_dtype, motion_dtype, path_dtype
from .view import view, write_page

__all__ = [
    "BatchInterrupted",
    "Cancelled",
    "ClearBox",
    "CollisionManager",
    "ConstantTwist",
    "ConstantVelocity",
    "Contact",
    "ContactKind",
    "DistanceMatrix",
    "DistanceProfile",
    "DragContact",
    "DragEvent",
    "DragLock",
    "DragStep",
    "DraggedBody",
    "Find",
    "FirstContact",
    "InvalidInput",
    "JointPath",
    "LeastDistance",
    "Limit",
    "MassProperties",
    "MeshReport",
    "Motion",
    "Overlap",
    "PairMemory",
    "PairProof",
    "PathContact",
    "Polyhedron",
    "Robot",
    "RobotChecker",
    "RobotClearance",
    "RobotContact",
    "RobotRange",
    "Scene",
    "SceneContact",
    "ScrewMotion",
    "Spline",
    "StepEvent",
    "Stepper",
    "SweepMotion",
    "TimedPoses",
    "Trajectory",
    "UntestedPairs",
    "Verdict",
    "Work",
    "__version__",
    "capsule",
    "certificate_batch",
    "constraint_rows",
    "edge_dtype",
    "empty_table",
    "first_contact",
    "first_contact_batch",
    "first_contact_on_path",
    "first_contacts_on_edges",
    "from_trimesh",
    "least_distance",
    "least_distance_batch",
    "least_dtype",
    "load",
    "load_parts",
    "load_points",
    "motion_dtype",
    "parts_from_trimesh",
    "path_dtype",
    "path_is_clear_batch",
    "points",
    "profile",
    "recording_page",
    "relative",
    "rest_of",
    "sphere",
    "verify",
    "view",
    "write_robot_page",
]

for _name in __all__:  # names of the public module, not of chasles._core
    if getattr(globals()[_name], "__module__", "") == "chasles._core" and isinstance(globals()[_name], type):
        globals()[_name].__module__ = "chasles"


def _plot(found: FirstContact, *arguments: Any, **options: Any) -> Any:
    """Draw the answer with matplotlib: see `chasles.plot.plot`."""
    from .plot import plot  # imported here, because matplotlib is an optional dependency

    return plot(found, *arguments, **options)


def _plot_profile(profile: DistanceProfile, *arguments: Any, **options: Any) -> Any:
    """Draw both bounds over the time with matplotlib: see `chasles.plot_profile.plot_profile`."""
    from .plot_profile import plot_profile  # as above

    return plot_profile(profile, *arguments, **options)


DistanceProfile.plot = _plot_profile  # type: ignore[attr-defined]


def _plot_range(found: RobotRange, *arguments: Any, **options: Any) -> Any:
    """Draw the boxes of a range of two joints with matplotlib: see `chasles.plot_range.plot_range`."""
    from .plot_range import plot_range  # as above

    return plot_range(found, *arguments, **options)


def _plot_matrix(matrix: DistanceMatrix, *arguments: Any, **options: Any) -> Any:
    """Draw the least distances of all pairs with matplotlib: see `chasles.plot_matrix.plot_matrix`."""
    from .plot_matrix import plot_matrix  # as above

    return plot_matrix(matrix, *arguments, **options)


DistanceMatrix.plot = _plot_matrix  # type: ignore[attr-defined]
RobotRange.plot = _plot_range  # type: ignore[attr-defined]
FirstContact.plot = _plot  # type: ignore[attr-defined]
FirstContact.view = write_page  # type: ignore[attr-defined]
Scene.view = write_scene_page  # type: ignore[attr-defined]
Scene.__reduce__ = reduce_scene  # type: ignore[assignment, method-assign]
_prepare_end_of_process()
_refuse_pickles()
_refuse_truth_values()
