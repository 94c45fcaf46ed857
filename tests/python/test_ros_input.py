"""Trajectories of ROS that a sender got wrong: each is refused by the number of its point, counted from 0, and nothing else."""

import json

import numpy as np
import pytest
from test_ros import ARM

import chasles
import chasles.ros

NAN, INF = float("nan"), float("inf")
REST = [0.0, 0.0, 0.0, 0.02]


@pytest.fixture(scope="module")
def arm():
    return chasles.Robot.load(ARM)


def point(time, positions=REST, **more):
    return {"positions": positions, "time_from_start": time, **more}


def refused(robot, *points, names=None, **options):
    with pytest.raises(chasles.InvalidInput) as error:
        chasles.ros.joint_path({"joint_names": names or list(robot.variables), "points": list(points)}, robot, **options)
    assert "\n" not in str(error.value)
    return str(error.value)


@pytest.mark.parametrize("value", [NAN, INF, -INF], ids=str)
@pytest.mark.parametrize("what", ["positions", "velocities", "accelerations"])
@pytest.mark.parametrize("orders", [(1, 2, 3), (2, 3, 3), (3, 3, 3)], ids=str)
@pytest.mark.parametrize("start", [None, REST], ids=["alone", "from a start"])
def test_numbers_that_are_not_finite(arm, value, what, orders, start):
    """Whether all points have the same rates, or only some."""
    rates = ("velocities", "accelerations")
    points = [point(k + 1.0, **dict.fromkeys(rates[: order - 1], [0.0] * 4)) for k, order in enumerate(orders)]
    points[2][what] = [*REST[:1], value, *REST[2:]]
    if what == "accelerations":
        points[2]["velocities"] = [0.0] * 4
    assert refused(arm, *points, start=start) == f"points: point 2: {what}: 'elbow' is {value}; finite numbers are needed"


def test_numbers_that_are_too_large_or_too_fast(arm):
    fast = [point(1.0), point(2.0, velocities=[0.0] * 4), point(2.000000001, velocities=[0.0, 1e308, 0.0, 0.0])]
    assert refused(arm, *fast).startswith("points: the way to point 2: ")
    steep = [point(1.0), point(2.0, velocities=[0.0] * 4), point(2.0000000000000004, velocities=[0.0, 1e308, 0.0, 0.0])]
    steep[2]["accelerations"] = steep[1]["accelerations"] = [1e308] * 4
    assert refused(arm, *steep).startswith("points: the way to point 2: ")
    far = [point(1.0), point(2.0, [0.0, 1001.0, 0.0, 0.0])]
    for start in (None, REST):
        assert refused(arm, *far, start=start).startswith("points: point 1: elbow is beyond 1000")
    assert refused(arm, *far[:1], start=[0.0, 1001.0, 0.0, 0.0]).startswith("start: elbow is beyond 1000")


@pytest.mark.parametrize("start", [None, REST], ids=["alone", "from a start"])
def test_times_are_counted_by_points(arm, start):
    late = "points: point 2: time_from_start: 1.5 s is not later than 2 s, that of the point before"
    assert refused(arm, point(1.0), point(2.0), point(1.5), start=start) == late
    for time in (NAN, INF, {"sec": NAN}, {"sec": 10**400}, {"sec": [1]}, {"sec": "1"}):
        why = refused(arm, point(1.0), point(time), start=start)
        assert why.startswith("points: point 1: time_from_start: "), why


def test_starts_and_tolerances(arm):
    assert refused(arm, point(1.0), start=[0, NAN, 0, 0]) == "start: 'elbow' is nan; finite numbers are needed"
    for tolerance in (-1, NAN):
        assert refused(arm, point(0.0), start=REST, tolerance=tolerance).startswith("tolerance: must be at least 0")


def test_shapes(arm):
    scalar = point(1.0), point(2.0, velocities=3.0)
    why = "points: point 1: velocities: the shape is (); a list is needed, with a number for each of joint_names"
    assert refused(arm, *scalar) == why
    assert refused(arm, point(1.0), point(2.0, [REST])).startswith("points: point 1: positions: the shape is (1, 4); ")
    for names in ([["waist"]], [1], [None]):
        assert refused(arm, names=names).startswith(f"joint_names: {names[0]!r} is no variable of the robot")


def test_a_message_that_contains_itself(arm):
    endless = {}
    endless["trajectory"] = endless
    with pytest.raises(chasles.InvalidInput, match="^message: has no points"):
        chasles.ros.joint_path(endless, arm)


def with_finger(positions, **more):
    return point(1.0, [*REST[:3], positions[0], positions[1]], **more)


