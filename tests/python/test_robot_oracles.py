"""Robots' files as Pinocchio, liburdfdom and yourdfpy read them: all robots of the wheel `example-robot-data`.

Pinocchio reads by liburdfdom, and its meshes by Assimp. yourdfpy and trimesh share no code with either.
"""

import importlib.metadata
import itertools
import os
import pathlib
import subprocess
import xml.etree.ElementTree as ET

import numpy as np
import pytest

import chasles


def files_of(package: str, ending: str) -> list[pathlib.Path]:
    """The files of an installed wheel; none if it is not installed."""
    try:
        files = importlib.metadata.files(package) or []
    except importlib.metadata.PackageNotFoundError:
        return []
    return sorted(pathlib.Path(str(f.locate())).resolve() for f in files if f.name.endswith(ending))


# Without any link: what xacro leaves of a file of macros.
EMPTY = "ur3.urdf"
URDFS = [f for f in files_of("example-robot-data", ".urdf") if f.name != EMPTY]
SRDFS = files_of("example-robot-data", ".srdf")
all_robots = pytest.mark.parametrize("urdf", URDFS, ids=lambda f: f.stem)
# Pinocchio takes a cylinder for a capsule where the file has its own <collision_checking>.
OF_PINOCCHIO = {"simple_humanoid"}


class File:
    """The joints of a URDF file, read by Python's own XML reader."""

    def __init__(self, urdf: pathlib.Path) -> None:
        self.root = ET.parse(urdf).getroot()
        self.joints = {j.attrib["name"]: j for j in self.root.findall("joint")}

    def follows(self, name: str) -> ET.Element | None:
        mimic = self.joints[name].find("mimic")
        return mimic if mimic is not None and mimic.attrib["joint"] in self.joints else None

    def value(self, name: str, values: dict[str, float]) -> float:
        mimic = self.follows(name)
        if mimic is None:
            return values[name]
        factor, offset = (float(mimic.get(key, default)) for key, default in (("multiplier", 1), ("offset", 0)))
        return factor * self.value(mimic.attrib["joint"], values) + offset


def configuration_of_pinocchio(model, file: File, values: dict[str, float]) -> np.ndarray:
    """Continuous joints have a cosine and a sine there; followers have values of their own."""
    q = np.zeros(model.nq)
    for name, joint in itertools.islice(zip(model.names, model.joints), 1, None):
        kind, i = file.joints[name].attrib["type"], joint.idx_q
        if kind == "floating":
            parts = ("trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w")
            q[i : i + 7] = [values[f"{name}/{part}"] for part in parts]
        elif kind == "planar":
            turn = values[f"{name}/theta"]
            q[i : i + 4] = values[f"{name}/x"], values[f"{name}/y"], np.cos(turn), np.sin(turn)
        elif joint.nq == 2:
            q[i : i + 2] = np.cos(file.value(name, values)), np.sin(file.value(name, values))
        else:
            q[i] = file.value(name, values)
    return q


def random_configuration(random: np.random.Generator, robot: chasles.Robot) -> np.ndarray:
    values = random.uniform(*np.clip(robot.limits, -3, 3).reshape(-1, 2).T)
    for i, name in enumerate(robot.variables):
        if name.endswith("/rot_x"):
            values[i : i + 4] /= np.linalg.norm(values[i : i + 4])
    return values


def check_link_poses(urdf: pathlib.Path, robot: chasles.Robot, count: int = 10) -> None:
    pinocchio = pytest.importorskip("pinocchio")
    file, model = File(urdf), pinocchio.buildModelFromUrdf(str(urdf))
    state, random = model.createData(), np.random.default_rng(5)
    assert {name.split("/")[0] for name in robot.variables} == {n for n in model.names[1:] if file.follows(n) is None}
    for _ in range(count):
        values = random_configuration(random, robot)
        q = configuration_of_pinocchio(model, file, dict(zip(robot.variables, values)))
        pinocchio.framesForwardKinematics(model, state, q)
        poses = robot.link_poses(values)
        expected = {
            link: state.oMf[model.getFrameId(link, pinocchio.FrameType.BODY)].homogeneous for link in robot.links
        }
        size = max(1.0, *(np.abs(pose[:3, 3]).max() for pose in expected.values()))
        assert max(np.abs(poses[link] - expected[link]).max() for link in robot.links) <= 1e-12 * size


