"""Motions that are no rational ones: constant velocity, twist, joints, splines, tracks, and the user's own."""

import math
import pickle

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, matrix, pose

import chasles


def cube():
    return chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)


TURNED = pose(1, 2, 3, math.cos(0.3), 0, 0, math.sin(0.3))
QUARTER = pose(0, 0, 0, math.cos(math.pi / 4), 0, 0, math.sin(math.pi / 4))


def test_constant_velocity_moves_its_centre_straight():
    velocity = chasles.ConstantVelocity.between(pose(0, 0, 0), TURNED, [1, 0, 0])
    assert velocity.angle == pytest.approx(0.6)
    moved = TURNED[:3] + [math.cos(0.6), math.sin(0.6), 0] - np.array([1, 0, 0])
    np.testing.assert_allclose(velocity.displacement, moved)
    there = velocity.pose_at(0.25) @ [1, 0, 0, 1]
    np.testing.assert_allclose(there[:3], np.array([1, 0, 0]) + 0.25 * moved)
    assert "turns 0.6 rad" in repr(velocity)


def test_a_turn_about_one_axis_is_certain_although_the_upper_faces_share_a_plane():
    fixed = chasles.Motion.at_rest(pose(1.5, 1.2, 0))
    hinge = chasles.Motion.hinge([0, 0, 0], [0, 0, 1], [0, 0, 0.5]) * chasles.Motion.at_rest(pose(1.5, 0, 0))
    found = chasles.first_contact(cube(), cube(), motion=chasles.relative(hinge, fixed))
    assert found.verdict == "contact"
    assert found.certain
    angle = math.asin(1.2 / math.hypot(2.5, 1)) - math.atan2(1, 2.5)
    assert found.time <= math.sqrt(angle / 0.5) + 1e-14
    assert found.time_upper >= math.sqrt(angle / 0.5) - 1e-14


def test_constant_twist_slides_evenly():
    twist = chasles.ConstantTwist.between(pose(0, 0, 0), TURNED)
    assert twist.pose_at(0.25)[2, 3] == pytest.approx(0.75)
    assert twist.screw_of_same_poses.slide == pytest.approx(3)


@pytest.mark.parametrize("kind", [chasles.ConstantVelocity, chasles.ConstantTwist])
def test_even_motions_survive_pickle(kind):
    motion = kind.between(pose(3, 0, 0), TURNED)
    again = pickle.loads(pickle.dumps(motion))
    np.testing.assert_array_equal(again.pose_at(0.3), motion.pose_at(0.3))


def test_a_hinge_carries_what_is_mounted_on_it():
    arm = chasles.Motion.hinge([0, 0, 0], [0, 0, 1], [0, math.pi / 2]) * chasles.Motion.at_rest(pose(2, 0, 0))
    np.testing.assert_allclose(arm.pose_at(1)[:3, 3], [0, 2, 0], atol=1e-15)
    np.testing.assert_allclose(chasles.Motion.slider([0, 3, 4], [0, 5]).pose_at(1)[:3, 3], [0, 3, 4])
    np.testing.assert_allclose(chasles.Motion.polynomial([[0, 0, 0], [1, 2, 3]]).pose_at(0.5)[:3, 3], [0.5, 1, 1.5])
    with pytest.raises(chasles.InvalidInput, match="product: takes no screw"):
        arm * chasles.ScrewMotion.between(pose(0, 0, 0), TURNED)
    with pytest.raises(chasles.InvalidInput, match="must be a motion"):
        arm * 3


def test_splines_go_through_or_near_their_poses():
    poses = [pose(0, 0, 0), pose(1, 1, 0), pose(3, 0, 0)]
    spline = chasles.Spline.through([0, 0.4, 1], poses)
    np.testing.assert_allclose(spline.pose_at(0.4)[:3, 3], [1, 1, 0], atol=1e-15)
    smooth = chasles.Spline.b_spline(poses)
    np.testing.assert_allclose(smooth.pose_at(1)[:3, 3], [3, 0, 0], atol=1e-15)
    with pytest.raises(chasles.InvalidInput, match="at least two"):
        chasles.Spline.through([0], poses[:1])
    with pytest.raises(chasles.InvalidInput, match="must ascend"):
        chasles.Spline.through([0, 0, 1], poses)


def test_a_track_tells_the_stamp_of_its_contact():
    track = chasles.TimedPoses.through([10, 12, 16], [pose(5, 4, 0), pose(5, 0, 0), pose(-3, 0, 0)])
    found = chasles.first_contact(cube(), cube(), motion=track)
    assert found.verdict == "contact" and track.segment_of(found.time) == 1
    lower, upper = track.stamp_of(found.time, found.time_upper)
    size = cube().vertices.max() - cube().vertices.min()
    stamp = 12 + 4 * (5 - size) / 8
    assert lower <= stamp <= upper and upper - lower < 1e-11
    with pytest.raises(chasles.InvalidInput, match="must ascend"):
        chasles.TimedPoses.through([1, 0], [pose(0, 0, 0), pose(1, 0, 0)])
    with pytest.raises(chasles.InvalidInput, match="between"):
        chasles.TimedPoses.through([0, 1], [pose(0, 0, 0), pose(1, 0, 0)], between="screw")


