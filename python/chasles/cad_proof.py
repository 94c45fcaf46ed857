"""Whether two true parts are proven to touch, from their triangles, for `chasles.cad`.

A point of the triangles of one part is within its bound of a point of the true part. If it is inside of the other part's
triangles, and farther from them than both bounds, that point is in the other true part (docs/derivations/43-tessellations.md).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ._core import Polyhedron, sphere
from .batch import first_contact_batch
from .cad_assembly import Part
from .cad_bounds import Array

MOST = 24  # edges of each part whose points are tried, those nearest to the contact
ALONG = (0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98)  # flush parts have no depth at the ends of their edges
_SHALLOW = 1e-7  # of the size: at a smaller depth, points of flush faces take an exact test each
STEPS = 13  # of the search for a value, each four times as long as the one before
_NARROW = 1e-2  # of the way to the first value that is proven: where the search for an earlier one ends


class Overlap:
    """Two parts and the place where they first come near each other."""

    def __init__(self, parts: tuple[Part, Part], poses: tuple[Array, Array], place: Array) -> None:
        self.parts = parts
        size = max(float(np.ptp(part.mesh.vertices, axis=0).max()) for part in parts)
        self.depth = max(sum(part.bound for part in parts) * (1 + 1e-9), _SHALLOW * size)
        self.points = [_near(part, pose, place) for part, pose in zip(parts, poses, strict=True)]

    def is_proven(self, poses: tuple[Array, Array]) -> bool:
        """At these poses. It may be false although the parts touch."""
        from_second: Array = np.linalg.inv(poses[1]) @ poses[0]
        return _is_deep(self.points[0], from_second, self.parts[1], self.depth) or _is_deep(
            self.points[1], np.asarray(np.linalg.inv(from_second), np.float64), self.parts[0], self.depth
        )


def first_proven(overlap: Overlap, poses_at: Callable[[float], tuple[Array, Array]], start: float, end: float) -> float | None:
    """A value between both at which the parts are proven to touch, soon after the start; None if none is found."""
    tried = [start + (end - start) * 4.0 ** (count - STEPS) for count in range(STEPS + 1)]
    after = next((count for count, value in enumerate(tried) if overlap.is_proven(poses_at(value))), None)
    if after is None:
        return None
    low, high = start if after == 0 else tried[after - 1], tried[after]
    while abs(high - low) > _NARROW * abs(high - start):
        middle = (low + high) / 2
        low, high = (low, middle) if overlap.is_proven(poses_at(middle)) else (middle, high)
    return high


def _near(part: Part, pose: Array, place: Array) -> Array:
    """Points of the triangles in the part's frame, along the edges nearest to a place in the world: the nearest one, and others."""
    at = pose[:3, :3].T @ (place - pose[:3, 3])
    vertices = part.mesh.vertices
    edges = _edges(part.mesh)
    start, way = vertices[edges[:, 0]], vertices[edges[:, 1]] - vertices[edges[:, 0]]
    share = np.clip(np.einsum("ij,ij->i", at - start, way) / np.maximum(np.einsum("ij,ij->i", way, way), 1e-300), 0, 1)
    order = np.argsort(np.linalg.norm(start + share[:, None] * way - at, axis=1), kind="stable")[:MOST]
    shares = np.concatenate([[share[order]], np.tile(ALONG, (len(order), 1)).T])
    return np.concatenate([start[order] + each[:, None] * way[order] for each in shares])


def _edges(body: Polyhedron) -> Array:
    faces = np.array([face for face in body.faces if len(face) == 3])
    return np.unique(np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)


def _is_deep(points: Array, pose: Array, part: Part, depth: float) -> bool:
    """Whether one of the points, moved by a pose into the frame of a part, is so deep in its triangles."""
    moved = points @ pose[:3, :3].T + pose[:3, 3]
    vertices = part.mesh.vertices
    moved = moved[((moved >= vertices.min(axis=0) + depth) & (moved <= vertices.max(axis=0) - depth)).all(axis=1)]
    if len(moved) == 0 or part.mesh.report.solid_parts == 0:
        return False
    places = np.column_stack([moved, np.tile([1.0, 0, 0, 0], (len(moved), 1))])
    ball = sphere(depth)
    verdicts = first_contact_batch(ball, part.mesh, places, places, find="any")["verdict"]
    inside = np.isin(verdicts, ["contact", "contact_at_start"])  # and not rows for which no time was left
    surface = Polyhedron(vertices, part.mesh.faces, solid="no")
    is_apart = first_contact_batch(ball, surface, places[inside], places[inside], find="any")["verdict"] == "clear"
    return bool(is_apart.any())
