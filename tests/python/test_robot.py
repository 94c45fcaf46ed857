"""Robots: answers of a small arm, and real robots beside Pinocchio where it is installed."""

import pickle

import numpy as np
import pytest

import chasles

ARM = """<robot name="arm">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.9 0.1 0.1"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.5 0 0"/><geometry><cylinder radius="0.05" length="0.2"/></geometry></collision>
  </link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
</robot>"""


@pytest.fixture
def arm(tmp_path):
    (tmp_path / "arm.urdf").write_text(ARM)
    return chasles.Robot.load(tmp_path / "arm.urdf")


@pytest.fixture
def world(cube):
    scene = chasles.Scene()
    scene.add("wall", cube, pose=np.array([0.45, 1.2, -0.5, 1, 0, 0, 0]))
    return scene


def test_a_robot_has_names_limits_and_poses(arm):
    assert arm.variables == ["shoulder", "elbow"] and arm.links == ["base", "upper", "lower"]
    np.testing.assert_array_equal(arm.limits, [[-3, 3], [-np.inf, np.inf]])
    np.testing.assert_array_equal(arm.neutral(), [0, 0])
    np.testing.assert_allclose(arm.link_pose("lower", [np.pi / 2, 0])[:3, 3], [0, 1, 0], atol=1e-15)
    assert arm.link_poses([0, 0])["lower"][0, 3] == 1
    assert not arm.is_tested("upper", "lower")
    assert arm.tested_pairs() == []
    arm.test("upper", "lower")
    assert arm.tested_pairs() == [("upper", "lower")]
    assert "arm, 3 links, 2 variables" in repr(arm)


def test_the_first_contact_names_the_pair_and_the_configuration(arm, world):
    found = arm.first_contact([0, 0], [np.pi / 2, 0], scene=world)
    assert found.verdict == "contact" and found.pair == ("lower", "wall") and found.certain
    assert 0 < found.clear_until <= found.time <= found.time_upper < 1
    np.testing.assert_allclose(found.configuration, [np.pi / 2 * found.time, 0], atol=1e-14)
    assert found.contacts[0].point[1] == pytest.approx(1.2, abs=1e-9)  # the face of the wall
    checker = chasles.RobotChecker(arm, world)
    assert checker.is_clear([0, 0]) and checker.is_clear([0, 0], found.clear_configuration * 0.999)
    assert not checker.is_clear([0, 0], [np.pi / 2, 0])
    assert checker.pairs_in_contact([0, 0]) == []
    assert checker.pairs_in_contact(found.configuration + [0.01, 0]) == [("lower", "wall")]
    assert arm.first_contact([0, 0], [np.pi / 2, 0]).verdict == "clear"  # without the world


def test_paths_have_segments_and_stamps(arm, world):
    straight = arm.first_contact_on_path([[0, 0], [0.1, 0], [np.pi / 2, 0]], scene=world)
    timed = arm.first_contact_on_path([[0, 0], [0.1, 0], [np.pi / 2, 0]], [5, 6, 8], scene=world)
    assert straight.segment == timed.segment == 1
    assert timed.time == pytest.approx(6 + 2 * straight.time, abs=1e-12)
    rates = np.zeros((2, 2))
    cubic = arm.first_contact_on_path([[0, 0], [np.pi / 2, 0]], [0, 1], rates, scene=world)
    quintic = arm.first_contact_on_path([[0, 0], [np.pi / 2, 0]], [0, 1], rates, rates, scene=world)
    edge = arm.first_contact([0, 0], [np.pi / 2, 0], scene=world)
    t = cubic.time
    assert 3 * t**2 - 2 * t**3 == pytest.approx(edge.time, abs=1e-9)
    t = quintic.time
    assert 10 * t**3 - 15 * t**4 + 6 * t**5 == pytest.approx(edge.time, abs=1e-9)