def test_both_bodies_may_move():
    coming = chasles.ConstantVelocity.between(pose(5, 0, 0), pose(1, 0, 0))
    going = chasles.Motion.slider([-1, 0, 0], [0, 2]) * chasles.Motion.at_rest(pose(-3, 0, 0))
    meeting = chasles.ConstantVelocity.between(pose(-5, 0, 0), pose(-1, 0, 0))
    assert chasles.first_contact(cube(), cube(), motion=chasles.Motion.at_rest(pose(9, 0, 0)) * going).verdict == "clear"
    found = chasles.first_contact(cube(), cube(), motion=chasles.relative(coming, meeting))
    assert found.verdict == "clear"  # at 1 and -1: one apart
    nearer = chasles.ConstantVelocity.between(pose(-5, 0, 0), pose(3, 0, 0))
    found = chasles.first_contact(cube(), cube(), motion=chasles.relative(coming, nearer))
    assert found.verdict == "contact" and found.time == pytest.approx(9 / 12, abs=1e-12)
    turning = chasles.Motion.slider([1, 0, 0], [-5, 8]) * chasles.Motion.hinge([0, 0, 0], [1, 0, 0], [0, 1])
    at_rest = chasles.Motion.at_rest(pose(0, 0, 0))
    one = chasles.first_contact(cube(), cube(), motion=chasles.relative(turning, at_rest))
    other = chasles.first_contact(cube(), cube(), motion=chasles.relative(at_rest, turning))
    assert one.verdict == other.verdict == "contact"
    assert one.time == pytest.approx(other.time, abs=1e-12)
    np.testing.assert_allclose(one.pose, turning.pose_at(one.time), atol=1e-12)


def own(scale=1.0, **options):
    """A swing about z through (1, 0, 0) by sin(3 t), with its bounds times a scale."""

    def pose_at(t):
        c, s = math.cos(math.sin(3 * t)), math.sin(math.sin(3 * t))
        turn = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        return matrix(1, 0, 0) @ turn @ matrix(-1, 0, 0)

    def bounds(start, end):
        middle, half = (start + end) / 2, (end - start) / 2
        return {
            "turn_rate": scale * min(3, 3 * abs(math.cos(3 * middle)) + 9 * half),
            "turn_acceleration": scale * min(9, 9 * abs(math.sin(3 * middle)) + 27 * half),
            "speed": 0,
            "acceleration": 0,
        }

    return chasles.Trajectory(pose_at, bounds, reference=[1, 0, 0], **options)


def test_a_trajectory_of_the_users_own():
    moving = own() * chasles.Motion.at_rest(pose(4, 0, 0))
    fixed = chasles.Motion.at_rest(pose(4, 2, 0.3))  # not flush: no rounding tells whether flush edges miss
    found = chasles.first_contact(cube(), cube(), motion=chasles.relative(moving, fixed))
    assert found.verdict == "contact"
    assert chasles.first_contact(cube(), cube(), motion=own()).verdict == "contact_at_start"


def test_a_bound_that_is_too_small_is_found():
    assert own().find_broken_bound() is None
    broken = own(0.9).find_broken_bound()
    assert broken["bound"] in ("turn_rate", "turn_acceleration")
    assert broken["found"] > broken["stated"]


@pytest.mark.parametrize(
    ("pose_at", "bounds", "message"),
    [
        (3, lambda a, b: {}, "trajectory: pose_at: 3 is no function; one is needed"),
        (lambda t: TURNED, lambda a, b: {"speed": 1}, "turn_rate is missing"),
        (lambda t: TURNED, lambda a, b: {"turn_rate": 1, "speed": math.nan}, "speed from 0 to 1"),
        (lambda t: TURNED, lambda a, b: {"turn_rate": 1, "speed": 1, "jerk": 1}, "no bound with the name jerk"),
        (lambda t: [1, 2], lambda a, b: {"turn_rate": 1, "speed": 1}, "pose_at"),
    ],
)
def test_bad_functions_get_one_clear_error(pose_at, bounds, message):
    with pytest.raises(chasles.InvalidInput, match=message):
        chasles.Trajectory(pose_at, bounds)


def test_an_exception_in_a_function_reaches_the_caller():
    calls = 0

    def pose_at(t):
        nonlocal calls
        calls += 1
        if calls > 3:
            raise RuntimeError("the arm is broken")
        return pose(3, 0, 0)

    motion = chasles.Trajectory(pose_at, lambda a, b: {"turn_rate": 1, "speed": 9})
    with pytest.raises(RuntimeError, match="the arm is broken"):
        chasles.first_contact(cube(), cube(), motion=motion)


@pytest.mark.parametrize("kind", ["screw", "sweep", "velocity", "twist"])
def test_batches_take_any_of_four_motions(kind):
    starts = np.array([pose(5, 0, 0), pose(5, 9, 0), pose(4, 3, 1)], dtype=float)
    goals = np.array([TURNED, TURNED + [0, 20, 0, 0, 0, 0, 0], QUARTER], dtype=float)
    table = chasles.first_contact_batch(cube(), cube(), starts, goals, motion=kind)
    least = chasles.least_distance_batch(cube(), cube(), starts, goals, motion=kind)
    kinds = {
        "screw": chasles.ScrewMotion,
        "sweep": chasles.SweepMotion,
        "velocity": chasles.ConstantVelocity,
        "twist": chasles.ConstantTwist,
    }
    for i, row in enumerate(table):
        found = chasles.first_contact(cube(), cube(), motion=kinds[kind].between(starts[i], goals[i]))
        assert row["verdict"] == found.verdict
        if found.verdict == "contact":
            assert row["time"] == found.time
            assert math.isnan(row["tau"]) == (kind in ("velocity", "twist"))
        else:
            nearest = chasles.least_distance(cube(), cube(), motion=kinds[kind].between(starts[i], goals[i]))
            assert least[i]["distance"] == nearest.distance
    with pytest.raises(chasles.InvalidInput, match="motion: 'spin': must be"):
        chasles.first_contact_batch(cube(), cube(), starts, goals, motion="spin")
