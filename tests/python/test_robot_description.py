"""Robots of arrays: the same bits as of URDF files, what an XML reader of Python's reads there, and what is refused."""

import copy
import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES
from test_robot_oracles import all_robots, random_configuration

import chasles

CUBE = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)
LIMITS = {"lower": -2.0, "upper": 2.0}
LINKS = [{"name": "base"}, {"name": "arm", "collisions": [{"shape": CUBE, "origin": [2, 0, 0, 1, 0, 0, 0]}]}]
JOINTS = [{"name": "turn", "type": "revolute", "parent": "base", "child": "arm", "axis": [0, 0, 1], **LIMITS}]


def made_anew(value):
    """The same description of Python's own numbers and lists. Meshes are made of their vertices and faces."""
    if isinstance(value, dict):
        return {key: made_anew(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [made_anew(item) for item in value]
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, chasles.Polyhedron) and len(value.faces) > 0 and value.radius == 0:
        return chasles.Polyhedron(value.vertices.tolist(), [list(face) for face in value.faces])
    return value


def seen(found):
    return [getattr(found, key) for key in ("verdict", "time", "time_upper", "certain", "pair", "clear_until")]


@all_robots
def test_arrays_give_the_same_bits_as_the_file(urdf):
    loaded = chasles.Robot.load(urdf)
    made = chasles.Robot(**made_anew(loaded.description()))
    assert made.variables == loaded.variables and made.warnings == loaded.warnings and made.name == loaded.name
    np.testing.assert_array_equal(made.limits, loaded.limits)
    assert made.continuous == loaded.continuous and made.tested_pairs() == loaded.tested_pairs()
    random = np.random.default_rng(3)
    for _ in range(3):
        start, goal = (random_configuration(random, loaded) for _ in range(2))
        for link, pose in loaded.link_poses(start).items():
            np.testing.assert_array_equal(made.link_pose(link, start), pose)
        with chasles.Limit(20):
            assert seen(made.first_contact(start, goal)) == seen(loaded.first_contact(start, goal))


def numbers(element, key, default):
    return [float(word) for word in (element.get(key, default) if element is not None else default).split()]


@all_robots
def test_a_description_says_what_the_file_says(urdf):
    """Beside Python's own reader of XML."""
    described = chasles.Robot.load(urdf).description()
    root = ET.parse(urdf).getroot()
    assert described["name"] == root.get("name")
    assert [link["name"] for link in described["links"]] == [link.get("name") for link in root.findall("link")]
    elements = root.findall("joint")
    assert [joint["name"] for joint in described["joints"]] == [element.get("name") for element in elements]
    for joint, element in zip(described["joints"], elements):
        assert joint["type"] == element.get("type")
        assert (joint["parent"], joint["child"]) == tuple(element.find(k).get("link") for k in ("parent", "child"))
        place = joint["origin"]
        assert place[:3].tolist() == numbers(element.find("origin"), "xyz", "0 0 0")
        np.testing.assert_allclose(matrix_of(place[3:]), turn_of(numbers(element.find("origin"), "rpy", "0 0 0")), atol=1e-15)
        if joint["type"] not in ("fixed", "floating"):
            assert joint["axis"].tolist() == numbers(element.find("axis"), "xyz", "1 0 0")


def matrix_of(quaternion):
    w, x, y, z = np.asarray(quaternion) / np.linalg.norm(quaternion)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.array(rows)


def turn_of(rpy):
    """About the fixed axes x, y and z in this order."""
    (cx, sx), (cy, sy), (cz, sz) = ((math.cos(angle), math.sin(angle)) for angle in rpy)
    x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return z @ y @ x


def test_a_robot_of_arrays_answers():
    robot = chasles.Robot(name="arm", links=LINKS, joints=JOINTS)
    assert robot.name == "arm" and robot.links == ["base", "arm"] and robot.variables == ["turn"]
    np.testing.assert_array_equal(robot.limits, [[-2, 2]])
    world = chasles.Scene()
    world.add("wall", CUBE, pose=[2, 2, 0, 1, 0, 0, 0])
    found = robot.first_contact([0], [1.5], scene=world)
    assert found.verdict == "contact" and found.pair == ("arm", "wall")
    corner = math.asin(2 / math.hypot(3, 1)) - math.atan2(1, 3)  # the edge at (3, 1) comes to the side at y = 2
    assert found.time - 1e-15 <= corner / 1.5 <= found.time_upper + 1e-15
    assert robot.description()["joints"][0]["upper"] == 2


def test_every_key_of_a_description_is_kept():
    given = {
        "name": "r",
        "links": [{"name": "a", "collisions": [CUBE]}, {"name": "b", "collisions": [chasles.sphere(0.5)]}, {"name": "c"}],
        "joints": [
            {"name": "j", "type": "planar", "parent": "a", "child": "b", "origin": np.eye(4)},
            {"name": "k", "type": "prismatic", "parent": "b", "child": "c", "lower": -1.0, "upper": 3.0},
        ],
        "disabled_pairs": [("a", "c", "Never"), ("b", "c")],
        "enabled_pairs": [["a", "b"]],
        "groups": [{"name": "g", "joints": ["k"], "links": ["c"]}],
        "states": [{"name": "up", "group": "g", "values": {"k": 2.0, "j": [1.0, 2.0, 0.5]}}, {"name": "down"}],
        "warnings": ["a warning"],
    }
    robot = chasles.Robot(**given)
    described = robot.description()
    assert described.keys() == given.keys() and described["warnings"] == robot.warnings == ["a warning"]
    assert robot.is_tested("a", "b") and not robot.is_tested("a", "c")
    assert robot.state("up").tolist() == [1, 2, 0.5, 2] and robot.state("down").tolist() == [0, 0, 0, 0]
    assert described["disabled_pairs"] == [("a", "c", "Never"), ("b", "c", "")] and described["groups"] == given["groups"]
    assert described["links"][1]["collisions"][0]["shape"].radius == 0.5
    again = chasles.Robot(**described).description()
    assert made_anew(again["joints"]) == made_anew(described["joints"]) and again["states"] == described["states"]


def changed(place, key, value):
    """The robot above with another value of a key, in a list of dicts."""
    given = copy.deepcopy({"links": [{"name": "base"}, {"name": "arm"}], "joints": JOINTS})
    given[place][-1][key] = value
    return given


REFUSED = [
    ({}, "robot: has no link"),
    ({"link": []}, "robot: the key 'link' is unknown; there are name, links, "),
    (changed("links", "shape", 1), "robot: links[1]: the key 'shape' is unknown; there are name, collisions"),
    (changed("links", "collisions", [{"origin": np.eye(4)}]), "robot: links[1]: collisions[0]: has no 'shape'"),
    (changed("links", "collisions", [{"shape": CUBE, "deviation": np.nan}]), "robot: arm: deviation: must be at least 0"),
    (changed("joints", "type", "hinge"), "robot: joints[0]: type: must be one of fixed, revolute, "),
    (changed("joints", "origin", [0, 0, 0]), "robot: joints[0]: origin: the shape is (3,)"),
    (changed("joints", "axis", [0, 0, 0]), "robot: turn: axis: must be finite and not zero"),
    (changed("joints", "axis", [0, 0]), "robot: joints[0]: axis: "),
    (changed("joints", "lower", 3.0), "robot: turn: limits: the lower one must not be above the upper one"),
    (changed("joints", "upper", np.nan), "robot: turn: limits: "),
    (changed("joints", "child", "hand"), "robot: hand: there is no such link"),
    (changed("joints", "mimic", {"joint": "none"}), "robot: turn: mimic: there is no joint none"),
    (changed("joints", "mimic", {}), "robot: joints[0]: mimic: has no 'joint'"),
    ({"links": LINKS}, "robot: arm: is the child of no joint, and neither is base"),
    ({"links": LINKS + LINKS, "joints": JOINTS}, "robot: base: there is another link of this name"),
    ({"links": LINKS, "joints": JOINTS, "disabled_pairs": [["arm"]]}, "robot: disabled_pairs[0]: must be two names"),
    ({"links": LINKS, "joints": JOINTS, "groups": [{"name": "g", "links": ["x"]}]}, "robot: g: there is no link x"),
    ({"links": LINKS, "joints": JOINTS, "states": [{"name": "s", "values": {"x": 1}}]}, "robot: s: there is no joint x"),
    ({"links": LINKS, "joints": JOINTS, "states": [{"name": "s", "values": {"turn": [1, 2]}}]}, "robot: s: turn: needs 1 "),
]


@pytest.mark.parametrize("given, why", REFUSED, ids=[why for _, why in REFUSED])
def test_what_is_refused(given, why):
    with pytest.raises(chasles.InvalidInput) as error:
        chasles.Robot(**given)
    assert str(error.value).startswith(why) and "\n" not in str(error.value)


WRONG_TYPES = [
    ({"links": 3}, "robot: links: must be a list, not 3"),
    ({"links": ["base"]}, "robot: links[0]: must be a dict with name, collisions, not 'base'"),
    (changed("links", "name", None), "robot: links[1]: name: must be a str, not None"),
    (changed("links", "collisions", [[1]]), "robot: links[1]: collisions[0]: must be a dict with shape, "),
    (changed("links", "collisions", [{"shape": 1}]), "robot: links[1]: collisions[0]: shape: must be a chasles.Polyhedron"),
    (changed("joints", "lower", "low"), "robot: joints[0]: lower: must be a number, not 'low'"),
    ({"links": LINKS, "joints": JOINTS, "disabled_pairs": ["ab"]}, "robot: disabled_pairs[0]: must be a list, not 'ab'"),
]


@pytest.mark.parametrize("given, why", WRONG_TYPES, ids=[why for _, why in WRONG_TYPES])
def test_wrong_types(given, why):
    with pytest.raises(TypeError) as error:
        chasles.Robot(**given)
    assert str(error.value).startswith(why)