def check_limits(urdf: pathlib.Path, robot: chasles.Robot) -> None:
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.buildModelFromUrdf(str(urdf))
    for name, limits in zip(robot.variables, robot.limits):
        if model.existJointName(name) and model.joints[model.getJointId(name)].nq == 1:
            i = model.joints[model.getJointId(name)].idx_q
            assert tuple(limits) == (model.lowerPositionLimit[i], model.upperPositionLimit[i]), name


def test_the_wheel_has_the_robots_of_the_issue():
    pytest.importorskip("pinocchio")
    if not URDFS:
        pytest.skip("no example-robot-data")
    assert len(URDFS) >= 41
    joints = [joint for f in URDFS for joint in File(f).joints.values()]
    assert {joint.attrib["type"] for joint in joints} >= {"fixed", "revolute", "continuous", "prismatic"}
    assert sum(joint.find("mimic") is not None for joint in joints) > 50


@all_robots
def test_links_stand_where_pinocchio_says(urdf):
    robot = chasles.Robot.load(urdf)
    check_link_poses(urdf, robot)
    check_limits(urdf, robot)


JOINTS = {
    "revolute": '<axis xyz="1 2 -2"/><limit lower="-2" upper="1" effort="1" velocity="1"/>',
    "continuous": '<axis xyz="0 3 4"/>',
    "prismatic": '<axis xyz="-5 0 1"/><limit lower="-2" upper="1" effort="1" velocity="1"/>',
    "planar": '<axis xyz="0 0 2"/>',  # Pinocchio has the plane of x and y for any axis
    "floating": "",
}


def test_all_joint_types_one_after_another(tmp_path):
    """Each type follows each other one, with fixed joints between, and joints that follow others."""
    types = [kind for pair in itertools.product(JOINTS, JOINTS) for kind in pair]
    text = '<robot name="all"><link name="link0"/>'
    for i, kind in enumerate(types):
        origin = f'<origin xyz="0.1 -0.2 {0.01 * i}" rpy="{0.1 * i} -0.5 {0.3 - 0.2 * i}"/>'
        text += f'<link name="link{i + 1}"/><joint name="joint{i}" type="{kind}"><parent link="link{i}"/>'
        text += f'<child link="link{i + 1}"/>{origin}{JOINTS[kind]}</joint>'
        follower = f'<mimic joint="joint{i}" multiplier="-0.5" offset="0.25"/>' if "a" not in kind and "g" not in kind else ""
        text += f'<link name="side{i}"/><joint name="follower{i}" type="revolute"><parent link="link{i}"/>'
        text += f'<child link="side{i}"/>{origin}{JOINTS["revolute"]}{follower}</joint>'
    urdf = tmp_path / "all.urdf"
    urdf.write_text(text + "</robot>")
    check_link_poses(urdf, chasles.Robot.load(urdf), 50)


