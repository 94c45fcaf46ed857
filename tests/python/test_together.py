"""Several robots in one cell: names, clocks of their own, parts that change hands, pickle and errors."""

import pickle

import numpy as np
import pytest

import chasles


def slider(height):
    """A hand of side 0.2 that slides along x: its centre is at the value of the slide, and at a height."""
    hand = chasles.Polyhedron(*box(0.2))
    return chasles.Robot(
        name="slider",
        links=[{"name": "rail"}, {"name": "hand", "collisions": [hand]}],
        joints=[
            {"name": "x", "type": "prismatic", "parent": "rail", "child": "hand", "origin": [0, 0, height, 1, 0, 0, 0]}
        ],
    )


def box(side):
    corners = side * (np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) - 0.5)
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return corners, faces


@pytest.fixture
def cell():
    robots = chasles.Robot.together({"lower": slider(0.0), "upper": slider(0.4)})
    robots.attach("cube", "lower/hand", chasles.Polyhedron(*box(0.2)), [0, 0, 0.2, 1, 0, 0, 0])
    return robots


@pytest.fixture
def path(cell):
    lower = chasles.JointPath.straight(slider(0.0), [[0], [1], [-1]], [0, 1, 3])
    upper = chasles.JointPath.straight(slider(0.4), [[1], [5]], [1, 2])
    return chasles.JointPath.together(cell, {"lower": lower, "upper": upper})


def wall(x):
    scene = chasles.Scene()
    corners, faces = box(1)
    scene.add("wall", chasles.Polyhedron(corners * [1, 4, 4], faces), pose=[x + 0.5, 0, 0, 1, 0, 0, 0])
    return scene


TAKEN = [(1, "cube", "upper/hand")]


def test_names_have_the_robot_in_front(cell):
    assert cell.variables == ["lower/x", "upper/x"]
    assert cell.links == ["world", "lower/rail", "lower/hand", "upper/rail", "upper/hand"]
    assert cell.tested_pairs() == [("lower/hand", "upper/hand"), ("upper/hand", "cube")]
    nested = chasles.Robot.together({"a": cell, "b": slider(9.0)})
    assert nested.variables == ["a/lower/x", "a/upper/x", "b/x"]


def test_each_robot_has_a_clock_of_its_own(cell, path):
    np.testing.assert_array_equal(path.times, [0, 1, 2, 3])
    for time, lower, upper in ((0, 0, 1), (0.5, 0.5, 1), (1.25, 0.75, 2), (2.5, -0.5, 5), (9, -1, 5)):
        np.testing.assert_allclose(path.at(time), [lower, upper], atol=1e-15)
    rests = chasles.JointPath.together(
        cell, {"upper": chasles.JointPath.straight(slider(0.4), [[0], [1]]), "lower": [0.25]}
    )
    np.testing.assert_array_equal(rests.at(0.5), [0.25, 0.5])


def test_a_part_changes_hands(cell, path):
    assert cell.first_contact_on_path(path).pair == ("cube", "upper/hand")
    assert cell.first_contact_on_path(path, handovers=TAKEN).verdict == "clear"
    found = cell.first_contact_on_path(path, scene=wall(3), handovers=TAKEN)
    assert found.verdict == "contact" and found.segment == 1
    assert found.time == pytest.approx(1 + 1.9 / 4, abs=1e-9)
    checker = chasles.RobotChecker(cell, wall(3))
    assert checker.first_contact_on_path(path, handovers=TAKEN).time == found.time
    near = chasles.RobotChecker(cell, wall(5.2)).least_distance_on_path(path, handovers=TAKEN)
    assert near.distance == pytest.approx(0.1, rel=1e-5) and near.pair[1] == "wall"
    with pytest.raises(chasles.InvalidInput, match="gradient: is not computed for a path with handovers"):
        _ = near.gradient
    profile = cell.profile(path, scene=wall(5.2), handovers=TAKEN)
    assert profile.lower.min() == pytest.approx(0.1, rel=0.02)


def test_links_that_touch_the_part_are_not_tested(cell, path):
    untested = cell.first_contact_on_path(path, handovers=TAKEN).untested
    assert ("upper/hand", "cube", "ignored") in untested.named
    cell.attach("finger", "upper/hand", chasles.Polyhedron(*box(0.05)), [0, 0, -0.2, 1, 0, 0, 0])  # in the cube's way
    assert cell.first_contact_on_path(path, handovers=TAKEN).pair == ("finger", "cube")
    assert cell.first_contact_on_path(path, handovers=[(*TAKEN[0], ["finger"])]).verdict == "clear"


def test_cells_and_paths_are_pickled(cell, path):
    again, way = pickle.loads(pickle.dumps(cell)), pickle.loads(pickle.dumps(path))
    found = again.first_contact_on_path(way, scene=wall(3), handovers=TAKEN)
    assert found.time == cell.first_contact_on_path(path, scene=wall(3), handovers=TAKEN).time


def test_a_page_shows_the_handover(cell, path, tmp_path):
    page = chasles.write_robot_page(cell, path, tmp_path / "page.html", handovers=TAKEN, curve=True)
    assert "upper/hand" in page.read_text(encoding="utf-8")


def test_wrong_robots_paths_and_handovers_are_refused(cell, path):
    one = slider(0.0)
    for robots, error, why in (
        ({}, chasles.InvalidInput, "robot: together: there is no robot"),
        ({"a/b": one}, chasles.InvalidInput, "robot: together: a/b: the name of a robot has no slash"),
        ({"a": 1}, TypeError, "robots: a: must be a chasles.Robot"),
        ([one], TypeError, "robots: must be a dict by the names of robots"),
        ({1: one}, TypeError, "robots: the name of a robot must be a str"),
    ):
        with pytest.raises(error, match=why):
            chasles.Robot.together(robots)
    moves = chasles.JointPath.straight(one, [[0], [1]])
    for paths, error, why in (
        ({"lower": moves}, chasles.InvalidInput, "path: upper: has no path; give one, or the configuration"),
        ({"lower": moves, "upper": [1, 2]}, chasles.InvalidInput, "path: upper: has 2 values, and the robot has 1"),
        ({"lower": moves, "upper": "x"}, chasles.InvalidInput, "paths: upper: "),
        (None, TypeError, "paths: must be a dict"),
    ):
        with pytest.raises(error, match=why):
            chasles.JointPath.together(cell, paths)
    for handovers, error, why in (
        ([(1.5, "cube", "upper/hand")], chasles.InvalidInput, "handover 0: no segment of the path ends at the stamp 1.5"),
        ([(1, "cube")], TypeError, "handovers: 0: must be a tuple"),
        ([(1, "cube", 3)], TypeError, "handovers: 0: the time must be a number"),
        ([(1, "cube", "upper/hand", "x")], TypeError, "handovers: 0: touch_links must be a list of str"),
        ("cube", TypeError, "handovers: must be a sequence"),
    ):
        with pytest.raises(error, match=why):
            cell.first_contact_on_path(path, handovers=handovers)