def test_polynomials_are_laid_out_as_by_scipy(arm, world):
    breaks = np.array([0.0, 0.5, 2.0])
    positions = np.array([[-1.0, 0.2], [0.5, -0.4], [1.5, 0.3]])
    velocities = np.array([[1.0, 0.0], [2.0, -0.1], [0.0, 0.3]])
    h = np.diff(breaks)[:, None]
    change = np.diff(positions, axis=0) / h
    coefficients = np.array(
        [
            (velocities[:-1] + velocities[1:] - 2 * change) / h**2,
            (3 * change - 2 * velocities[:-1] - velocities[1:]) / h,
            velocities[:-1],
            positions[:-1],
        ]
    )
    path = chasles.JointPath.polynomials(arm, breaks, coefficients)
    splines = chasles.JointPath.cubic(arm, breaks, positions, velocities)
    np.testing.assert_array_equal(path.times, breaks)
    for time in np.linspace(-1, 3, 41):
        np.testing.assert_allclose(path.at(time), splines.at(time), atol=1e-14)
        s = int(min(max(time, 0), 2) > 0.5)
        local = min(max(time, 0), 2) - breaks[s]
        by_hand = [np.polyval(coefficients[:, s, i], local) for i in range(2)]
        np.testing.assert_allclose(path.at(time), by_hand, atol=1e-14)
    found = arm.first_contact_on_path(path, scene=world)
    expected = arm.first_contact_on_path(positions, breaks, velocities, scene=world)
    assert found.verdict == expected.verdict == "contact" and found.pair == expected.pair
    assert abs(found.time - expected.time) < 1e-9 and found.time > 0.5 and found.segment == 1
    checker = chasles.RobotChecker(arm, world)
    assert checker.first_contact_on_path(path).time == found.time
    assert checker.least_distance_on_path(path).distance == 0


def test_paths_are_made_once_and_asked_often(arm, world):
    positions = [[0, 0], [1, 0], [1.5, 0]]
    straight = chasles.JointPath.straight(arm, positions, [0, 2, 3])
    expected = arm.first_contact_on_path(positions, [0, 2, 3], scene=world)
    assert arm.first_contact_on_path(straight, scene=world).time == expected.time
    natural = chasles.JointPath.natural_spline(arm, [0, 2, 3], positions)
    for time, position in zip([0, 2, 3], positions):
        np.testing.assert_allclose(natural.at(time), position, atol=1e-14)
    step = 1e-4  # second derivatives vanish at both ends
    for time in (0, 3 - 2 * step):
        second = (natural.at(time) - 2 * natural.at(time + step) + natural.at(time + 2 * step)) / step**2
        np.testing.assert_allclose(second, 0, atol=1e-3)
    still = np.zeros((3, 2))
    quintic = chasles.JointPath.quintic(arm, [0, 2, 3], positions, still, still)
    np.testing.assert_allclose(quintic.at(1), [0.5, 0], atol=1e-15)


def test_wrong_paths_are_refused(arm):
    with pytest.raises(chasles.InvalidInput, match=r"coefficients: must have the shape \(powers, segments, variables\)"):
        chasles.JointPath.polynomials(arm, [0, 1], np.zeros((2, 2)))
    with pytest.raises(chasles.InvalidInput, match="breaks: there must be 2 for 1 segments, and there are 3"):
        chasles.JointPath.polynomials(arm, [0, 1, 2], np.zeros((2, 1, 2)))
    with pytest.raises(chasles.InvalidInput, match="segment 0"):
        chasles.JointPath.polynomials(arm, [0, 1], np.zeros((2, 1, 3)))
    with pytest.raises(chasles.InvalidInput, match="segment 1"):  # a jump
        chasles.JointPath.polynomials(arm, [0, 1, 2], [[[0, 0], [1, 0]]])
    with pytest.raises(chasles.InvalidInput, match="must end later"):
        chasles.JointPath.polynomials(arm, [1, 1], np.zeros((2, 1, 2)))
    path = chasles.JointPath.straight(arm, [[0, 0], [1, 0]])
    with pytest.raises(chasles.InvalidInput, match="times: a JointPath has its own"):
        arm.first_contact_on_path(path, [0, 1])
    with pytest.raises(chasles.InvalidInput, match="time: must be a finite number"):
        path.at(np.nan)