def area_of(vertices: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def triangles_of(shape: chasles.Polyhedron) -> np.ndarray:
    faces = shape.faces
    if all(len(face) == 3 for face in faces):
        return np.array(faces)
    return np.array([[f[0], *f[i : i + 2]] for f in faces for i in range(1, len(f) - 1)])


@all_robots
def test_shapes_are_those_of_pinocchio(urdf):
    """Their number, places, and corners; for round bodies within the deviation that is stated."""
    pinocchio, coal = pytest.importorskip("pinocchio"), pytest.importorskip("coal")
    robot, model = chasles.Robot.load(urdf), pinocchio.buildModelFromUrdf(str(urdf))
    folders = [str(folder) for folder in urdf.parents if "cmeel.prefix" in str(folder)]
    geometry = pinocchio.buildGeomFromUrdf(model, str(urdf), pinocchio.COLLISION, package_dirs=folders)
    of_link: dict[str, list] = {}
    for thing in geometry.geometryObjects:
        of_link.setdefault(model.frames[thing.parentFrame].name, []).append(thing)
    for link in robot.links:
        ours, theirs = robot.collisions(link), of_link.get(link, [])
        assert len(ours) == len(theirs), link
        frame = model.frames[model.getFrameId(link, pinocchio.FrameType.BODY)].placement
        for (shape, pose, deviation), thing in zip(ours, theirs):
            assert np.abs((frame.inverse() * thing.placement).homogeneous - pose).max() <= 1e-12
            bounds = np.array([shape.vertices.min(0) - shape.radius, shape.vertices.max(0) + shape.radius])
            if isinstance(thing.geometry, coal.BVHModelBase):
                vertices = np.array(thing.geometry.vertices())
                expected = np.array([vertices.min(0), vertices.max(0)])
                assert np.abs(bounds - expected).max() <= 1e-6 * np.abs(expected).max(), link
            elif urdf.stem not in OF_PINOCCHIO:
                thing.geometry.computeLocalAABB()
                box = thing.geometry.aabb_local
                outside = np.array([box.min_ - bounds[0], bounds[1] - box.max_])
                assert outside.min() >= -1e-15 and outside.max() <= deviation * (1 + 1e-9) + 1e-15, link


def file_of(name: str, urdf: pathlib.Path) -> pathlib.Path:
    path = pathlib.PurePosixPath(name.split("://")[-1].lstrip("/"))
    return next(folder / path for folder in urdf.parents if (folder / path).is_file())


@all_robots
def test_meshes_are_those_of_yourdfpy(urdf):
    """Sizes and areas by trimesh; the scale and the place by yourdfpy."""
    yourdfpy, trimesh = pytest.importorskip("yourdfpy"), pytest.importorskip("trimesh")
    robot = chasles.Robot.load(urdf)
    theirs = yourdfpy.URDF.load(str(urdf), load_meshes=False, build_scene_graph=False)
    for link in robot.links:
        for (shape, pose, _), thing in zip(robot.collisions(link), theirs.link_map[link].collisions, strict=True):
            assert np.abs(pose - (np.eye(4) if thing.origin is None else thing.origin)).max() <= 1e-12
            if thing.geometry.mesh is None:
                continue
            scale = np.ones(3) if thing.geometry.mesh.scale is None else np.asarray(thing.geometry.mesh.scale)
            mesh = trimesh.load(file_of(thing.geometry.mesh.filename, urdf), force="mesh", process=False)
            vertices = mesh.vertices * scale
            bounds = np.array([vertices.min(0), vertices.max(0)])
            size = np.abs(bounds).max()
            assert np.abs(bounds - [shape.vertices.min(0), shape.vertices.max(0)]).max() <= 1e-6 * size, link
            ours, expected = area_of(shape.vertices, triangles_of(shape)), area_of(vertices, mesh.faces)
            assert ours == pytest.approx(expected, rel=1e-5, abs=1e-9 * size**2), link


def check_urdf(urdf: pathlib.Path) -> subprocess.CompletedProcess:
    """The program of liburdfdom."""
    programs = [f for f in files_of("cmeel-urdfdom", "check_urdf") if f.parent.name == "bin"]
    if not programs:
        pytest.skip("no cmeel-urdfdom")
    return subprocess.run([programs[0], urdf], capture_output=True, text=True, errors="replace", check=False)


@all_robots
def test_links_are_those_of_urdfdom(urdf):
    """It prints the tree: "root Link: base has 2 child(ren)", then "child(1):  arm" for each."""
    printed = check_urdf(urdf)
    assert printed.returncode == 0
    links = {line.split(": ")[-1].split(" has ")[0].strip() for line in printed.stdout.splitlines() if "child(" in line}
    assert links == set(chasles.Robot.load(urdf).links)


GOOD = """<?xml version="1.0"?>
<robot name="r"><link name="a"/><link name="b"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""


@pytest.mark.parametrize(
    ("text", "by"),
    [
        ('xyz="0 0 1"', 'xyz="0 0"'),
        ('xyz="0 0 1"', 'xyz="0 0 ${h}"'),
        ('xyz="0 0 1"', 'xyz="0, 0, 1"'),
        ('lower="-1"', 'lower="nan"'),
        ('lower="-1"', 'lower="0x1"'),
        ('type="revolute"', 'type="ball"'),
        ('<limit lower="-1" upper="1" effort="1" velocity="1"/>', ""),
        ('<parent link="a"/>', '<parent link="world"/>'),
        ('<parent link="a"/>', ""),
        ("</robot>", '<link name="b"/></robot>'),
        ("</robot>", '<link name="c"/></robot>'),
        ("</robot>", ""),
        ('name="r"', 'name="r" version="1.3"'),
        ('<link name="a"/>', '<Link name="a"/>'),
    ],
)
def test_what_urdfdom_refuses_is_refused_with_its_line(tmp_path, text, by):
    urdf = tmp_path / "bad.urdf"
    urdf.write_text(GOOD)
    assert chasles.Robot.load(urdf).variables == ["j"] and check_urdf(urdf).returncode == 0
    urdf.write_text(GOOD.replace(text, by))
    with pytest.raises(chasles.InvalidInput, match=r"bad.urdf:\d: "):
        chasles.Robot.load(urdf)
    assert check_urdf(urdf).returncode != 0


def robots_of(srdf: pathlib.Path) -> list[pathlib.Path]:
    return [urdf for urdf in URDFS if urdf.parents[1] == srdf.parents[1]]


@pytest.mark.parametrize(
    ("urdf", "srdf"),
    [(urdf, srdf) for srdf in SRDFS for urdf in robots_of(srdf)],
    ids=lambda f: f.stem,
)
def test_pairs_and_states_are_those_of_the_srdf_file(urdf, srdf):
    """Pairs by Python's own XML reader; states by Pinocchio, where the file has the names of the robot."""
    pinocchio = pytest.importorskip("pinocchio")
    bare, robot, root = chasles.Robot.load(urdf), chasles.Robot.load(urdf, srdf), ET.parse(srdf).getroot()
    disabled = {frozenset((p.attrib["link1"], p.attrib["link2"])) for p in root.findall("disable_collisions")}
    for pair in itertools.combinations(robot.links, 2):
        assert robot.is_tested(*pair) == (bare.is_tested(*pair) and frozenset(pair) not in disabled), pair
    file, model = File(urdf), pinocchio.buildModelFromUrdf(str(urdf))
    pinocchio.loadReferenceConfigurations(model, str(srdf), False)
    names = [state.attrib["name"] for state in root.findall("group_state")]
    for state in (s for s in root.findall("group_state") if names.count(s.attrib["name"]) == 1):
        values = dict(zip(robot.variables, robot.state(state.attrib["name"])))
        q = configuration_of_pinocchio(model, file, values)
        expected = model.referenceConfigurations[state.attrib["name"]]
        for joint in (j.attrib["name"] for j in state.findall("joint")):
            if joint in values and model.joints[model.getJointId(joint)].nq == 1:
                i = model.joints[model.getJointId(joint)].idx_q
                assert q[i] == expected[i], (state.attrib["name"], joint)


def test_the_panda_of_the_planning_problems(data):
    pytest.importorskip("pinocchio")
    urdf = data / "robots" / "panda" / "panda.urdf"
    check_link_poses(urdf, chasles.Robot.load(urdf))
    check_limits(urdf, chasles.Robot.load(urdf))
