"""The tree of an assembly, whichever program it comes from, for `chasles.cad`."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location

from ._core import InvalidInput
from .cad_bounds import Array

Colour = tuple[float, float, float]  # red, green, blue in [0, 1]


@dataclasses.dataclass
class Node:
    """A part, or an assembly of others."""

    name: str
    place: Array = dataclasses.field(default_factory=lambda: np.eye(4))  # (4, 4), in the frame of the node above
    colour: Colour | None = None
    shape: Any = None  # a TopoDS_Shape in its own frame
    children: list[Node] = dataclasses.field(default_factory=list)
    source: Any = None  # the object of the platform


def walk(node: Node, above: str = "", place: Array | None = None) -> Iterator[tuple[str, Node, Array]]:
    """All nodes below the root, and the root if it has a shape: unique path, node, and pose in the world."""
    place = node.place if place is None else place @ node.place
    if above or node.shape is not None:
        yield (above or node.name or "part", node, place)
    used: set[str] = set()
    for number, child in enumerate(node.children):
        name = plain = (child.name or f"part {number + 1}").replace("/", "_")
        count = 1
        while name in used:
            count += 1
            name = f"{plain}_{count}"
        used.add(name)
        yield from walk(child, f"{above}/{name}" if above else name, place)


def split(node: Node) -> None:
    """Make an assembly of a part that is several solids, and of nothing else: each solid is a part."""
    solids = list(explored(node.shape, TopAbs_ShapeEnum.TopAbs_SOLID))
    others = TopExp_Explorer(node.shape, TopAbs_ShapeEnum.TopAbs_FACE, TopAbs_ShapeEnum.TopAbs_SOLID)
    if len(solids) > 1 and not others.More():
        node.children = [
            Node(f"solid {number + 1}", matrix_of(solid.Location()), node.colour, without_place(solid))
            for number, solid in enumerate(solids)
        ]
        node.shape = None


def explored(shape: Any, kind: Any) -> Iterator[Any]:
    """All faces, edges, solids or the like of a shape, in order; those that several share come several times."""
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def matrix_of(location: Any) -> Array:
    """A TopLoc_Location as a pose (4, 4)."""
    move = location.Transformation()
    matrix = np.eye(4)
    matrix[:3] = [[move.Value(row, column) for column in range(1, 5)] for row in range(1, 4)]
    if abs(np.linalg.det(matrix[:3, :3]) - 1) > 1e-6:
        raise InvalidInput("a placement scales or mirrors: apply it to the shape")
    return matrix


def without_place(shape: Any) -> Any:
    """A shape in its own frame."""
    return shape.Located(TopLoc_Location())
