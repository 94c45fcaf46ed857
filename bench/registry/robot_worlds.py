"""Robots and worlds for Chasles and for peers alike: planning problems of MotionBenchMaker, and boxes around an ABB.

Everybody gets equal shapes: boxes, and cylinders as prisms whose sides are tangent to them (as in
tests/data/planning_scenes.cpp). Vertices of prisms are rounded to floats first, because the peers read by Assimp, which keeps no others.
"""

import dataclasses
import math
import os
import pathlib
import tempfile
import xml.etree.ElementTree as xml

import numpy as np
import yaml

import chasles

DATA = pathlib.Path(os.environ.get("CHASLES_DATA_DIR", pathlib.Path(__file__).parents[2] / "shared" / "data"))


@dataclasses.dataclass
class Obstacle:
    name: str
    pose: np.ndarray  # (4, 4)
    sizes: tuple[float, ...]  # of a box: three lengths; of a cylinder: height and radius

    @property
    def is_box(self) -> bool:
        return len(self.sizes) == 3


@dataclasses.dataclass
class World:
    name: str
    robot: "RobotFiles"
    obstacles: list[Obstacle]
    start: np.ndarray | None = None
    goal: np.ndarray | None = None

    cylinders_inside: bool = False  # prisms inside of cylinders: what touches them touches the cylinders

    def scene(self) -> chasles.Scene:
        scene = chasles.Scene()
        for obstacle in self.obstacles:
            scene.add(obstacle.name, chasles.Polyhedron(*self.mesh(obstacle)), obstacle.pose)
        return scene


    def mesh(self, obstacle: Obstacle) -> tuple[np.ndarray, list[list[int]]]:
        return box(obstacle.sizes) if obstacle.is_box else prism(*obstacle.sizes, self.cylinders_inside)


@dataclasses.dataclass
class RobotFiles:
    name: str
    urdf: pathlib.Path
    srdf: pathlib.Path
    package: str  # how names of meshes begin
    meshes: pathlib.Path  # where that is

    def load(self) -> chasles.Robot:
        return chasles.Robot.load(self.urdf, srdf=self.srdf)

    def mesh_file(self, name: str) -> pathlib.Path:
        return self.meshes / name.removeprefix(self.package)


PANDA = RobotFiles(
    "panda", DATA / "robots/panda/panda.urdf", DATA / "robots/panda/panda.srdf", "package://", DATA / "robots/panda"
)
ABB_FOLDER = DATA / "robots/abb_irb2400"
ABB = RobotFiles(
    "irb2400",
    ABB_FOLDER / "abb_irb2400.urdf",
    ABB_FOLDER / "abb_irb2400.srdf",
    "package://tesseract/support/",
    ABB_FOLDER,
)


def prism(height: float, radius: float, is_inside: bool) -> tuple[np.ndarray, list[list[int]]]:
    """A prism around a cylinder along z, by a hundredth of the radius too thick at most, or inside of it."""
    sides = math.ceil(math.pi / math.acos(1 / 1.01))
    angles = 2 * math.pi * np.arange(sides) / sides
    ring = radius / (1 if is_inside else math.cos(math.pi / sides)) * np.column_stack([np.cos(angles), np.sin(angles)])
    bottom, top = (np.column_stack([ring, np.full(sides, z)]) for z in (-height / 2, height / 2))
    walls = [[i, (i + 1) % sides, sides + (i + 1) % sides, sides + i] for i in range(sides)]
    vertices = np.vstack([bottom, top]).astype(np.float32).astype(float)
    return vertices, triangles([*walls, list(range(sides))[::-1], list(range(sides, 2 * sides))])


def box(sizes: tuple[float, ...]) -> tuple[np.ndarray, list[list[int]]]:
    corners = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)])
    faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return corners * sizes, faces


def triangles(faces: list[list[int]]) -> list[list[int]]:
    return [[face[0], face[i], face[i + 1]] for face in faces for i in range(1, len(face) - 1)]


def pose_of(node: dict) -> np.ndarray:
    x, y, z, w = np.array(node["orientation"]) / np.linalg.norm(node["orientation"])
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, 3] = node["position"]
    return pose


def problem_names() -> list[str]:
    """All 400, sorted: "box/0001", for example."""
    files = (PANDA.urdf.parent / "mbm-problems").glob("*/scene*.yaml")
    return sorted(f"{file.parent.name}/{file.stem[5:]}" for file in files)


