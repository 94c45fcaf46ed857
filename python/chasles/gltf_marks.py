"""Answers written into a copy of a file of glTF, for `chasles.gltf.mark`."""

from __future__ import annotations

import contextlib
import copy
import os
import pathlib
import urllib.parse
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput
from .gltf_answer import AnimationContact
from .gltf_file import Document, Json, is_index
from .program import beside
from .gltf_tree import roots_of

Array = npt.NDArray[np.float64]

PART_OF_SCENE = 0.05  # the length of an arrow
FLOAT, UINT16, VERTICES, INDICES = 5126, 5123, 34962, 34963
MATERIAL = {
    "name": "chasles contact",
    "pbrMetallicRoughness": {"baseColorFactor": [0.85, 0.1, 0.1, 1], "metallicFactor": 0, "roughnessFactor": 1},
    "emissiveFactor": [0.5, 0, 0],
}


def write_marked(
    document: Document, answers: list[AnimationContact], out: pathlib.Path, size: float | None
) -> pathlib.Path:
    """See `chasles.gltf.mark`."""
    if out.suffix.lower() != ".glb":
        raise InvalidInput(f"{out}: must end in .glb")
    if size is not None and not 0 < size < 1e30:
        raise InvalidInput("size: must be above 0")
    names = {index: item.get("name") for index, item in enumerate(document.items("animations"))}
    for answer in answers:
        if any(index not in names or names[index] not in (None, "", name) for index, name in answer.animations.items()):
            raise document.fault("is another file than that of the answer: it lacks an animation of the answer")
    marked = [answer for answer in answers if answer.pair is not None and _points_of(answer)]
    writer = Writer(document, out)
    if marked:
        mesh = writer.add_marker(marked[0].scene_size * PART_OF_SCENE if size is None else size)
        for answer in marked:
            writer.add_answer(answer, mesh)
    writer.note([answer.as_json() for answer in answers])
    with beside(out, document.files) as file:
        file.write_bytes(document.as_glb(writer.json, writer.more))
    return out


class Writer:
    """Adds to a copy of the JSON, and to bytes behind the buffers of the file."""

    def __init__(self, document: Document, out: pathlib.Path):
        self.json: Json = copy.deepcopy(document.json)
        self.more = b""
        self._start = len(document.binary)
        for kind in ("scenes", "animations"):
            document.items(kind)  # refuses what is no list of objects
        _remove(self.json, document.markers)
        for image in self.json.get("images", []):
            _move(image, document.path.parent, out.parent)
        if not self.json.get("scenes"):  # as it is read
            self.json |= {"scene": 0, "scenes": [{"nodes": roots_of(document)}]}

    def add_marker(self, size: float) -> int:
        """A mesh: a ball, and an arrow of this length along z."""
        points, normals = marker_triangles(size)
        attributes = {
            "POSITION": self._accessor(points.astype("<f4"), "VEC3", FLOAT, VERTICES, has_bounds=True),
            "NORMAL": self._accessor(normals.astype("<f4"), "VEC3", FLOAT, VERTICES),
        }
        indices = self._accessor(np.arange(len(points), dtype="<u2"), "SCALAR", UINT16, INDICES)
        material = self._append("materials", MATERIAL)
        primitive = {"attributes": attributes, "indices": indices, "material": material}
        return self._append("meshes", {"name": "chasles contact", "primitives": [primitive]})

    def add_answer(self, answer: AnimationContact, mesh: int) -> None:
        """A node for each point of contact, which appears at the time of the contact."""
        pair = " on ".join(answer.pair or ())
        nodes = []
        for number, (point, normal) in enumerate(_points_of(answer)):
            name = f"contact {pair} at {answer.time:.6g} s" + (f" ({number + 1})" if number else "")
            node = {"name": name, "mesh": mesh, "translation": point.tolist(), "rotation": _turn_to(normal)}
            nodes.append(self._append("nodes", {**node, "extras": {"chasles": answer.event()}}))
        self.json["scenes"][self.json.get("scene", 0)].setdefault("nodes", []).extend(nodes)
        if answer.time > 0 and answer.animations:
            self._appear(nodes, answer.time, min(answer.animations))

    def note(self, answers: list[Json]) -> None:
        """The answers as extras of the asset."""
        asset = self.json["asset"]
        extras = asset.get("extras", {})
        asset["extras"] = {**(extras if isinstance(extras, dict) else {"extras": extras}), "chasles": answers}

    def _appear(self, nodes: list[int], time: float, animation: int) -> None:
        """The scale of the nodes steps from 0 to 1."""
        stamp = np.float32(time)
        stamp = stamp if stamp > 0 else np.nextafter(np.float32(0), np.float32(1))
        times = self._accessor(np.array([0, stamp], "<f4"), "SCALAR", FLOAT, None, has_bounds=True)
        scales = self._accessor(np.array([[0, 0, 0], [1, 1, 1]], "<f4"), "VEC3", FLOAT, None)
        animated = self.json["animations"][animation]
        animated["samplers"].append({"input": times, "output": scales, "interpolation": "STEP"})
        for node in nodes:
            target = {"node": node, "path": "scale"}
            animated["channels"].append({"sampler": len(animated["samplers"]) - 1, "target": target})

    def _accessor(
        self, numbers: np.ndarray, kind: str, component: int, target: int | None, has_bounds: bool = False
    ) -> int:
        data = numbers.tobytes()
        view = {"buffer": 0, "byteOffset": self._start + len(self.more), "byteLength": len(data)}
        self.more += data + b"\0" * (-len(data) % 4)
        if target is not None:
            view["target"] = target
        accessor: Json = {
            "bufferView": self._append("bufferViews", view),
            "componentType": component,
            "count": len(numbers),
            "type": kind,
        }
        if has_bounds:
            rows = numbers.reshape(len(numbers), -1)
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        return self._append("accessors", accessor)

    def _append(self, kind: str, item: Json) -> int:
        items = self.json.setdefault(kind, [])
        items.append(item)
        return len(items) - 1


