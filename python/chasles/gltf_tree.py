"""The nodes of a file of glTF: who hangs on whom, which of them carry bodies, and what moves with which node."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, Motion
from .gltf_file import LARGEST, Document, Json
from .gltf_tracks import NO_TURN, Track, Tracks, Value, moved

Array = npt.NDArray[np.float64]

MOST_NODES = 1_000_000
MOST_DEEP = 1_000  # nodes above a node
MOST_SKEW = 1e-5  # of what should be rigid: an entry of R^T R - I above a node that moves, or a change of a scale
ROUNDING = 1e-14  # of the same in double
MOST_SHOWN = 10  # names in a message
STATIC = -1


@dataclass
class Carrier:
    """A node that carries a mesh."""

    node: int
    name: str
    mover: int  #: the nearest node above it (or itself) that moves, or STATIC
    to_mover: Array  #: (4, 4), from the mesh to the rigid frame of the mover; to the scene if STATIC


@dataclass
class Step:
    """A node that moves, on the way from the root to another one: a pose that stays, and then a motion."""

    node: int
    before: Array  #: (4, 4)
    shift: Value
    turn: Value
    linear: Array  #: (3, 3), by which the shift is multiplied


class Tree:
    """The scene of a file: nodes in the order in which they are met from the roots down."""

    def __init__(self, document: Document, tracks: Tracks):
        self._document, self._tracks = document, tracks
        self.nodes = document.items("nodes")
        self.parent: dict[int, int] = {}
        self.order = self._walk(roots_of(document))
        self._locals: dict[int, Array] = {}
        animated = {node for node, _ in tracks.of_node} | tracks.morphed
        outside = sorted(animated - set(self.order))
        if outside:
            shown = ", ".join(map(self.label, outside[:MOST_SHOWN])) + (", ..." if len(outside) > MOST_SHOWN else "")
            self._warn(f"animated, but outside of the scene, and ignored: {shown}")

    def chain(self, node: int) -> list[int]:
        """From the root to the node."""
        found = [node]
        while found[-1] in self.parent:
            found.append(self.parent[found[-1]])
        return found[::-1]

    def carriers(self, leave_out: Collection[str]) -> list[Carrier]:
        """All nodes with faces, named as `chasles.load_parts` does."""
        with_faces = [index for index in self.order if "mesh" in self.nodes[index] and self._has_faces(index)]
        names = self._names(with_faces)
        unknown = [name for name in leave_out if name not in names.values()]
        if unknown:
            raise self._document.fault(
                f"leave_out: no node with faces has the name {unknown[0]!r}; there are {_listed(names.values())}"
            )
        markers = [names[index] for index in with_faces if index in self._document.markers]
        if markers:
            self._warn(f"left out, as markers of a former answer (chasles.gltf.mark): {_listed(markers)}")
        left_out = {*leave_out, *markers}
        kept = [index for index in with_faces if names[index] not in left_out]
        for index in kept:
            self._refuse_deformed(index, names[index])
        return [self._carrier(index, names[index]) for index in kept]

    def motion(self, mover: int, since: float) -> Motion:
        """The rigid motion of the frame of a node, over the whole duration. Steps are as from the time `since` on."""
        result: Motion | None = None
        for step in self._steps(mover)[0]:
            try:
                factor = moved(step.shift, step.turn, since, self._tracks.duration, step.linear)
            except InvalidInput as error:
                raise self._document.fault(f"{self.label(step.node)}: {error}") from None
            if not np.array_equal(step.before, np.eye(4)):
                factor = Motion.at_rest(step.before) * factor
            result = factor if result is None else result * factor
        assert result is not None
        return result

    def jumps(self, mover: int) -> set[float]:
        """The times at which the node or one above it jumps."""
        tracks = (
            self._tracks.of_node.get((node, path)) for node in self.chain(mover) for path in ("translation", "rotation")
        )
        return {float(time) for track in tracks if track is not None for time in track.jumps()}

    def _steps(self, mover: int) -> tuple[list[Step], Array]:
        """The nodes that move from the root to the mover, and what is left (3, 3) for the shape of a body: scales and turns that stay."""
        steps, still = [], np.eye(4)
        for node in self.chain(mover):
            if not self._tracks.moving(node):
                still = still @ self._local(node)
                continue
            shift = self._tracks.value(node, "translation", self._at_rest(node, "translation", [0, 0, 0]))
            turn = self._tracks.value(node, "rotation", self._at_rest(node, "rotation", [0, 0, 0, 1]))
            before, linear = np.eye(4), still[:3, :3]
            if isinstance(turn, Track):
                ratio, before = self._conformal(still, node)
                linear = left = ratio * np.eye(3)  # an even scale commutes with turns
            else:  # what does not turn carries any shape along
                before[:3, 3] = still[:3, 3]
                turn, left = NO_TURN, linear @ _pose_of(np.zeros(3), turn)[:3, :3]
            steps.append(Step(node, before, shift, turn, linear))
            still = np.eye(4)
            still[:3, :3] = left * self._scale(node)
        return steps, still

    def _carrier(self, index: int, name: str) -> Carrier:
        below = np.eye(4)
        chain = self.chain(index)
        while chain and not self._tracks.moving(chain[-1]):
            below = self._local(chain.pop()) @ below
        if not chain:
            return Carrier(index, name, STATIC, below)
        return Carrier(index, name, chain[-1], self._steps(chain[-1])[1] @ below)

    def _conformal(self, matrix: Array, node: int) -> tuple[float, Array]:
        """A matrix as a scale, negative for a mirror, times a pose."""
        linear = matrix[:3, :3]
        scale = float(np.cbrt(np.linalg.det(linear)))
        if scale == 0:
            raise self._document.fault(
                f"{self.label(node)}: a scale of 0 is above it, or its own; remove the node or scale it"
            )
        turn = linear / scale
        skew = float(np.abs(turn.T @ turn - np.eye(3)).max())
        if skew > MOST_SKEW:
            raise self._document.fault(
                f"{self.label(node)} turns below a scale that is not the same along all axes (off by {skew:.3g}), so what it carries "
                "would change its shape; apply the scale to the meshes"
            )
        if skew > ROUNDING:
            self._warn(
                f"{self.label(node)}: what is above it turns and scales evenly but for {skew:.2g}, which is left out"
            )
        left, _, right = np.linalg.svd(turn)
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = left @ right, matrix[:3, 3]
        return scale, pose

    def _local(self, node: int) -> Array:
        """The matrix of a node that does not move."""
        if node not in self._locals:
            self._locals[node] = self._matrix(node)
        return self._locals[node]

    def _matrix(self, node: int) -> Array:
        item = self.nodes[node]
        if "matrix" in item:
            matrix = self._numbers(item, "matrix", 16, node).reshape(4, 4).T
            if not np.array_equal(matrix[3], [0, 0, 0, 1]):
                raise self._document.fault(f"{self.label(node)}: matrix: the last row must be 0 0 0 1")
            return matrix
        shift = self._tracks.value(node, "translation", self._at_rest(node, "translation", [0, 0, 0]))
        turn = self._tracks.value(node, "rotation", self._at_rest(node, "rotation", [0, 0, 0, 1]))
        return _pose_of(np.asarray(shift), np.asarray(turn)) @ np.diag([*self._scale(node), 1.0])

    def _scale(self, node: int) -> Array:
        track = self._tracks.of_node.get((node, "scale"))
        if track is None:
            return self._at_rest(node, "scale", [1, 1, 1])
        if track.is_constant:
            return track.values[0]
        middle, spread = track.steady()
        if spread > MOST_SKEW:
            ends = f"from {track.values.min():.6g} to {track.values.max():.6g}"
            raise self._document.fault(
                f"{self.label(node)}: its scale is animated ({ends}): bodies are rigid; "
                "remove this channel, or leave out what the node carries"
            )
        self._warn(f"{self.label(node)}: its scale changes by {spread:.2g} of itself, and is taken as constant")
        return middle

    def _warn(self, text: str) -> None:
        if text not in self._tracks.warnings:
            self._tracks.warnings.append(text)

    def _at_rest(self, node: int, key: str, default: list[float]) -> Array:
        if key not in self.nodes[node]:
            return np.array(default, np.float64)
        found = self._numbers(self.nodes[node], key, len(default), node)
        if key == "rotation" and not 1e-3 < np.linalg.norm(found) < 1e3:
            raise self._document.fault(f"{self.label(node)}: rotation: is no unit quaternion")
        return found

    def _numbers(self, item: Json, key: str, count: int, node: int) -> Array:
        value = item[key]
        is_right = isinstance(value, list) and len(value) == count and all(isinstance(x, (int, float)) for x in value)
        if not is_right or not (np.abs(np.array(value, np.float64)) < LARGEST).all():
            raise self._document.fault(f"{self.label(node)}: {key}: must be {count} numbers below {LARGEST:g}")
        return np.array(value, np.float64)

    def label(self, node: int) -> str:
        """The node in messages."""
        name = self.nodes[node].get("name")
        return f"node {node}" + (f" ({name!r})" if isinstance(name, str) and name else "")

    def _walk(self, roots: list[int]) -> list[int]:
        order: list[int] = []
        seen = set(roots)
        if len(seen) < len(roots):
            raise self._document.fault("scene: a node is listed twice")
        if len(self.nodes) > MOST_NODES:
            raise self._document.fault(f"has more than {MOST_NODES} nodes")
        rest = [(root, 0) for root in roots[::-1]]
        while rest:
            node, depth = rest.pop()
            order.append(node)
            if depth > MOST_DEEP:
                raise self._document.fault(f"{self.label(node)} has more than {MOST_DEEP} nodes above it")
            children = _indices(self._document, self.nodes[node], "children", f"node {node}")
            for child in children:
                if child in seen:
                    raise self._document.fault(f"{self.label(child)} is below two nodes, or contains itself")
                seen.add(child)
                self.parent[child] = node
            rest += [(child, depth + 1) for child in children[::-1]]
        return order

    def _has_faces(self, index: int) -> bool:
        mesh = self._document.item("meshes", self.nodes[index]["mesh"], self.label(index))
        primitives = self._document.objects(mesh, "primitives", f"mesh {self.nodes[index]['mesh']}")
        return any(primitive.get("mode", 4) not in (0, 1, 2, 3) for primitive in primitives)

    def _refuse_deformed(self, index: int, name: str) -> None:
        if "skin" in self.nodes[index]:
            raise self._document.fault(
                f"node {name!r} has a skin, and deforms: bodies are rigid; leave it out ({name!r}), or export rigid parts"
            )
        if index in self._tracks.morphed:
            raise self._document.fault(
                f"node {name!r} is morphed (animated weights): bodies are rigid; leave it out ({name!r}), or export rigid parts"
            )
        for node in self.chain(index):
            self._scale(node)  # refuses one that is animated

    def _names(self, indices: list[int]) -> dict[int, str]:
        """Unique names: those of nodes, else of meshes, else of nodes above. Names of the file stay with their first owners."""
        given: dict[int, str] = {}
        own: dict[int, bool] = {}
        for index in indices:
            names = [
                self.nodes[index].get("name"),
                self._document.items("meshes")[int(self.nodes[index]["mesh"])].get("name"),
            ]
            above = [self.nodes[node].get("name") for node in self.chain(index)[-2::-1]]
            found = [" ".join(name.split()) for name in [*names, *above] if isinstance(name, str) and name.strip()]
            given[index] = found[0] if found else "part"
            own[index] = any(isinstance(name, str) and name.strip() for name in names)
        return _unique(given, sorted(indices, key=lambda index: not own[index]))


def roots_of(document: Document) -> list[int]:
    """The roots of the scene that the file names, else of its first scene, else all nodes that no node contains."""
    if document.items("scenes"):
        scene = document.item("scenes", document.json.get("scene", 0), "scene")
        return _indices(document, scene, "nodes", "scene")
    nodes = document.items("nodes")
    contained = {
        child for index, node in enumerate(nodes) for child in _indices(document, node, "children", f"node {index}")
    }
    return [index for index in range(len(nodes)) if index not in contained]


def _indices(document: Document, item: Json, key: str, where: str) -> list[int]:
    found = item.get(key, [])
    if not isinstance(found, list):
        raise document.fault(f"{where}: {key}: must be a list")
    for index in found:
        document.item("nodes", index, where)
    return [int(index) for index in found]


def _unique(given: dict[int, str], order: list[int]) -> dict[int, str]:
    taken, used = set(given.values()), set()
    numbers: dict[str, int] = {}
    result = {}
    for index in order:
        name = given[index]
        while name in used or (name != given[index] and name in taken):
            numbers[given[index]] = numbers.get(given[index], 1) + 1
            name = f"{given[index]}_{numbers[given[index]]}"
        used.add(name)
        result[index] = name
    return result


def _pose_of(shift: Array, turn: Array) -> Array:
    x, y, z, w = turn / np.linalg.norm(turn)
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, 3] = shift
    return pose


def _listed(names: Collection[str]) -> str:
    shown = sorted(names)[:MOST_SHOWN]
    return ", ".join(repr(name) for name in shown) + (", ..." if len(names) > len(shown) else "")
