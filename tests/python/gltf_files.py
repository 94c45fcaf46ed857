"""Small files of glTF, made here, and where their nodes are at a time: numpy and scipy alone, by appendix C of the specification."""

import json
import struct

import numpy as np
from cubes import CUBE_FACES, CUBE_VERTICES
from scipy.spatial.transform import Rotation

KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
CUBE_TRIANGLES = np.array([[face[0], face[i], face[i + 1]] for face in CUBE_FACES for i in (1, 2)])
CUBE = (np.array(CUBE_VERTICES, float) - 0.5, CUBE_TRIANGLES)


class Maker:
    """A file in the making. `json` may be changed by tests."""

    def __init__(self):
        self.binary = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}

    def add(self, kind, item):
        self.json.setdefault(kind, []).append(item)
        return len(self.json[kind]) - 1

    def accessor(self, numbers, component=5126, bounds=False, **more):
        numbers = np.asarray(numbers, {5126: "<f4", 5125: "<u4", 5122: "<i2", 5120: "i1"}[component])
        rows = numbers.reshape(len(numbers), -1)
        data = numbers.tobytes()
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data + b"\0" * (-len(data) % 4)
        item = {"bufferView": view, "componentType": component, "count": len(rows), "type": KINDS[rows.shape[1]]}
        if bounds:
            item |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        return self.add("accessors", item | more)

    def mesh(self, vertices=CUBE[0], triangles=CUBE[1], name=None):
        primitive = {
            "attributes": {"POSITION": self.accessor(vertices, bounds=True)},
            "indices": self.accessor(np.ravel(triangles), 5125),
        }
        return self.add("meshes", {"primitives": [primitive]} | ({"name": name} if name else {}))

    def node(self, name=None, parent=None, **item):
        index = self.add("nodes", item | ({"name": name} if name else {}))
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def animate(self, node, path, stamps, values, interpolation="LINEAR", animation=0):
        while len(self.json.get("animations", [])) <= animation:
            number = len(self.json.get("animations", []))
            self.add("animations", {"name": f"take {number}", "samplers": [], "channels": []})
        found = self.json["animations"][animation]
        times, outputs = self.accessor(stamps, bounds=True), self.accessor(values)
        found["samplers"].append({"input": times, "output": outputs, "interpolation": interpolation})
        found["channels"].append({"sampler": len(found["samplers"]) - 1, "target": {"node": node, "path": path}})

    def bytes(self):
        result = self.json | {"buffers": [{"byteLength": len(self.binary)}]}
        text = json.dumps(result).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
        chunks += struct.pack("<II", len(self.binary), 0x004E4942) + self.binary
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def write(self, path):
        path.write_bytes(self.bytes())
        return path


class Sampler:
    """The matrices of the nodes of a made file, by its own reading of the bytes."""

    def __init__(self, maker, animation=0):
        self.maker, self.nodes = maker, maker.json["nodes"]
        self.tracks = {}
        found = maker.json["animations"][animation]
        for channel in found["channels"]:
            sampler = found["samplers"][channel["sampler"]]
            key = channel["target"]["node"], channel["target"]["path"]
            self.tracks[key] = (
                *(self.numbers(sampler[name]) for name in ("input", "output")),
                sampler["interpolation"],
            )

    def numbers(self, index):
        item = self.maker.json["accessors"][index]
        view = self.maker.json["bufferViews"][item["bufferView"]]
        raw = self.maker.binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        return np.frombuffer(raw, "<f4").astype(float).reshape(item["count"], -1)

    def value(self, node, path, default, time):
        if (node, path) not in self.tracks:
            return np.array(self.nodes[node].get(path, default), float)
        stamps, values, interpolation = self.tracks[node, path]
        stamps = stamps[:, 0]
        cubic = interpolation == "CUBICSPLINE"
        keys = values[1::3] if cubic else values
        after = int(np.searchsorted(stamps, time, side="right"))
        if after == 0 or after == len(stamps):
            return keys[min(after, len(stamps) - 1)] if after == 0 else keys[-1]
        k, step = after - 1, stamps[after] - stamps[after - 1]
        t = (time - stamps[k]) / step
        if interpolation == "STEP":
            return keys[k]
        if cubic:
            m0, m1 = step * values[3 * k + 2], step * values[3 * k + 3]
            h = 2 * t**3 - 3 * t**2
            return (h + 1) * keys[k] + (t**3 - 2 * t**2 + t) * m0 - h * keys[k + 1] + (t**3 - t**2) * m1
        if path == "rotation":
            a, b = keys[k] / np.linalg.norm(keys[k]), keys[k + 1] / np.linalg.norm(keys[k + 1])
            b = b if a @ b >= 0 else -b
            angle = np.arccos(min(a @ b, 1.0))
            return a if angle < 1e-9 else (np.sin((1 - t) * angle) * a + np.sin(t * angle) * b) / np.sin(angle)
        return (1 - t) * keys[k] + t * keys[k + 1]

    def local(self, node, time):
        matrix = np.eye(4)
        if "matrix" in self.nodes[node]:
            return np.array(self.nodes[node]["matrix"], float).reshape(4, 4).T
        turn = Rotation.from_quat(self.value(node, "rotation", [0, 0, 0, 1], time)).as_matrix()
        matrix[:3, :3] = turn * self.value(node, "scale", [1, 1, 1], time)
        matrix[:3, 3] = self.value(node, "translation", [0, 0, 0], time)
        return matrix

    def world(self, time):
        """The matrix (4, 4) of each node in the scene."""
        result = {}

        def walk(node, above):
            result[node] = above @ self.local(node, time)
            for child in self.nodes[node].get("children", []):
                walk(child, result[node])

        for root in self.maker.json["scenes"][0]["nodes"]:
            walk(root, np.eye(4))
        return result


