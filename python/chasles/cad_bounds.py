"""How far a triangulated face may be from its true surface, from the type of the surface, for `chasles.cad`.

All bounds hold both ways, for each point of the triangles and for each point of the face: docs/derivations/43-tessellations.md.
Points are in the frame of the surface: the axis of cylinders, cones and tori is z, and spheres have their middle at 0.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Triangles = npt.NDArray[np.int64]


def of_revolution(points: Array, triangles: Triangles, angles: Array, radius: float, slope: float) -> float:
    """A cylinder (slope 0) or a cone, whose radius is `radius + slope * z`; infinite for triangles about the axis.

    A point of a triangle goes to the point of the surface at the same height and angle. Its distance to the axis is at
    least its length along any direction across the axis; here along the middle of the angles of the triangle.
    """
    reach = radius + slope * points[:, 2]
    lengths = np.hypot(points[:, 0], points[:, 1])
    size = float(lengths.max(initial=0.0))
    side = -1.0 if reach.sum() < 0 else 1.0  # of the apex
    reach = side * reach
    beyond = -float(reach.min(initial=0.0))
    if beyond > 1e-9 * size:
        return float("inf")  # on both sides of the apex of a cone; the apex itself may be beyond by rounding
    reach = np.maximum(reach, 0)
    corner = np.where(lengths > 1e-9 * size, angles, np.nan)[triangles]  # an apex is at all angles
    middle = (np.nanmin(corner, axis=1) + np.nanmax(corner, axis=1)) / 2
    along = side * np.einsum("tij,tj->ti", points[triangles][..., :2], np.column_stack([np.cos(middle), np.sin(middle)]))
    if not (along >= -1e-9 * size).all():
        return float("inf")
    short = (reach[triangles] - along).max(initial=0.0)
    return float(max(short, (lengths - reach).max(initial=0.0)) + beyond)


def sphere(points: Array, triangles: Triangles, radius: float) -> float:
    """A point of a triangle goes to the point of the sphere in the same direction from the middle.

    Its distance to the middle is at least that of the plane of the triangle, and its length along any direction.
    """
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals = normals / np.where(lengths > 0, lengths, 1)[:, None]
    of_plane = np.abs(np.einsum("ti,tji->tj", normals, corners)).min(axis=1)
    middles = corners.sum(axis=1)
    middles = middles / np.maximum(np.linalg.norm(middles, axis=1), 1e-300)[:, None]
    along = np.einsum("ti,tji->tj", middles, corners).min(axis=1)
    nearest = np.maximum(of_plane, along)
    if (nearest <= 0).any():
        return float("inf")
    return float(max((radius - nearest).max(initial=0.0), (np.linalg.norm(points, axis=1) - radius).max(initial=0.0)))


def torus(points: Array, triangles: Triangles, parameters: Array, major: float, minor: float) -> float:
    """A point of a triangle goes to the point of the torus with the same mixture of parameters; Taylor's formula bounds the way."""
    u, v = parameters.T
    around = major + minor * np.cos(v)
    true = np.column_stack([around * np.cos(u), around * np.sin(u), minor * np.sin(v)])
    away = np.linalg.norm(points - true, axis=1).max(initial=0.0)
    if major < minor:
        return float("inf")
    corner = parameters[triangles]
    lower, upper = corner.min(axis=1), corner.max(axis=1)
    du, dv = (upper - lower).T
    cosine = _largest_cosine(lower[:, 1], upper[:, 1])
    sine = _largest_cosine(2 * (lower[:, 1] - np.pi / 2), 2 * (upper[:, 1] - np.pi / 2))  # of sin^2 v = (1 + cos(2 v - pi)) / 2
    sine = np.sqrt((1 + sine) / 2)
    bends = (major + minor * cosine) * du**2 + 2 * minor * sine * du * dv + minor * dv**2
    return float(away + bends.max(initial=0.0) / 8)


def _largest_cosine(lower: Array, upper: Array) -> Array:
    """Of all angles between both ends."""
    has_one = np.floor(upper / (2 * np.pi)) > np.floor(lower / (2 * np.pi))
    return np.where(has_one, 1.0, np.maximum(np.cos(lower), np.cos(upper)))


def plane(points: Array) -> float:
    """How far vertices are from the plane z = 0."""
    return float(np.abs(points[:, 2]).max(initial=0.0))


def arcs(radius: float, parameters: Array) -> float:
    """Of chords of a circle between these angles, or of an ellipse with this larger radius."""
    half = np.abs(np.diff(parameters)).max(initial=0.0) / 2
    return float(radius * (1 - np.cos(half))) if half <= np.pi / 2 else float("inf")


def bent(parameters: Array, bends: Array) -> float:
    """Of chords of any curve between these parameters, where `bends` bounds the second derivative between each two: Taylor's formula."""
    return float((np.diff(parameters) ** 2 * bends).max(initial=0.0) / 8)


def poles(start: Array, end: Array, points: Array) -> float:
    """How far points, in whose hull a curve lies, are from the segment between its ends."""
    way = end - start
    length = float(way @ way)
    share = np.clip((points - start) @ way / length, 0, 1) if length > 0 else np.zeros(len(points))
    return float(np.linalg.norm(points - start - share[:, None] * way, axis=1).max(initial=0.0))


def least_radius(kind: str, points: Array, numbers: tuple[float, ...]) -> float:
    """No normal section of the surface near these points is more curved than a circle of this radius."""
    if kind == "cone":
        return float(np.abs(numbers[0] + numbers[1] * points[:, 2]).min(initial=np.inf))
    if kind == "torus":
        return min(numbers[1], numbers[0] - numbers[1])
    return numbers[0]
