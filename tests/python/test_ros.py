"""Trajectories of ROS: the interpolation of joint_trajectory_controller, bags, and the validator node."""

import doctest
import json
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT
from test_docs import code_of

import chasles
import chasles.ros

ARM = ROOT / "examples" / "robot" / "arm.urdf"
NAMES = ("positions", "velocities", "accelerations")


@pytest.fixture(scope="module")
def arm():
    return chasles.Robot.load(ARM)


def seconds(time):
    return {"sec": int(time), "nanosec": round(1e9 * (time - int(time)))}


def random_message(random, names, orders, count=9, first=0.0, size=1.0):
    """Points whose number of given derivatives is drawn from `orders`, in nanoseconds."""
    times = first + np.concatenate([[0], np.cumsum(random.uniform(0.1, 1.5, count - 1))])
    points = []
    for time in times:
        given = NAMES[: int(random.choice(orders))]
        points.append(
            {name: random.uniform(-size, size, len(names)).tolist() for name in given} | {"time_from_start": seconds(time)}
        )
    return {"joint_names": list(names), "points": points}


def time_of(point):
    return point["time_from_start"]["sec"] + 1e-9 * point["time_from_start"]["nanosec"]


def controller(points, time):
    """The positions that joint_trajectory_controller has at a time, by the formulas of its documentation."""
    k = max(i for i in range(len(points) - 1) if time_of(points[i]) <= time)
    a, b = points[k], points[k + 1]
    duration, t = time_of(b) - time_of(a), time - time_of(a)
    p, q = np.array(a["positions"]), np.array(b["positions"])
    if not ("velocities" in a and "velocities" in b):
        return p + t * (q - p) / duration
    v, w = np.array(a["velocities"]), np.array(b["velocities"])
    if not ("accelerations" in a and "accelerations" in b):
        square, cube = (3 * (q - p) / duration - 2 * v - w) / duration, (2 * (p - q) / duration + v + w) / duration**2
        return p + t * (v + t * (square + t * cube))
    x, y = np.array(a["accelerations"]), np.array(b["accelerations"])
    # the quintic by its six conditions
    rows = np.array([[1, 1, 1], [3, 4, 5], [6, 12, 20]], float)
    rest = np.array([q - p - duration * v - duration**2 * x / 2, duration * (w - v) - duration**2 * x, duration**2 * (y - x)])
    high = np.linalg.solve(rows, rest)
    u = t / duration
    return p + t * v + t * t * x / 2 + u**3 * (high[0] + u * (high[1] + u * high[2]))


@pytest.mark.parametrize("orders", [[1], [2], [3], [1, 2], [2, 3], [1, 2, 3]], ids=str)
def test_the_path_is_that_of_the_controller(arm, orders):
    """At 1,000 times each."""
    random = np.random.default_rng(1)
    for _ in range(4):
        message = random_message(random, arm.variables, orders)
        path = chasles.ros.joint_path(message, arm)
        assert path.times.tolist() == [time_of(point) for point in message["points"]]
        for time in random.uniform(path.times[0], path.times[-1], 250):
            assert np.abs(path.at(time) - controller(message["points"], time)).max() < 1e-13


def test_a_way_of_more_than_half_a_turn_is_the_long_one(arm):
    wrist = arm.variables.index("wrist")
    rows = np.zeros((2, 4))
    rows[1, wrist] = 4.0
    message = {
        "joint_names": arm.variables,
        "points": [{"positions": row.tolist(), "time_from_start": t} for t, row in enumerate(rows)],
    }
    assert chasles.ros.joint_path(message, arm).at(0.5)[wrist] == 2.0
    start = np.zeros(4)
    start[wrist] = -3.0
    message["points"].pop(0)  # the way to the first point is the shorter one
    path = chasles.ros.joint_path(message, arm, start=start)
    np.testing.assert_allclose([path.at(0)[wrist], path.at(1)[wrist]], [2 * np.pi - 3, 4])


def test_where_the_robot_starts(arm):
    random = np.random.default_rng(2)
    message, start = random_message(random, ["elbow", "left"], [3], first=1.5, size=0.03), np.array([0.5, 0.2, 0.1, 0.02])
    path = chasles.ros.joint_path(message, arm, start=start)
    assert path.times[0] == 0 and path.times[1] == 1.5
    np.testing.assert_array_equal(path.at(0), start)
    np.testing.assert_array_equal(path.at(2)[[0, 2]], start[[0, 2]])  # joints that are not in the message stay
    first = message["points"][0]
    rest = {"positions": start[[1, 3]].tolist(), "velocities": [0, 0], "time_from_start": seconds(0)}
    for time in np.linspace(0, 1.5, 50):  # cubic from rest
        assert np.abs(path.at(time)[[1, 3]] - controller([rest, first], time)).max() < 1e-13


