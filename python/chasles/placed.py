"""Bodies at rest with their boxes, and the pairs of them that can be nearest."""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, Motion, Polyhedron, Scene

_LARGEST = 1e30  # margin
Candidate = tuple[float, str, str, "Placed", "Placed"]


class Placed:
    """A body at a pose in the world."""

    def __init__(self, shape: Polyhedron, pose: npt.NDArray[np.float64]):
        self.shape, self.pose = shape, pose
        self.matrix = np.asarray(Motion.at_rest(pose).pose_at(0.0))
        points = shape.vertices @ self.matrix[:3, :3].T + self.matrix[:3, 3]
        self.low, self.high = points.min(axis=0), points.max(axis=0)

    @cached_property
    def _outlines(self) -> list[tuple[int, ...]]:
        return self.shape.faces

    def normal_of(self, face: int) -> npt.NDArray[np.float64]:
        """The unit normal of a face of the input mesh, in the world; zeros for a face without area."""
        outline = self._outlines[int(np.flatnonzero(self.shape.source_faces == face)[0])]
        corners = self.shape.vertices[list(outline)]
        sides = corners - corners[0]
        normal = self.matrix[:3, :3] @ np.cross(sides, np.roll(sides, -1, axis=0)).sum(axis=0)
        length = float(np.linalg.norm(normal))
        return normal / length if length > 0 else np.zeros(3)

    def face_with(self, kind: str, feature: tuple[int, ...]) -> int:
        """The face, or a face that has the vertex or both vertices of the edge, as numbered in the input mesh."""
        if kind == "face":
            return feature[0]
        found = next(i for i, outline in enumerate(self._outlines) if set(feature) <= set(outline))
        return int(self.shape.source_faces[found])


def _box_distances(
    low: npt.NDArray[np.float64],
    high: npt.NDArray[np.float64],
    other_low: npt.NDArray[np.float64],
    other_high: npt.NDArray[np.float64],
) -> npt.NDArray[np.float64]:
    """Lower bounds: the distances of boxes, less what rounding may have added."""
    gap = np.maximum(np.maximum(other_low - high, low - other_high), 0)
    size = np.maximum(np.abs([low, high]).max(), np.abs([other_low, other_high]).max())
    return np.maximum(np.linalg.norm(gap, axis=-1) - 1e-12 * size, 0)


def candidates_of_one(bodies: Mapping[str, Placed], name: str, one: Placed) -> Iterator[Candidate]:
    """One body with each of the others, the nearest boxes first."""
    if not bodies:
        return
    names, placed = list(bodies), list(bodies.values())
    bounds = _box_distances(np.array([p.low for p in placed]), np.array([p.high for p in placed]), one.low, one.high)
    for k in np.argsort(bounds, kind="stable"):
        yield float(bounds[k]), names[k], name, placed[k], one


def candidates_of_two(first: Mapping[str, Placed], second: Mapping[str, Placed]) -> Iterator[Candidate]:
    """The pairs of two groups that can be nearest, the nearest boxes first."""
    if first and second:
        scene, bodies = scene_of([first, second])
        one, other = next(iter(first.values())), next(iter(second.values()))
        bound = min(_farthest([one], list(second.values())), _farthest(list(first.values()), [other]))
        for pair in _nearest_pairs(scene, bound):
            a, b = (bodies[name] for name in pair)
            yield float(_box_distances(a.low, a.high, b.low, b.high)), pair[0][1:], pair[1][1:], a, b


def candidates_of_all(bodies: Mapping[str, Placed]) -> Iterator[Candidate]:
    """The pairs that can be nearest, the nearest boxes first."""
    if len(bodies) > 1:
        scene = Scene()
        for name, body in bodies.items():
            scene.add(name, body.shape, body.pose)
        for pair in _nearest_pairs(scene, _some_distance(list(bodies.values()))):
            a, b = (bodies[name] for name in pair)
            yield float(_box_distances(a.low, a.high, b.low, b.high)), *pair, a, b


def scene_of(groups: Sequence[Mapping[str, Placed]]) -> tuple[Scene, dict[str, Placed]]:
    """A scene in which the bodies of a group are not tested in pairs. A name begins with the number of the group."""
    scene = Scene()
    bodies: dict[str, Placed] = {}
    for group, placed in enumerate(groups):
        scene.ignore_groups(str(group), str(group))
        for name, body in placed.items():
            bodies[scene.add(f"{group}{name}", body.shape, body.pose, group=str(group))] = body
    return scene, bodies


def _nearest_pairs(scene: Scene, bound: float) -> list[tuple[str, str]]:
    """The pairs within a distance that has one: a thousandth of the bound at first, which some pair is known to have."""
    for distance in bound * 4.0 ** np.arange(-5, 1):
        found = scene.all_contacts(until=0, margin=min(float(distance) * (1 + 1e-9), _LARGEST))
        if found:
            return [tuple(sorted(contact.pair)) for contact in found]  # type: ignore[type-var, misc]
    raise InvalidInput(f"distance: all objects are farther apart than {_LARGEST:g}")


def _farthest(first: list[Placed], second: list[Placed]) -> float:
    """An upper bound of the least distance: the boxes of a pair have no points farther apart."""
    high = np.maximum([b.high for b in first], [b.high for b in second])
    low = np.minimum([b.low for b in first], [b.low for b in second])
    return float(np.linalg.norm(high - low, axis=1).min())


def _some_distance(bodies: list[Placed]) -> float:
    """Likewise, of bodies next to each other in one direction."""
    middles = np.array([body.low + body.high for body in bodies])
    orders = [[bodies[i] for i in np.argsort(middles[:, axis])] for axis in range(3)]
    return min(_farthest(order[1:], order[:-1]) for order in orders)
