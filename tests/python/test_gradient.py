"""Gradients of least distances: by the goal of a motion, and by the knots of a path of a robot."""

import pickle

import numpy as np
import pytest
from conftest import ROOT
from cubes import pose

import chasles


def moved(goal: np.ndarray, step: np.ndarray) -> np.ndarray:
    """The goal (4, 4) after a translation and a rotation vector about the body's origin, both in the world."""
    angle = np.linalg.norm(step[3:])
    axis = step[3:] / angle if angle > 0 else np.array([0, 0, 1.0])
    cross = np.cross(axis, np.eye(3)).T
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    other = goal.copy()
    other[:3, :3] = turn @ goal[:3, :3]
    other[:3, 3] += step[:3]
    return other


@pytest.mark.parametrize("kind", ["screw", "sweep", "velocity", "twist"])
def test_the_gradient_by_the_goal_is_that_of_differences(cube, kind):
    start, goal = np.eye(4), np.eye(4)
    start[:3, 3], goal[:3, 3] = (-4, 2.3, 0.2), (3, 1.9, 0.4)
    goal = moved(goal, np.array([0, 0, 0, 0.3, 0.5, 0.9]))
    near = chasles.least_distance(cube, cube, start, goal, motion=kind)
    assert near.isolated is True
    assert near.gradient.shape == (6,) and near.gradient.dtype == np.float64
    step = 2.0**-16

    def distance(change: np.ndarray) -> float:
        return chasles.least_distance(
            cube, cube, start, moved(goal, change), motion=kind, tolerance=1e-9
        ).distance_upper

    expected = [(distance(step * unit) - distance(-step * unit)) / (2 * step) for unit in np.eye(6)]
    assert np.linalg.norm(near.gradient - expected) <= 1e-5 * np.linalg.norm(expected)
    assert (near.swapped().gradient == near.gradient).all() and near.swapped().isolated


def test_what_has_no_gradient_says_so(cube):
    touching = chasles.least_distance(cube, cube, pose(3, 0, 0), pose(0, 0, 0))
    assert touching.gradient is None and touching.isolated is False
    at_rest = chasles.least_distance(cube, cube, motion=chasles.Motion.at_rest(pose(3, 0, 0)))
    with pytest.raises(chasles.InvalidInput, match="^gradient: the motion has no goal pose to change"):
        _ = at_rest.gradient
    with pytest.raises(chasles.InvalidInput, match="^gradient"):
        _ = at_rest.isolated


def test_parallel_faces_are_not_isolated(cube):
    near = chasles.least_distance(cube, cube, pose(0.1, 0.2, 4), pose(0.1, 0.2, 1.5), motion="velocity")
    assert not near.isolated and near.gradient[2] == pytest.approx(1)


def test_bodies_of_a_scene_that_both_move(cube):
    scene = chasles.Scene()
    scene.add("a", cube, pose(-3, 1.8, 0.1), pose(3, 1.6, 0.2, 0.9, 0.1, 0.2, 0.3))
    scene.add("b", cube, pose(0, 0, 0), pose(0, -0.5, 0, 0.9, -0.2, 0.2, 0.3))
    near = scene.least_distance()
    assert near.isolated and near.gradient.shape == (6,)


@pytest.fixture(scope="module")
def checker() -> chasles.RobotChecker:
    folder = ROOT / "examples" / "robot"
    robot = chasles.Robot.load(folder / "arm.urdf")
    robot.ignore("left_finger", "right_finger")
    scene = chasles.Scene()
    scene.add("pole", chasles.capsule(0.05, 2), pose(1.0, -0.2, 0.6))
    return chasles.RobotChecker(robot, scene)


START, GOAL = np.array([-0.6, 0.1, 0.2, 0.01]), np.array([-0.1, 0.9, 0.5, 0.02])


def test_the_gradient_of_an_edge_has_the_row_of_its_goal(checker):
    near = checker.least_distance(START, GOAL)
    assert near.isolated and near.gradient.shape == (2, 4)
    assert near.gradient[-1].shape == (4,) and np.linalg.norm(near.gradient[-1]) > 0.1
    step = 2.0**-16
    expected = [
        (
            checker.least_distance(START, GOAL + step * unit, tolerance=1e-9).distance_upper
            - checker.least_distance(START, GOAL - step * unit, tolerance=1e-9).distance_upper
        )
        / (2 * step)
        for unit in np.eye(4)
    ]
    assert np.linalg.norm(near.gradient[-1] - expected) <= 1e-5 * np.linalg.norm(expected)


def test_the_gradient_of_a_path_has_a_row_for_each_knot(checker):
    knots = np.array([START, [-0.4, 0.4, 0.2, 0.01], GOAL, [0.1, 1.0, 0.5, 0.02]])
    near = checker.least_distance_on_path(knots)
    assert near.gradient.shape == (4, 4)
    outside = [k for k in range(4) if k not in (near.segment, near.segment + 1)]
    assert (near.gradient[outside] == 0).all()
    spline = chasles.JointPath.natural_spline(checker.robot, [0, 1, 2, 3], knots)
    again = pickle.loads(pickle.dumps(spline))
    assert (checker.least_distance_on_path(again).gradient == checker.least_distance_on_path(spline).gradient).all()
    assert np.count_nonzero(np.linalg.norm(checker.least_distance_on_path(spline).gradient, axis=1)) == 4


def test_a_path_of_polynomials_has_no_knots(checker):
    path = chasles.JointPath.polynomials(checker.robot, [0, 1], np.array([[GOAL - START], [START]]))
    near = checker.least_distance_on_path(path)
    with pytest.raises(chasles.InvalidInput, match="^gradient: a path of polynomials has no knots to change"):
        _ = near.gradient


def test_an_edge_that_touches_has_no_gradient(checker):
    near = checker.least_distance(START, [0.2, -0.2, 0.5, 0.02])
    assert near.distance_upper == 0 and near.gradient is None and not near.isolated
