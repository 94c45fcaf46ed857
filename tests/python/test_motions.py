"""Screws and sweeps."""

import math
import pickle

import numpy as np
import pytest
from cubes import matrix, pose

import chasles

TURNED = pose(1, 2, 3, math.cos(0.3), 0, 0, math.sin(0.3))


def test_a_screw_has_an_axis_a_turn_and_a_slide():
    screw = chasles.ScrewMotion.between(pose(0, 0, 0), TURNED)
    assert screw.angle == pytest.approx(0.6)
    assert screw.slide == pytest.approx(3)
    np.testing.assert_allclose(screw.axis_direction, [0, 0, 1])
    assert "turns 0.6 rad" in repr(screw)


@pytest.mark.parametrize("kind", [chasles.ScrewMotion, chasles.SweepMotion])
def test_both_ends_are_kept(kind):
    motion = kind.between(matrix(3, 0, 0), TURNED)
    np.testing.assert_allclose(motion.pose_at(0), matrix(3, 0, 0), atol=1e-15)
    np.testing.assert_allclose(motion.pose_at(1)[:3, 3], TURNED[:3])
    assert motion.time_at(motion.tau_at(0.25)) == pytest.approx(0.25)
    with pytest.raises(chasles.InvalidInput, match=r"time: 2 is not in \[0, 1\]"):
        motion.pose_at(2)


def test_a_sweep_goes_about_its_centre():
    sweep = chasles.SweepMotion.between(pose(0, 0, 0), TURNED, centre=[1, 0, 0])
    moved = TURNED[:3] + [math.cos(0.6), math.sin(0.6), 0] - np.array([1, 0, 0])
    np.testing.assert_allclose(sweep.displacement, moved)
    np.testing.assert_allclose(sweep.about([0, 0, 0]).displacement, TURNED[:3])


def test_a_query_follows_the_pieces_and_not_the_uncut_screw():
    """A plate falls and turns by a quarter turn: when is it at the height of the pieces, and when at that of the screw?"""
    goal = [0, 0, 0, math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
    screw = chasles.ScrewMotion.between([0, 0, 2, 1, 0, 0, 0], goal)
    plate = chasles.Polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    found = chasles.first_contact(plate, plate, motion=screw, margin=1.5)
    assert found.time == pytest.approx(0.25, abs=1e-3)  # nine equal slides of nearly even speed
    piece, part = divmod(found.time * 9, 1)
    assert screw.pieces()[int(piece)].pose_at(part)[2, 3] == pytest.approx(1.5, abs=1e-9)
    assert screw.pose_at(found.time)[2, 3] > 1.55


def test_a_screw_is_cut_into_equal_turns():
    pieces = chasles.ScrewMotion.between(pose(0, 0, 0), TURNED).cut(0.25)
    assert [piece.angle for piece in pieces] == pytest.approx([0.2] * 3)
    screw = chasles.ScrewMotion.between(pose(0, 0, 0), TURNED, max_turn=0.25)
    assert screw.max_turn == 0.25 and len(screw.pieces()) == 3
    assert len(screw.with_max_turn(0.35).pieces()) == 2
    assert chasles.ScrewMotion.between(pose(0, 0, 0), TURNED).max_turn == math.pi / 18
    with pytest.raises(chasles.InvalidInput, match="max_turn"):
        screw.cut(0)


def test_tau_of_a_sweep_is_the_time():
    sweep = chasles.SweepMotion.between(pose(0, 0, 0), TURNED)
    assert sweep.tau_at(0.3) == 0.3 and sweep.time_at(0.3) == 0.3


@pytest.mark.parametrize(
    "motion",
    [
        chasles.ScrewMotion.between(pose(3, 0, 0), TURNED),
        chasles.ScrewMotion.between(pose(3, 0, 0), TURNED, max_turn=0.05),
        chasles.SweepMotion.between(pose(3, 0, 0), TURNED, [0.5, 0, 0.25]),
        chasles.ScrewMotion.relative(pose(3, 0, 0), TURNED, pose(0, 0, 1), pose(0, 1, 0, 1, 0.5, 0, 0)),
        chasles.SweepMotion.relative(pose(3, 0, 0), TURNED, pose(0, 0, 1), pose(0, 1, 0, 1, 0.5, 0, 0)),
    ],
)
def test_pickled_motions_give_the_same_answer(cube, motion):
    again = pickle.loads(pickle.dumps(motion))
    first, second = (chasles.first_contact(cube, cube, motion=m) for m in (motion, again))
    assert (first.time, first.time_upper, first.verdict) == (second.time, second.time_upper, second.verdict)
    np.testing.assert_array_equal(again.pose_at(0.3), motion.pose_at(0.3))
    if isinstance(motion, chasles.ScrewMotion):
        assert again.max_turn == motion.max_turn


def test_pickled_pieces_of_a_screw_of_two_moving_bodies_stay_where_they_are():
    screw = chasles.ScrewMotion.relative(pose(3, 0, 0), TURNED, pose(0, 0, 1), pose(0, 1, 0, 1, 0.5, 0, 0), 0.3)
    assert screw.max_turn == 0.3 and len(screw.pieces()) > 2
    for piece in screw.pieces():
        again = pickle.loads(pickle.dumps(piece))
        np.testing.assert_allclose(again.pose_at(0.3), piece.pose_at(0.3), atol=1e-14)


@pytest.mark.parametrize("kind", [chasles.ScrewMotion, chasles.SweepMotion])
@pytest.mark.parametrize("state", [(), (pose(0, 0, 0),), (None,) * 5])
def test_a_spoilt_pickle_is_refused(kind, state):
    with pytest.raises(chasles.InvalidInput):
        kind.__new__(kind).__setstate__(state)


def test_poses_of_two_moving_bodies_are_in_the_world(cube):
    arguments = pose(3, 0, 0), pose(0, 0, 0), pose(0, 0, 0), pose(2, 0, 0)
    relative = chasles.ScrewMotion.relative(*arguments)
    found = chasles.first_contact(cube, cube, motion=relative)
    assert found.time == pytest.approx(2 / 5)
    same = chasles.first_contact(cube, cube, *arguments[:2], fixed_start=arguments[2], fixed_goal=arguments[3])
    assert same.time == found.time
    np.testing.assert_allclose(relative.fixed_pose_at(0.5), matrix(1, 0, 0))


@pytest.mark.parametrize("name", ["moving_start", "moving_goal", "fixed_start", "fixed_goal"])
def test_a_bad_pose_is_named(name):
    poses = dict.fromkeys(["moving_start", "moving_goal", "fixed_start", "fixed_goal"], pose(0, 0, 0))
    with pytest.raises(chasles.InvalidInput, match=f"{name}: the shape"):
        chasles.ScrewMotion.relative(**{**poses, name: np.zeros(6)})