def test_a_joint_that_follows_may_agree(arm):
    """The finger `right` follows `left`."""
    names = [*arm.variables, "right"]
    message = {"joint_names": names[::-1], "points": [with_finger([0.01, 0.01]), with_finger([0.04, 0.04 + 5e-5]) | {"time_from_start": 2.0}]}
    for given in message["points"]:
        given["positions"] = given["positions"][::-1]
    path = chasles.ros.joint_path(message, arm)
    np.testing.assert_array_equal([path.at(1.0), path.at(2.0)], [[0, 0, 0, 0.01], [0, 0, 0, 0.04]])
    alone = {"joint_names": ["right"], "points": [{"positions": [0.02], "time_from_start": 1.0}]}
    np.testing.assert_array_equal(chasles.ros.joint_path(alone, arm, start=REST).at(0.5), REST)


def test_a_joint_that_follows_has_to_agree(arm):
    names, rates = [*arm.variables, "right"], {"velocities": [0, 0, 0, 0.1, 0.1]}
    end = "leave it out: it follows 'left'"
    why = refused(arm, with_finger([0.01, 0.02]), names=names, start=REST)
    assert why == f"points: point 0: positions: 'right' is 0.02 and would be 0.01; {end}"
    why = refused(arm, with_finger([0.01, 0.01], velocities=[0, 0, 0, 0.1, 0.2]), names=names, start=REST)
    assert why == f"points: point 0: velocities: 'right' is 0.2 and would be 0.1; {end}"
    why = refused(arm, with_finger([0.01, 0.01], **rates, accelerations=[0, 0, 0, 0, 1]), names=names, start=REST)
    assert why == f"points: point 0: accelerations: 'right' is 1 and would be 0; {end}"
    assert refused(arm, point(1.0, [0.03]), names=["right"], start=REST).endswith(end)


def test_chains_of_joints_that_follow():
    """The third joint follows the second one, which follows the first one."""
    links = [{"name": name} for name in "abcd"]
    joints = [{"name": f"j{k}", "type": "prismatic", "parent": "abc"[k], "child": "bcd"[k], "axis": [1, 0, 0]} for k in range(3)]
    joints[1]["mimic"] = {"joint": "j0", "multiplier": 2.0, "offset": 0.1}
    joints[2]["mimic"] = {"joint": "j1", "multiplier": -3.0, "offset": 0.5}
    robot = chasles.Robot(links=links, joints=joints)
    rows = [[x, 2 * x + 0.1, -3 * (2 * x + 0.1) + 0.5] for x in (0.0, 1.0)]
    points = [point(float(k), row, velocities=[1.0, 2.0, -6.0]) for k, row in enumerate(rows)]
    assert chasles.ros.joint_path({"joint_names": ["j0", "j1", "j2"], "points": points}, robot).at(1.0) == [1.0]
    points[1]["positions"][2] += 0.01
    assert refused(robot, *points, names=["j0", "j1", "j2"]).endswith("leave it out: it follows 'j1'")


MESSAGE = {"joint_names": ["a"], "points": [{"positions": [0], "time_from_start": 0.0}]}
FILES = {
    "two.json": (json.dumps([MESSAGE, MESSAGE]), 2),
    "wrapped.json": (json.dumps({"trajectory": [{"joint_trajectory": MESSAGE}] * 2}), 1),
    "list.yaml": (f"- {json.dumps(MESSAGE)}\n- {json.dumps(MESSAGE)}\n---\n{json.dumps(MESSAGE)}\n---\n", 3),
    "bytes.yaml": (b"\xff\xfe\x00", "'utf-8' codec can't decode"),
    "bytes.json": (b"\xff\xfe\x00", "'utf-8' codec can't decode"),
    "other.yaml": ("x: 1\n", "message 0: has no points"),
    "mixed.yaml": (f"{json.dumps(MESSAGE)}\n---\nx: 1\n", "message 1: has no points"),
    "none.json": ("[]", "has no trajectory"),
    "nothing.yaml": ("", "has no trajectory"),
    "number.json": ("3", "message 0: has no points"),
    "deep.json": ("[" * 100000, "maximum recursion depth"),
    "endless.yaml": ("&a\ntrajectory: *a\n", "message 0: has no points"),
}


@pytest.mark.parametrize("name", FILES)
def test_files(tmp_path, name):
    pytest.importorskip("ruamel.yaml")
    content, expected = FILES[name]
    (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    if isinstance(expected, int):
        assert len(chasles.ros.trajectories(tmp_path / name)) == expected
        return
    with pytest.raises(chasles.InvalidInput) as error:
        chasles.ros.trajectories(tmp_path / name)
    assert f"{name}: {expected}" in str(error.value) and "\n" not in str(error.value)
