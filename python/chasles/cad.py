"""Assemblies of STEP files, build123d and CadQuery: clashes at rest, ranges of joints, least clearances, proven.

This module requires OCP, the package `cadquery-ocp` or `cadquery-ocp-novtk` (7.8 or later), and is imported by its name:
``import chasles.cad``.

    assembly = chasles.cad.load("gripper.step")              # or an assembly of build123d or CadQuery
    report = chasles.cad.check(assembly, intended=[("pin", "clevis")])
    print(report)
    report.view("gripper.html")

The guide is docs/cad.md. The choices are in docs/decisions/0117-cad.md.
"""

from __future__ import annotations

import os
from typing import Any

from ._core import InvalidInput
from .extras import extra

with extra("cad", "chasles.cad"):
    import OCP  # noqa: F401

from . import cad_build123d, cad_cadquery
from .articles import with_article
from .cad_assembly import Assembly, Part
from .cad_check import check
from .cad_joints import Joint
from .cad_report import Clearance, JointRange, PairRange, Report, Stop, Touch
from .cad_step import read_step

__all__ = ["Assembly", "Clearance", "Joint", "JointRange", "PairRange", "Part", "Report", "Stop", "Touch", "check", "load"]


def load(source: Any, *, deflection: float | None = None, angle: float = 0.3, skip_empty: bool = False) -> Assembly:
    """The assembly of a STEP file, of build123d or of CadQuery, with names, colours, places and joints. Lengths are millimetres.

    Parameters
    ----------
    source : path, or an object of build123d or CadQuery
        A STEP file has no joints. In build123d it is a part or a Compound with children; its joints are those that are
        connected. In CadQuery it is an Assembly; its joints are what its constraints leave.
    deflection : float, optional
        How far triangles may be from curved faces, mm: what OCCT aims at, and `Part.bound` bounds. By default a part in
        2,000 of the size of each part.
    angle : float
        The largest angle between neighbouring triangles of a curved face that OCCT aims at, radians. Where its mesher leaves
        out a face, other angles are tried for the part: docs/cad.md.
    skip_empty : bool
        Whether parts whose shape is not there are left out, with a warning, rather than refused.

    Raises
    ------
    InvalidInput
        For files that are no STEP, parts in files that are not there, shapes without faces, faces that OCCT cannot mesh, joints of parts that are not in the assembly, closed loops of
        joints, and constraints that leave no joint.
    TypeError
        For an object of another kind.
    """
    if isinstance(source, Assembly):
        return source
    if not (deflection is None or 0 < deflection < float("inf")):
        raise InvalidInput(f"deflection: must be above 0 and finite, not {deflection}")
    if not 0 < angle <= 1:
        raise InvalidInput(f"angle: must be in (0, 1], not {angle}")
    options: dict[str, Any] = {"deflection": deflection, "angle": angle, "skip_empty": skip_empty}
    if isinstance(source, (str, os.PathLike)):
        return Assembly(read_step(source, skip_empty), **options)
    for platform in (cad_build123d, cad_cadquery):
        if platform.is_its(source):
            root = platform.tree_of(source)
            assembly = Assembly(root, **options)
            platform.add_joints(assembly, root)
            return assembly
    raise TypeError(
        f"source: {with_article(source)} is no path of a STEP file, no shape of build123d, and no Assembly of CadQuery"
    )


def is_assembly(thing: Any) -> bool:
    """Whether `load` takes it, and it has parts of its own: an Assembly, one of CadQuery, or a Compound of build123d with children."""
    if isinstance(thing, Assembly) or cad_cadquery.is_its(thing):
        return True
    return cad_build123d.is_its(thing) and bool(getattr(thing, "children", ())) and getattr(thing, "parent", None) is None