def test_many_edges_are_answered_as_one_by_one(arm, world):
    random = np.random.default_rng(1)
    starts, goals = random.uniform(-1, 1, (2, 40, 2))
    table = chasles.first_contacts_on_edges(arm, starts, goals, scene=world)
    for row, start, goal in zip(table, starts, goals):
        found = arm.first_contact(start, goal, scene=world)
        assert (row["verdict"], row["clear_until"]) == (found.verdict, found.clear_until)
        if found.pair:
            assert (row["time"], row["time_upper"], row["certain"]) == (found.time, found.time_upper, found.certain)
        else:
            assert np.isnan([row["time"], row["time_upper"]]).all() and row["certain"]
        assert (row["first"], row["second"]) == (found.pair or ("", ""))
    assert {"clear", "contact"} <= set(table["verdict"])


def test_edges_that_cannot_be_used_are_marked(arm, world):
    starts, goals = np.zeros((7, 2)), np.tile([np.pi / 2, 0], (7, 1))
    expected = chasles.first_contacts_on_edges(arm, starts, goals, scene=world)[0]
    starts[1, 0], goals[3, 1], goals[4, 0] = np.nan, np.inf, 1e6
    with pytest.raises(chasles.InvalidInput, match="edge 1"):
        chasles.first_contacts_on_edges(arm, starts, goals, scene=world)
    table = chasles.first_contacts_on_edges(arm, starts, goals, scene=world, errors="mark")
    assert np.flatnonzero(table["verdict"] == "error").tolist() == [1, 3, 4]
    assert np.isnan(table["time"][[1, 3, 4]]).all() and (table["clear_until"][[1, 3, 4]] == 0).all()
    assert all(table[i] == expected for i in (0, 2, 5, 6))
    assert len(chasles.first_contacts_on_edges(arm, np.zeros((0, 2)), np.zeros((0, 2)), errors="mark")) == 0
    for starts, goals, message in [
        (np.zeros((2, 3)), np.zeros((2, 3)), "starts: the shape is (2, 3); (n, 2) is needed"),
        (np.zeros((2, 2)), np.zeros((3, 2)), "starts, goals: 2 starts and 3 goals"),
        ("no", np.zeros((2, 2)), "starts: not an array of numbers"),
    ]:
        with pytest.raises(chasles.InvalidInput) as error:
            chasles.first_contacts_on_edges(arm, starts, goals, errors="mark")
        assert str(error.value).startswith(message)


def test_answers_have_no_truth_value(arm, world, cube):
    scene = chasles.Scene()
    scene.add("cube", cube)
    path = np.array([[0, 0, 0, 1, 0, 0, 0], [1, 0, 0, 1, 0, 0, 0]], float)
    answers = [
        arm.first_contact(np.zeros(2), np.zeros(2)),
        chasles.RobotChecker(arm, world).first_contact(np.zeros(2), np.zeros(2)),
        chasles.first_contact(cube, cube, path[1] + [4, 0, 0, 0, 0, 0, 0], path[1] + [5, 0, 0, 0, 0, 0, 0]),
        chasles.first_contact_on_path(cube, cube, path + [5, 0, 0, 0, 0, 0, 0]),
        scene.first_contact(),
    ]
    for found in answers:
        with pytest.raises(TypeError, match="compare its verdict"):
            bool(found)


def test_edges_of_a_checker_take_no_other_scene_and_margin(arm, world):
    checker = chasles.RobotChecker(arm, world, margin=0.01)
    starts = goals = np.zeros((3, 2))
    expected = chasles.first_contacts_on_edges(arm, starts, goals, scene=world, margin=0.01)
    table = chasles.first_contacts_on_edges(checker, starts, goals)
    for name in expected.dtype.names:
        np.testing.assert_array_equal(table[name], expected[name])
    for name, value in (("scene", world), ("margin", 0.01)):
        with pytest.raises(chasles.InvalidInput, match=f"^{name}: the checker has its own"):
            chasles.first_contacts_on_edges(checker, starts, goals, **{name: value})