class Message:
    """As rclpy and rosbags have them: members instead of keys."""

    def __init__(self, content):
        for name, value in content.items():
            setattr(self, name, [Message(v) if isinstance(v, dict) else v for v in value] if isinstance(value, list) else
                    Message(value) if isinstance(value, dict) else value)  # fmt: skip


def test_wrappers_and_members(arm):
    random = np.random.default_rng(3)
    message = random_message(random, arm.variables, [2])
    same = chasles.ros.joint_path(message, arm).at(1.0)
    empty = {"joint_names": [], "points": []}
    for wrapped in (
        {"joint_trajectory": message, "multi_dof_joint_trajectory": empty},
        {"trajectory": [{"joint_trajectory": message}], "model_id": "arm"},
        {"goal": {"trajectory": message}},
        Message({"joint_trajectory": message}),
        Message(message),
    ):
        np.testing.assert_array_equal(chasles.ros.joint_path(wrapped, arm).at(1.0), same)
    times = [point["time_from_start"] for point in message["points"]]
    for whole, rest in (("secs", "nsecs"), ("sec", "nsec"), ("sec", "nanosecs")):  # of ROS 1, and of recordings
        for point, time in zip(message["points"], times, strict=True):
            point["time_from_start"] = {whole: time["sec"], rest: time["nanosec"]}
        np.testing.assert_array_equal(chasles.ros.joint_path(message, arm).at(1.0), same)


def changed(change):
    def message(names):
        result = random_message(np.random.default_rng(4), names, [1], count=3)
        return change(result) or result

    return message


def drop(content, *keys):
    for key in keys[:-1]:
        content = content[key]
    del content[keys[-1]]


REFUSED = [
    (changed(lambda m: {"header": {}}), "message: has no points, and no trajectory or joint_trajectory that has them"),
    (changed(lambda m: {"trajectory": [m, m]}), "trajectory: there are 2; give one of them"),
    (changed(lambda m: {"multi_dof_joint_trajectory": {"joint_names": ["base"]}}), "multi_dof_joint_trajectory: has joints"),
    (
        changed(lambda m: m["joint_names"].__setitem__(0, "wais")),
        "joint_names: 'wais' is no variable of the robot, which has waist",
    ),
    (changed(lambda m: m["joint_names"].__setitem__(0, "elbow")), "joint_names: a name comes twice"),
    (changed(lambda m: m["joint_names"].pop() and None), "joint_names: 'left' is missing: give start"),
    (changed(lambda m: drop(m, "points", 1, "positions")), "points: point 1: has no positions; controllers that integrate"),
    (changed(lambda m: m["points"][1]["positions"].pop() and None), "points: point 1: positions: 3 found, and joint_names has 4"),
    (changed(lambda m: m["points"][1].update(positions=["a"] * 4)), "points: point 1: positions: not an array of numbers"),
    (changed(lambda m: m["points"][1].update(accelerations=[0] * 4)), "points: point 1: has accelerations and no velocities"),
    (
        changed(lambda m: m["points"][1].update(time_from_start=None)),
        "points: point 1: time_from_start: has neither sec nor nanosec",
    ),
    (
        changed(lambda m: m["points"][1].update(time_from_start={"sec": 1, "nsecond": 5})),
        "points: point 1: time_from_start: unknown key 'nsecond'; a time has sec or secs, and nanosec, nanosecs, nsec, nsecs",
    ),
    (
        changed(lambda m: m["points"][1].update(time_from_start={"sec": 1, "nsec": 5, "nsecs": 5})),
        "points: point 1: time_from_start: has a part in two spellings: leave one",
    ),
    (changed(lambda m: m["points"][2].update(time_from_start=0.0)), "points: point 2: time_from_start: 0 s is not later than "),
    (changed(lambda m: m.update(points=m["points"][:1])), "points: a path needs at least two, and there are 1"),
    (changed(lambda m: m.update(points={})), "points: must be a list"),
]


@pytest.mark.parametrize("message, why", REFUSED, ids=[why for _, why in REFUSED])
def test_what_is_refused(arm, message, why):
    with pytest.raises(chasles.InvalidInput) as error:
        chasles.ros.joint_path(message(list(arm.variables)), arm)
    assert str(error.value).startswith(why) and "\n" not in str(error.value)


