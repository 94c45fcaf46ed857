"""The text of every answer says what is proven: the verdict, whether it is certain, and if not, why not."""

import re

import pytest

import chasles

AWAY, NEAR, INSIDE = ([x, 0.25, 0.25, 1, 0, 0, 0] for x in (3, 1, 0.5))
THROUGH = [-3, 0.25, 0.25, 1, 0, 0, 0]


def scene_of(cube, start, goal):
    scene = chasles.Scene()
    scene.add("part", cube, start, goal)
    scene.add("post", cube)
    return scene


def answers(cube, start, goal):
    """The same question by all doors that answer in one text."""
    scene = scene_of(cube, start, goal)
    return {
        "first_contact": chasles.first_contact(cube, cube, start, goal),
        "path": chasles.first_contact_on_path(cube, cube, [start, goal]),
        "scene": scene.first_contact(),
        "all_contacts": (scene.all_contacts() or [scene.first_contact()])[0],
    }


def test_a_contact_on_the_way(cube):
    for door, found in answers(cube, AWAY, THROUGH).items():
        text = repr(found)
        assert f"contact at time {found.time:.12g}" in text, door
        assert "uncertain" not in text and "start" not in text, door
        assert ("part on post" in text) == (door in ("scene", "all_contacts"))


def test_a_contact_at_the_start_is_called_so(cube):
    for door, found in answers(cube, INSIDE, AWAY).items():
        assert "contact at the start" in repr(found) and "overlapping" in repr(found), door


def straight(**accelerations):
    """A trajectory whose faces come to lie in the planes of the other cube's faces: contact at their rims only."""
    return chasles.Trajectory(
        lambda time: [3 - 4 * time, 0, 0, 1, 0, 0, 0], lambda start, end: {"turn_rate": 0, "speed": 4} | accelerations
    )


@pytest.mark.parametrize("accelerations", [{"turn_acceleration": 0, "acceleration": 0}, {}])
def test_an_uncertain_answer_says_why(accelerations, cube):
    motion = straight(**accelerations)
    scene = chasles.Scene()
    scene.add("part", cube, motion=motion)
    scene.add("post", cube)
    for found in (chasles.first_contact(cube, cube, motion=motion), scene.first_contact(), *scene.all_contacts()):
        assert not found.certain and "(uncertain: a rounding error decides whether the features named here meet; they are " in repr(found)


CART = """<robot name="cart"><link name="base"/>
<link name="cart"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
<joint name="x" type="prismatic"><parent link="base"/><child link="cart"/><limit lower="-9" upper="9"/></joint></robot>"""


def test_an_uncertain_answer_in_stamps_says_why(cube, tmp_path):
    """Stamps are no shares of the motion: 10 is not its end."""
    (tmp_path / "cart.urdf").write_text(CART)
    robot = chasles.Robot.load(tmp_path / "cart.urdf")
    scene = chasles.Scene()
    scene.add("wall", cube, [0.5000000001, -0.5, -0.5, 1, 0, 0, 0])
    for times in (None, [10, 18]):
        found = robot.first_contact_on_path([[0], [8]], times, scene=scene)
        assert not found.certain and "(uncertain: a rounding error decides whether the features named here meet; they are " in repr(found)


SPIN = chasles.Motion.hinge([0.5, 0.5, 0], [0, 0, 1], [0, 3])
SLIDE = chasles.Motion.slider([1, 0, 0], [0, 0.5])
DIP = chasles.Motion.polynomial([[0.1, 0.2, 0.25], [0, 0, -1], [0, 0, 1]])  # lowest, without a speed, at time 0.5
SLIDES = "the features named here slide along or graze each other"