def test_a_robot_is_pickled_with_all_its_changes(arm, world, cube):
    arm.set_base(np.array([0.1, 0.2, 0.3, 0.9, 0.1, 0.2, 0.3]))
    arm.attach("box", "lower", cube, pose=np.array([1, -0.5, -0.5, 1, 0, 0, 0]), touch_links=["upper"])
    arm.ignore("base", "lower")
    arm.test("upper", "lower")
    arm.ignore_in_scene("box", "wall")
    arm.set_margin("upper", "lower", 0.125)
    again = pickle.loads(pickle.dumps(arm))
    assert (again.variables, again.links, again.continuous) == (arm.variables, arm.links, [False, True])
    np.testing.assert_array_equal(again.limits, arm.limits)
    for a, b in [("base", "lower"), ("upper", "lower"), ("box", "upper"), ("box", "lower"), ("box", "base")]:
        assert again.is_tested(a, b) == arm.is_tested(a, b)
    random = np.random.default_rng(4)
    starts, goals = random.uniform(-2, 2, (2, 40, 2))
    tables = [chasles.first_contacts_on_edges(robot, starts, goals, scene=world) for robot in (arm, again)]
    for name in tables[0].dtype.names:
        np.testing.assert_array_equal(tables[0][name], tables[1][name])
    assert len(set(tables[0]["verdict"])) > 1
    assert pickle.dumps(again) == pickle.dumps(pickle.loads(pickle.dumps(again)))
    assert chasles.RobotChecker(arm, world).robot.variables == arm.variables


def test_how_near_it_comes(arm, world):
    found = arm.least_distance([0, 0], [0.3, 0], scene=world)
    checker = chasles.RobotChecker(arm, world)
    assert found.pair is not None and found.certain
    assert 0 < found.distance <= found.distance_upper <= found.distance * (1 + 1e-6)
    assert checker.is_clear([0, 0], [0.3, 0])
    near = chasles.RobotChecker(arm, world, margin=found.distance_upper * (1 + 1e-9))
    apart = chasles.RobotChecker(arm, world, margin=found.distance * (1 - 1e-9))
    assert apart.is_clear([0, 0], [0.3, 0]) and not near.is_clear([0, 0], [0.3, 0])
    assert found.contacts[0].gap == pytest.approx(found.distance_upper)
    same = checker.least_distance_on_path([[0, 0], [0.3, 0]], [4, 6])
    assert same.distance_upper == pytest.approx(found.distance_upper, rel=1e-9)
    assert same.time == pytest.approx(4 + 2 * found.time)
    assert same.configuration == pytest.approx(found.configuration)
    touch = checker.least_distance([0, 0], [np.pi / 2, 0])
    assert (touch.distance, touch.distance_upper) == (0, 0)
    assert touch.time == pytest.approx(checker.first_contact([0, 0], [np.pi / 2, 0]).time)
    assert chasles.Robot.least_distance.__doc__ and "RobotClearance" in repr(touch)
    with pytest.raises(chasles.InvalidInput, match="tolerance: must be in"):
        checker.least_distance([0, 0], [1, 0], tolerance=0)
    with chasles.Limit(1e-9):
        cut = checker.least_distance([0, 0], [0.3, 0])
    assert not cut.certain and 0 <= cut.distance <= found.distance_upper and cut.distance_upper >= found.distance


def test_parts_and_pairs(arm, world, cube):
    arm.attach("box", "lower", cube, pose=np.array([1, -0.5, -0.5, 1, 0, 0, 0]))
    assert arm.first_contact([-1, 0], [np.pi / 2, 0], scene=world).pair == ("box", "wall")
    arm.ignore_in_scene("box", "wall")
    assert arm.first_contact([-1, 0], [np.pi / 2, 0], scene=world).pair == ("lower", "wall")
    arm.detach("box")
    with pytest.raises(chasles.InvalidInput, match="box: there is no such part"):
        arm.detach("box")


def test_shapes_of_links(arm):
    (shape, pose, deviation), *others = arm.collisions("lower")
    assert not others and 0 < deviation <= 0.01 * 0.05
    np.testing.assert_allclose(pose[:3, 3], [0.5, 0, 0])
    assert 0.05 <= np.linalg.norm(shape.vertices[:, :2], axis=1).max() <= 0.05 + deviation
    with pytest.raises(chasles.InvalidInput, match="elbow: there is no such link"):
        arm.collisions("elbow")


