"""The surface of a round body as polygons, for plot: balls around vertices, tubes along edges, and faces moved out."""

from __future__ import annotations

import math
from collections import defaultdict

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Ids = npt.NDArray[np.int64]
Mask = npt.NDArray[np.bool_]
Outlines = list[tuple[int, ...]]

SIDES = (24, 16, 12, 8, 6, 4)  # of a ball or a tube, the most that fit


def round_polygons(vertices: Array, outlines: Outlines, radius: float, most: int, *, is_solid: bool) -> list[Array]:
    """The surface at `radius` from the outlines, in at most `most` polygons where the faces leave room for others.

    Polygons inside of the body are left out, because matplotlib would draw some of them in front. Of too many vertices
    only some have balls, and then no edge has a tube. The faces of a solid body move outwards only.
    """
    surface = _Surface(vertices, outlines, radius, is_solid=is_solid)
    corners, edges = len(surface.corners), len(surface.edges)
    moved = surface.moved_faces()
    left = max(most - len(moved), 1)
    fitting = [n for n in SIDES if corners * n * n // 2 + edges * n <= left]
    if fitting:
        return moved + surface.balls(surface.corners, fitting[0]) + surface.tubes(fitting[0])
    count = max(1, min(corners, int(2 * left / SIDES[-1] ** 2)))
    some = np.random.default_rng(1).permutation(surface.corners)[:count]  # every n-th one would be stripes
    return moved + surface.balls(some, SIDES[-1])


class _Surface:
    def __init__(self, vertices: Array, outlines: Outlines, radius: float, *, is_solid: bool):
        self.vertices, self.radius, self.is_solid = vertices, radius, is_solid
        self.flat = [outline for outline in outlines if len(set(outline)) > 2]
        self.corners = np.unique(np.concatenate([np.asarray(outline) for outline in outlines]))
        pairs = {_in_order(*side) for outline in outlines for side in _sides(outline)}
        self.edges: list[tuple[int, int]] = sorted((a, b) for a, b in pairs if a != b)
        self.normals = [_normal(vertices[list(outline)]) for outline in self.flat]

    def balls(self, corners: Ids, sides: int) -> list[Array]:
        directions, quads = _ball(sides)
        is_hidden = np.zeros((len(corners), len(quads)), bool)
        inwards, outwards, is_reflex = self._around_vertices()
        for k, vertex in enumerate(corners.tolist()):
            is_hidden[k] = is_reflex[vertex] or self._hidden(directions[quads], inwards[vertex], outwards[vertex])
        points = self.vertices[corners][:, None] + self.radius * directions
        return list(points[:, quads][~is_hidden])

    def tubes(self, sides: int) -> list[Array]:
        inwards: dict[tuple[int, int], list[Array]] = defaultdict(list)
        outwards: dict[tuple[int, int], list[Array]] = defaultdict(list)
        for outline, normal in zip(self.flat, self.normals, strict=True):
            for a, b in _sides(outline):
                inwards[_in_order(a, b)].append(np.cross(normal, self.vertices[b] - self.vertices[a]))
                outwards[_in_order(a, b)].append(normal)
        polygons: list[Array] = []
        for edge in self.edges:
            start, end = self.vertices[list(edge)]
            ring = _circle(sides) @ _across(end - start)
            directions = np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)
            strips = start + self.radius * directions[~self._hidden(directions, inwards[edge], outwards[edge])]
            polygons += list(np.concatenate([strips, strips[:, ::-1] + (end - start)], axis=1))
        return polygons

    def moved_faces(self) -> list[Array]:
        polygons = []
        for outline, normal in zip(self.flat, self.normals, strict=True):
            corners = self.vertices[list(outline)]
            polygons.append(corners + self.radius * normal)
            if not self.is_solid:
                polygons.append(corners[::-1] - self.radius * normal)
        return polygons

    def _around_vertices(self) -> tuple[dict[int, list[Array]], dict[int, list[Array]], dict[int, bool]]:
        """For each vertex its edges, the normals of its faces, and whether a face has more than half a turn there."""
        inwards: dict[int, list[Array]] = defaultdict(list)
        outwards: dict[int, list[Array]] = defaultdict(list)
        is_reflex: dict[int, bool] = defaultdict(bool)
        for a, b in self.edges:
            inwards[a].append(self.vertices[b] - self.vertices[a])
            inwards[b].append(self.vertices[a] - self.vertices[b])
        for outline, normal in zip(self.flat, self.normals, strict=True):
            for (a, b), (_, c) in zip(_sides(outline), _sides((*outline[1:], outline[0])), strict=True):
                outwards[b].append(normal)
                turn = np.cross(self.vertices[b] - self.vertices[a], self.vertices[c] - self.vertices[b])
                is_reflex[b] |= bool(turn @ normal < 0)
        return inwards, outwards, is_reflex

    def _hidden(self, directions: Array, inwards: list[Array], outwards: list[Array]) -> Mask:
        """Which polygons of directions lean towards an edge or a face of their place, or into a solid body."""
        leaning = np.zeros(directions.shape[:2], bool)
        is_hidden = np.zeros(len(directions), bool)
        for way in inwards:
            along, least = directions @ way, 1e-9 * np.abs(way).max()
            leaning |= along > least
            is_hidden |= (along > -least).all(axis=1)
        if self.is_solid and outwards:
            leaning |= (directions @ np.stack(outwards, axis=1) < 1e-9).all(axis=2)
        return is_hidden | leaning.all(axis=1)


def _sides(outline: tuple[int, ...]) -> list[tuple[int, int]]:
    return list(zip(outline, (*outline[1:], outline[0]), strict=True))


def _in_order(a: int, b: int) -> tuple[int, int]:
    return (a, b) if a < b else (b, a)


def _normal(corners: Array) -> Array:
    total: Array = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
    length = np.linalg.norm(total)
    return total / length if length > 0 else total


def _circle(sides: int) -> Array:
    angles = 2 * math.pi * np.arange(sides) / sides
    return np.column_stack([np.cos(angles), np.sin(angles)])


def _across(axis: Array) -> Array:
    """Two unit vectors across the axis, which turn about it."""
    first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(axis, first) / np.linalg.norm(axis)])


def _ball(sides: int) -> tuple[Array, Ids]:
    """Unit vectors, and quadrilaterals of them from pole to pole."""
    polar = math.pi * np.arange(sides // 2 + 1) / (sides // 2)
    across = np.sin(polar)[:, None, None] * _circle(sides)
    along = np.repeat(np.cos(polar)[:, None, None], sides, axis=1)
    ring, side = (index.reshape(-1) for index in np.meshgrid(range(sides // 2), range(sides), indexing="ij"))
    following = (side + 1) % sides
    quads = np.stack([ring, ring + 1, ring + 1, ring], axis=1) * sides
    quads += np.stack([side, side, following, following], axis=1)
    return np.concatenate([across, along], axis=2).reshape(-1, 3), quads
