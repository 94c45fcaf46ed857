"""Polyhedra of the shapes that robots and simulators are made of, in frames as URDF files have them.

Curved ones enclose the shape, for "clear", or are inside of it, for "contact".
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ._core import Polyhedron

Array = npt.NDArray[np.float64]
Mesh = tuple[Array, list[list[int]]]  # vertices, and faces that turn outwards

_BOX_FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
_ROUNDED = 1 + 2.0**-40  # of an enclosure: more than the rounding of its corners


def box(lower: Array, upper: Array) -> Polyhedron:
    corners = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    return Polyhedron(np.where(corners, upper, lower), _BOX_FACES)


def slab(normal: Array, height: float, size: float) -> Polyhedron:
    """All points within `size` below the plane normal * x = height, sideways and down, as a box."""
    up = np.asarray(normal) / np.linalg.norm(normal)
    first = np.cross(np.eye(3)[np.argmin(np.abs(up))], up)
    first /= np.linalg.norm(first)
    turned = np.stack([first, np.cross(up, first), up])
    corners = np.array([[x, y, z] for x in (-size, size) for y in (-size, size) for z in (height - size, height)])
    return Polyhedron(corners @ turned, _BOX_FACES)


def prism(radius: float, half: float, deviation: float, inner: bool = False) -> Mesh:
    """A regular prism around or inside of a cylinder about z."""
    sides = max(8, math.ceil(math.pi / math.acos(1 / (1 + deviation))))
    corner = radius / _ROUNDED if inner else radius / math.cos(math.pi / sides) * _ROUNDED
    angles = 2 * math.pi * np.arange(sides) / sides
    ring = np.stack([corner * np.cos(angles), corner * np.sin(angles)], axis=1)
    vertices = np.concatenate([np.column_stack([ring, np.full(sides, z)]) for z in (-half, half)])
    walls = [[i, (i + 1) % sides, (i + 1) % sides + sides, i + sides] for i in range(sides)]
    return vertices, [list(range(sides))[::-1], list(range(sides, 2 * sides)), *walls]


def cone(radius: float, half: float, deviation: float) -> Mesh:
    """A pyramid around a cone whose tip is at z = half."""
    vertices, faces = prism(radius, half, deviation)
    sides = len(vertices) // 2
    tip = np.array([[0, 0, half * _ROUNDED]])
    walls = [[i, (i + 1) % sides, sides] for i in range(sides)]
    return np.concatenate([vertices[:sides] * [1, 1, _ROUNDED], tip]), [faces[0], *walls]


def ellipsoid(axes: Array, deviation: float, inner: bool = False) -> Mesh:
    """An icosahedron whose faces are cut into four until it is round enough, with its corners on or outside of the ellipsoid."""
    vertices, faces = _icosahedron()
    while True:
        corners = vertices[faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        apothem = float((np.einsum("ij,ij->i", normals, corners[:, 0]) / np.linalg.norm(normals, axis=1)).min())
        if 1 / apothem <= 1 + deviation:
            break
        vertices, faces = _finer(vertices, faces)
    scale = 1 / _ROUNDED if inner else _ROUNDED / apothem
    return vertices * axes * scale, faces.tolist()


def _icosahedron() -> tuple[Array, npt.NDArray[np.int64]]:
    golden = (1 + math.sqrt(5)) / 2
    base = np.array([[0, a, b * golden] for a in (-1, 1) for b in (-1, 1)])
    vertices = np.concatenate([np.roll(base, turn, axis=1) for turn in range(3)]) / math.hypot(1, golden)
    near = np.linalg.norm(vertices[:, None] - vertices[None], axis=2) < 1.1
    faces = [
        (a, b, c) if np.linalg.det(vertices[[a, b, c]]) > 0 else (a, c, b)
        for a in range(12)
        for b in range(a + 1, 12)
        for c in range(b + 1, 12)
        if near[a, b] and near[b, c] and near[a, c]
    ]
    return vertices, np.array(faces)


def _finer(vertices: Array, faces: npt.NDArray[np.int64]) -> tuple[Array, npt.NDArray[np.int64]]:
    """Each triangle becomes four; the new corners are on the unit sphere."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    unique, index = np.unique(edges, axis=0, return_inverse=True)
    middles = vertices[unique].sum(axis=1)
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    m = index.reshape(-1, 3) + len(vertices)
    a, b, c = faces.T
    parts = [(a, m[:, 0], m[:, 2]), (b, m[:, 1], m[:, 0]), (c, m[:, 2], m[:, 1]), (m[:, 0], m[:, 1], m[:, 2])]
    return np.concatenate([vertices, middles]), np.concatenate([np.stack(part, axis=1) for part in parts])