def test_pairs_are_proven(arm):
    (proof,) = arm.prove_pairs()
    assert proof.links == ("upper", "lower") and proof.reason == "adjacent" and proof.witness is None


def test_a_page_shows_the_robot(arm, world, tmp_path):
    page = chasles.write_robot_page(arm, [[0, 0], [1.5, 0]], tmp_path / "page.html", scene=world)
    text = page.read_text(encoding="utf-8")
    assert "upper" in text and "wall" in text
    spline = chasles.JointPath.cubic(arm, [0, 4], [[0, 0], [1.5, 0]], np.zeros((2, 2)))
    page = chasles.write_robot_page(arm, spline, tmp_path / "spline.html", scene=world)
    assert page.read_text(encoding="utf-8") != text


def test_wrong_arguments_are_refused(arm, tmp_path):
    with pytest.raises(chasles.InvalidInput, match="configuration 1: has 3 values, and the robot has 2 variables"):
        arm.first_contact([0, 0], [0, 0, 0])
    with pytest.raises(chasles.InvalidInput, match="elbow is not a finite number"):
        arm.first_contact([0, np.nan], [0, 0])
    with pytest.raises(chasles.InvalidInput, match="shape"):
        arm.first_contact_on_path([0, 0])
    with pytest.raises(TypeError, match="scene: must be a chasles.Scene"):
        arm.first_contact([0, 0], [0, 0], scene=3)
    with pytest.raises(chasles.InvalidInput, match="nowhere.urdf"):
        chasles.Robot.load(tmp_path / "nowhere.urdf")
    (tmp_path / "bad.urdf").write_text(ARM.replace('link="lower"/><origin', 'link="hand"/><origin'))
    with pytest.raises(chasles.InvalidInput, match=r"bad.urdf:\d+: <joint elbow>: child: there is no link 'hand'"):
        chasles.Robot.load(tmp_path / "bad.urdf")


def test_a_checker_refuses_its_options_at_once(arm):
    for options, why in (
        ({"margin": 0.01, "hold": 0.02}, "query: hold: 0.02 is not less than the margin 0.01"),
        ({"hold": 0.02}, "query: hold: 0.02 is not less than the margin, which is 0 unless one is given"),
    ):
        with pytest.raises(chasles.InvalidInput, match=why):
            chasles.RobotChecker(arm, **options)


def test_packages_that_are_not_used_make_a_warning(tmp_path):
    (tmp_path / "arm.urdf").write_text(ARM)
    robot = chasles.Robot.load(tmp_path / "arm.urdf", packages={"foo": "/none"})
    assert robot.warnings == ["packages: no collision shape has a mesh of 'foo', and there is no folder /none"]


def test_speeds_are_those_of_the_times_beside_them(cube):
    """A slide of 10 until a face at 3: at 1 per stamp of 10, and at 10 per segment."""
    robot = chasles.Robot(
        links=[{"name": "base"}, {"name": "slider", "collisions": [cube]}],
        joints=[{"name": "x", "type": "prismatic", "parent": "base", "child": "slider"}],
    )
    world = chasles.Scene()
    world.add("wall", cube, pose=[4, 0, 0, 1, 0, 0, 0])
    ends, stamps, rates = [[0], [10]], [5, 15], [[1], [1]]
    for found, time, speed in [
        (robot.first_contact_on_path(ends, scene=world), 0.3, 10),
        (robot.first_contact_on_path(ends, stamps, scene=world), 8, 1),
        (robot.first_contact_on_path(ends, stamps, rates, scene=world), 8, 1),
        (robot.first_contact_on_path(chasles.JointPath.cubic(robot, stamps, ends, rates), scene=world), 8, 1),
        (robot.first_contact_on_path([[0], [2], [10]], [5, 6, 14], scene=world), 7, 1),
        (chasles.RobotChecker(robot, world).least_distance_on_path(ends, stamps), 8, 1),
    ]:
        assert found.time <= time <= found.time_upper and found.time_upper - found.time < 1e-9
        assert found.contacts[0].approach_speed == pytest.approx(speed, rel=1e-9)