def random_quaternions(random, count, spread=0.5):
    """Random ways of turns, x y z w in single precision."""
    turns = [Rotation.random(random_state=random)]
    for _ in range(count - 1):
        turns.append(Rotation.from_rotvec(random.normal(scale=spread, size=3)) * turns[-1])
    signs = random.choice([-1, 1], size=(count, 1))
    return signs * np.array([turn.as_quat() for turn in turns])


def random_scene(random, bodies=6, kinds=("LINEAR", "STEP", "CUBICSPLINE"), spread=4.0, depth=3):
    """Cubes that hang on each other and move, each by a kind of interpolation of its own for places and turns; and a lift in a sheared shaft."""
    maker = Maker()
    mesh = maker.mesh()
    nodes = []
    for number in range(bodies):
        parent = int(random.choice(nodes)) if nodes and random.random() < 0.6 else None
        scale = float(random.uniform(0.6, 1.3)) * random.choice([1, 1, -1])
        shape = {"scale": [scale] * 3} if random.random() < 0.5 else {}
        node = maker.node(f"part {number}", parent, translation=random.normal(scale=spread, size=3).tolist(), **shape)
        maker.node(
            f"cube {number}",
            node,
            mesh=mesh,
            scale=random.uniform(0.5, 1.5, 3).tolist(),
            rotation=random_quaternions(random, 1)[0].tolist(),
        )
        nodes.append(node)
        for path, size in (("translation", 3), ("rotation", 4)):
            if random.random() < 0.75:
                add_random_track(random, maker, node, path, size, str(random.choice(kinds)), spread)
    # What does not turn may have any scale above it.
    uneven = {"scale": random.uniform(0.5, 1.5, 3).tolist(), "rotation": random_quaternions(random, 1)[0].tolist()}
    shaft = maker.node("shaft", maker.node("house", **uneven), **uneven)
    lift = maker.node(
        "lift", shaft, mesh=mesh, scale=[0.9, 1.2, 0.7], rotation=random_quaternions(random, 1)[0].tolist()
    )
    add_random_track(random, maker, lift, "translation", 3, kinds[0], spread)
    return maker


def add_random_track(random, maker, node, path, size, kind, spread):
    count = int(random.integers(2, 7))
    stamps = np.unique(np.round(random.uniform(0, 3, count), 3).astype(np.float32))
    values = (
        random.normal(scale=spread, size=(len(stamps), 3)) if size == 3 else random_quaternions(random, len(stamps))
    )
    if kind == "CUBICSPLINE":
        values = np.abs(values) if size == 4 else values
        tangents = random.normal(scale=spread if size == 3 else 0.3, size=(len(stamps), 2, size))
        values = np.stack([tangents[:, 0], values, tangents[:, 1]], axis=1).reshape(-1, size)
    maker.animate(node, path, stamps, values, kind)