def problem(name: str) -> World:
    kind, number = name.split("/")
    folder = PANDA.urdf.parent / "mbm-problems" / kind
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    scene, request = (
        yaml.load((folder / f"{part}{number}.yaml").read_text(), loader) for part in ("scene", "request")
    )
    obstacles = [
        Obstacle(f"{found['id']}/{i}", pose_of(pose), tuple(primitive["dimensions"]))
        for found in scene["world"]["collision_objects"]
        for i, (primitive, pose) in enumerate(zip(found["primitives"], found["primitive_poses"], strict=True))
    ]
    state = request["start_state"]["joint_state"]
    start = dict(zip(state["name"], state["position"], strict=True))
    goal = {c["joint_name"]: c["position"] for c in request["goal_constraints"][0]["joint_constraints"]}
    joints = [f"panda_joint{i}" for i in range(1, 8)]
    return World(name, PANDA, obstacles, *(np.array([values[j] for j in joints]) for values in (start, goal)))


def boxes_around_abb(seed: int) -> World:
    """Twelve boxes, 0.8 to 2 m away from the axis of the first joint."""
    random = np.random.default_rng(seed)
    obstacles = []
    for i in range(12):
        angle, way = random.uniform(0, 2 * math.pi), random.uniform(0.8, 2.0)
        node = {
            "position": [way * math.cos(angle), way * math.sin(angle), random.uniform(0, 2)],
            "orientation": random.normal(size=4),
        }
        obstacles.append(Obstacle(f"box{i}", pose_of(node), tuple(random.uniform(0.1, 0.5, 3))))
    return World(f"boxes {seed}", ABB, obstacles)


def angles_of(rotation: np.ndarray) -> tuple[float, float, float]:
    """Roll, pitch and yaw, as URDF has them: turns about the fixed x, y and z."""
    pitch = math.atan2(-rotation[2, 0], math.hypot(rotation[0, 0], rotation[1, 0]))
    roll = math.atan2(rotation[2, 1], rotation[2, 2])
    return roll, pitch, math.atan2(rotation[1, 0], rotation[0, 0])


def write_obj(file: pathlib.Path, vertices: np.ndarray, faces: list[list[int]]) -> None:
    lines = ["v {!r} {!r} {!r}".format(*map(float, vertex)) for vertex in vertices]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    file.write_text("\n".join(lines) + "\n")


def urdf_with_world(world: World) -> pathlib.Path:
    """The robot's URDF file with the obstacles as links that are fixed to its root link, in a new folder.

    All meshes are written anew, with one object a file: Coal's loader mixes up the vertices of the Panda's link6.obj,
    which has several.
    """
    folder = pathlib.Path(tempfile.mkdtemp(prefix="chasles-bench-"))
    root = xml.fromstring(world.robot.urdf.read_text())
    children = {joint.find("child").get("link") for joint in root.iter("joint") if joint.find("child") is not None}
    base = next(link.get("name") for link in root.findall("link") if link.get("name") not in children)
    for visual in [(link, v) for link in root.findall("link") for v in link.findall("visual")]:
        visual[0].remove(visual[1])
    for i, element in enumerate(root.findall("link/collision/geometry/mesh")):
        shape = chasles.load(world.robot.mesh_file(element.get("filename")))
        write_obj(folder / f"link{i}.obj", shape.vertices, triangles(shape.faces))
        element.set("filename", str(folder / f"link{i}.obj"))
    for i, obstacle in enumerate(world.obstacles):
        link = xml.SubElement(root, "link", name=f"obstacle{i}")
        geometry = xml.SubElement(xml.SubElement(link, "collision"), "geometry")
        if obstacle.is_box:
            xml.SubElement(geometry, "box", size=" ".join(map(repr, map(float, obstacle.sizes))))
        else:
            write_obj(folder / f"{i}.obj", *world.mesh(obstacle))
            xml.SubElement(geometry, "mesh", filename=str(folder / f"{i}.obj"))
        joint = xml.SubElement(root, "joint", name=f"obstacle{i}_joint", type="fixed")
        xml.SubElement(joint, "parent", link=base)
        xml.SubElement(joint, "child", link=f"obstacle{i}")
        pose = obstacle.pose
        xml.SubElement(
            joint,
            "origin",
            xyz=" ".join(map(repr, map(float, pose[:3, 3]))),
            rpy=" ".join(map(repr, map(float, angles_of(pose[:3, :3])))),
        )
    file = folder / "robot.urdf"
    xml.ElementTree(root).write(file)
    return file