def _remove(json: Json, markers: frozenset[int]) -> None:
    """Takes markers out. Other nodes keep their numbers, so a marker before one of them stays as an empty node."""
    if not markers:
        return

    def is_marker(node: Any) -> bool:
        return is_index(node) and node in markers

    for item, key in [(scene, "nodes") for scene in json.get("scenes", [])] + [
        (node, "children") for node in json["nodes"]
    ]:
        if isinstance(item.get(key), list) and any(map(is_marker, item[key])):
            item[key] = [node for node in item[key] if not is_marker(node)]
            if not item[key]:
                del item[key]  # the schema has no empty lists
    for animation in json.get("animations", []):
        if isinstance(animation.get("channels"), list):
            animation["channels"] = [one for one in animation["channels"] if not is_marker(_target_of(one))]
    for index in markers:
        json["nodes"][index] = {}
    while len(json["nodes"]) - 1 in markers:
        json["nodes"].pop()


def _target_of(channel: Any) -> Any:
    target = channel.get("target") if isinstance(channel, dict) else None
    return target.get("node") if isinstance(target, dict) else None


def _move(image: Json, old: pathlib.Path, new: pathlib.Path) -> None:
    """An image beside the file, as seen from the folder of the new file."""
    uri = image.get("uri")
    if not isinstance(uri, str) or uri.startswith("data:") or "://" in uri[:40]:
        return
    with contextlib.suppress(ValueError):  # another drive
        moved = os.path.relpath(old / urllib.parse.unquote(uri), new)
        image["uri"] = urllib.parse.quote(pathlib.PurePath(moved).as_posix())


def marker_triangles(size: float) -> tuple[Array, Array]:
    """Corners (n, 3) of triangles and their normals: an octahedron at the origin, and an arrow from it to (0, 0, size)."""
    ring = np.array([[np.cos(a), np.sin(a), 0] for a in np.arange(8) * np.pi / 4])
    up = np.array([0.0, 0.0, 1.0])
    ball, shaft, head = 0.12, 0.04, 0.12
    triangles = []
    for a, b in zip(ring, np.roll(ring, -1, axis=0)):
        triangles += [[ball * a, ball * b, ball * up], [ball * b, ball * a, -ball * up]]
        low, high = [shaft * a, shaft * b], [shaft * a + 0.7 * up, shaft * b + 0.7 * up]
        triangles += [[low[0], low[1], high[1]], [low[0], high[1], high[0]]]
        rim = [head * a + 0.7 * up, head * b + 0.7 * up]
        triangles += [[rim[0], rim[1], up], [rim[1], rim[0], 0.7 * up]]
    corners = np.array(triangles)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return size * corners.reshape(-1, 3), np.repeat(normals, 3, axis=0)


def _points_of(answer: AnimationContact) -> list[tuple[Array, Array]]:
    """Points and normals; where bodies pass through each other or one is inside, a point and the direction z."""
    if answer.contacts:
        return [(contact.point, contact.normal) for contact in answer.contacts]
    points = [point for point in (answer.overlap_point, answer.inside_point) if point is not None]
    return [(point, np.array([0.0, 0.0, 1.0])) for point in points[:1]]


def _turn_to(normal: Array) -> list[float]:
    """The shortest turn from z to the normal, x y z w."""
    x, y, z = (float(part) for part in normal)
    if z < -1 + 1e-12:
        return [1.0, 0.0, 0.0, 0.0]
    turn = np.array([-y, x, 0.0, 1 + z])
    return (turn / np.linalg.norm(turn)).tolist()