def test_starts_that_are_refused(arm):
    message = random_message(np.random.default_rng(5), arm.variables, [1])
    with pytest.raises(chasles.InvalidInput, match=r"^start: the shape is \(2,\); \(4,\) is needed$"):
        chasles.ros.joint_path(message, arm, start=[0, 0])
    first = np.array(message["points"][0]["positions"])
    with pytest.raises(
        chasles.InvalidInput, match="^points: point 0: is due at once, and 'elbow' is 0.011 from .* tolerance of 0.01"
    ):
        chasles.ros.joint_path(message, arm, start=first + [0, 0.011, 0.009, 0])
    assert len(chasles.ros.joint_path(message, arm, start=first).times) == 9


def test_a_first_point_that_is_due_at_once(arm):
    """As planners send it: the robot is there but for a little, and whole turns of its wrist."""
    message = random_message(np.random.default_rng(8), arm.variables, [3])
    first = np.array(message["points"][0]["positions"])
    path = chasles.ros.joint_path(message, arm, start=first + [0, 0.004, 2 * np.pi, 0])
    assert len(path.times) == 10 and path.times[0] == -0.001 and path.times[1] == 0
    np.testing.assert_allclose(path.at(-0.001) - first, [0, 0.004, 0, 0], atol=1e-15)
    for time in np.linspace(0, path.times[-1], 100):
        assert np.abs(path.at(time) - controller(message["points"], min(time, path.times[-1] - 1e-9))).max() < 1e-7


def test_ways_through_zero(arm):
    """Segments of several orders that meet where all joints are 0: roundings beside 0 are no jumps."""
    random = np.random.default_rng(9)
    for _ in range(50):
        message = random_message(random, arm.variables, [1, 2, 3], count=5)
        message["points"][1] = {"positions": [0.0] * 4, "time_from_start": message["points"][1]["time_from_start"]}
        message["points"][3]["positions"] = [0.0] * 4
        path = chasles.ros.joint_path(message, arm)
        for time in random.uniform(0, path.times[-1], 20):
            assert np.abs(path.at(time) - controller(message["points"], time)).max() < 1e-13


def test_coal_contradicts_nothing(arm):
    """The same URDF file in Pinocchio, and its collision at 100 poses of each trajectory."""
    pin = pytest.importorskip("pinocchio", minversion="4")
    model = pin.buildModelFromUrdf(str(ARM), mimic=True)
    geometry = pin.buildGeomFromUrdf(model, str(ARM), pin.GeometryType.COLLISION)
    number = {item.name.removesuffix("_0"): i for i, item in enumerate(geometry.geometryObjects)}
    for a, b in arm.tested_pairs():
        geometry.addCollisionPair(pin.CollisionPair(*sorted((number[a], number[b]))))
    data, places, random, seen, met = model.createData(), geometry.createData(), np.random.default_rng(6), 0, 0
    checker = chasles.RobotChecker(arm)
    for k in range(24):
        message = random_message(random, arm.variables, [[1], [2], [3], [1, 2, 3]][k % 4], count=4, size=1.5)
        for point in message["points"]:
            point["positions"][3] = abs(point["positions"][3]) / 40
        path = chasles.ros.joint_path(message, arm)
        found = checker.first_contact_on_path(path)
        met += found.verdict == "contact"
        until = path.times[-1] if found.verdict == "clear" else found.time
        for time in np.linspace(0, until - 1e-9, 100) if found.verdict != "contact_at_start" else ():
            waist, elbow, wrist, left = controller(message["points"], time)
            q = np.array([waist, elbow, np.cos(wrist), np.sin(wrist), left])
            pin.updateGeometryPlacements(model, data, geometry, places, q)
            assert not pin.computeCollisions(geometry, places, True), (time, found)
            seen += 1
    assert seen > 1000 and met > 5, (seen, met)