@pytest.mark.parametrize(
    "height, motion, margin, when, why",
    [
        (1.5, SPIN, 0.5, "at the start", SLIDES),
        (1.25, SLIDE, 0.25, "at the start", SLIDES),
        (1, DIP, 0, "at time 0.5", SLIDES),
        (1.25, DIP, 0.25, "at time 0.5", SLIDES),
    ],
)
def test_bodies_that_slide_are_a_reason(height, motion, margin, when, why, cube):
    """A cube on top of another one, or just the margin above it: nothing closes."""
    scene = chasles.Scene()
    scene.add("top", cube, motion=chasles.Motion.at_rest([0, 0, height, 1, 0, 0, 0]) * motion)
    scene.add("base", cube)
    found = scene.first_contact(margin=margin)
    assert found.verdict == ("contact_at_start" if when == "at the start" else "contact") and not found.certain
    assert f"contact {when} (uncertain: {why}" in repr(found)
    assert "top on base" in repr(found) and "overlapping" not in repr(found) and found.contacts


@pytest.mark.parametrize("motion", [SPIN, SLIDE])
def test_a_cube_that_moves_on_another_one_is_in_contact_at_the_start(motion, cube):
    """The surfaces touch, and nothing passes through: for a turn about one axis this is exact, as for a screw."""
    scene = chasles.Scene()
    scene.add("top", cube, motion=chasles.Motion.at_rest([0, 0, 1, 1, 0, 0, 0]) * motion)
    scene.add("base", cube)
    found = scene.first_contact()
    assert found.verdict == "contact_at_start" and found.certain and found.contacts
    assert "contact at the start, top on base" in repr(found) and "overlapping" not in repr(found)


def test_clear_answers(cube):
    for door, found in answers(cube, AWAY, [9, 0, 0, 1, 0, 0, 0]).items():
        assert "clear" in repr(found) and "contact at" not in repr(found), door


def test_answers_of_robots_say_verdict_and_pair(cube):
    robot = chasles._core._free_body(cube, "body")
    scene = chasles.Scene()
    scene.add("post", cube)
    checker = chasles.RobotChecker(robot, scene)
    rest = [0, 0, 0, 1]
    touching = checker.first_contact([3, 0.25, 0.25, *rest], [-3, 0.25, 0.25, *rest])
    assert f"contact at time {touching.time:.12g}" in repr(touching) and " on " in repr(touching)
    start = checker.first_contact([0.5, 0.25, 0.25, *rest], [3, 0.25, 0.25, *rest])
    assert "contact at the start" in repr(start) and "overlapping" in repr(start)
    near = checker.least_distance([3, 0.25, 0.25, *rest], [2, 0.25, 0.25, *rest])
    assert repr(near).startswith("<chasles.RobotClearance: 1") or repr(near).startswith("<chasles.RobotClearance: 0.99")
    assert "uncertain" not in repr(near)
    assert "touching" in repr(checker.least_distance([3, 0.25, 0.25, *rest], [0.5, 0.25, 0.25, *rest]))


def test_large_stamps_keep_what_is_after_their_point(cube):
    robot = chasles._core._free_body(cube, "body")
    scene = chasles.Scene()
    scene.add("post", cube)
    path, stamps = [[3, 0.25, 0.25, 0, 0, 0, 1], [-3, 0.25, 0.25, 0, 0, 0, 1]], [1.7e9, 1.7e9 + 0.7]
    checker = chasles.RobotChecker(robot, scene)
    touching, nearest = checker.first_contact_on_path(path, stamps), checker.least_distance_on_path(path, stamps)
    for found in (touching, nearest):
        time = float(re.search(r" at time ([0-9.]+)", repr(found))[1])
        assert 1.7e9 < found.time < 1.7e9 + 0.7 and time == pytest.approx(found.time, abs=1e-6, rel=0), repr(found)


def test_least_distances_say_why_they_are_uncertain(cube):
    touching = chasles.least_distance(cube, cube, motion=straight(turn_acceleration=0, acceleration=0))
    assert not touching.certain and "(uncertain: the bracket is wider than the tolerance)" in repr(touching)
    near = chasles.least_distance(cube, cube, AWAY, [2, 0.25, 0.25, 1, 0, 0, 0])
    assert near.certain and "uncertain" not in repr(near)