@pytest.mark.parametrize("storage", ["SQLITE3", "MCAP"])
def test_files_and_bags(arm, tmp_path, storage):
    rosbags = pytest.importorskip("rosbags.rosbag2")
    from rosbags.typesys import Stores, get_typestore

    random, store = np.random.default_rng(7), get_typestore(Stores.LATEST)
    messages = [random_message(random, arm.variables, [order]) for order in (1, 2, 3)]
    with rosbags.Writer(tmp_path / "bag", version=9, storage_plugin=rosbags.StoragePlugin[storage]) as writer:
        of_arm, of_text = (
            writer.add_connection(topic, kind, typestore=store)
            for topic, kind in (
                ("/arm/joint_trajectory", "trajectory_msgs/msg/JointTrajectory"),
                ("/text", "std_msgs/msg/String"),
            )
        )
        for k, message in enumerate(messages):
            kind = "trajectory_msgs/msg/JointTrajectory"
            writer.write(of_arm, int((k + 1.5) * 1e9), store.serialize_cdr(deserialized(store, message), kind))
        writer.write(of_text, 9, store.serialize_cdr(store.types["std_msgs/msg/String"](data="x"), "std_msgs/msg/String"))
    found = chasles.ros.trajectories(tmp_path / "bag")
    assert [(topic, time) for topic, time, _ in found] == [("/arm/joint_trajectory", k + 1.5) for k in range(3)]
    (tmp_path / "one.json").write_text(json.dumps(messages[0]))
    (tmp_path / "all.yaml").write_text("".join(f"---\n{json.dumps(message)}\n" for message in messages))
    from_json, from_yaml = (chasles.ros.trajectories(tmp_path / name) for name in ("one.json", "all.yaml"))
    assert len(from_json) == 1 and len(from_yaml) == 3
    for k, message in enumerate(messages):
        path = chasles.ros.joint_path(message, arm)
        for other in (found[k], from_yaml[k], *(from_json if k == 0 else ())):
            same = chasles.ros.joint_path(other.message, arm)
            assert np.array_equal(same.times, path.times) and np.array_equal(same.at(1.0), path.at(1.0))
    with pytest.raises(chasles.InvalidInput, match="bag: has no trajectory on /other$"):
        chasles.ros.trajectories(tmp_path / "bag", ["/other"])
    with pytest.raises(chasles.InvalidInput, match="^topics: '/other' is one text"):
        chasles.ros.trajectories(tmp_path / "bag", "/other")
    (tmp_path / "bad.mcap").write_bytes(b"no bag")
    (tmp_path / "bad.yaml").write_text("a: [")
    for name, why in (
        ("bad.mcap", "bad.mcap: "),
        ("bad.yaml", "bad.yaml: "),
        ("none.mcap", "none.mcap: there is no such file or folder$"),
    ):
        with pytest.raises(chasles.InvalidInput, match=why) as error:
            chasles.ros.trajectories(tmp_path / name)
        assert "\n" not in str(error.value)


def test_bags_of_ros_1(arm, tmp_path):
    rosbags = pytest.importorskip("rosbags.rosbag1")
    from rosbags.typesys import Stores, get_typestore

    store, kind = get_typestore(Stores.ROS1_NOETIC), "trajectory_msgs/msg/JointTrajectory"
    message = random_message(np.random.default_rng(10), arm.variables, [2])
    with rosbags.Writer(tmp_path / "one.bag") as writer:
        writer.write(
            writer.add_connection("/arm", kind, typestore=store),
            5,
            store.serialize_ros1(deserialized(store, message, seq=0), kind),
        )
    ((topic, _, found),) = chasles.ros.trajectories(tmp_path / "one.bag")
    assert topic == "/arm"
    np.testing.assert_array_equal(chasles.ros.joint_path(found, arm).at(1.0), chasles.ros.joint_path(message, arm).at(1.0))


def deserialized(store, message, **of_header):
    types = store.types
    point, duration = types["trajectory_msgs/msg/JointTrajectoryPoint"], types["builtin_interfaces/msg/Duration"]
    points = [
        point(*(np.array(p.get(name, []), float) for name in (*NAMES, "effort")), duration(**p["time_from_start"]))
        for p in message["points"]
    ]
    header = types["std_msgs/msg/Header"](**of_header, stamp=types["builtin_interfaces/msg/Time"](sec=0, nanosec=0), frame_id="")
    return types["trajectory_msgs/msg/JointTrajectory"](header, message["joint_names"], points)


def test_chasles_alone_does_not_import_ros():
    code = "import sys, chasles.ros; assert not {'rclpy', 'rosbags', 'ruamel'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_page_of_the_guide_tells_the_truth(tmp_path, monkeypatch):
    pytest.importorskip("rosbags")
    monkeypatch.chdir(tmp_path)
    example = doctest.DocTestParser().get_doctest(code_of(ROOT / "docs/ros.md"), {}, "ros.md", "ros.md", 0)
    assert len(example.examples) > 8
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures, "".join(failures)
