"""The text of every answer says what is proven: the verdict, whether it is certain, and if not, why not."""

import pytest

import chasles

AWAY, NEAR, INSIDE = ([x, 0.25, 0.25, 1, 0, 0, 0] for x in (3, 1, 0.5))
THROUGH = [-3, 0.25, 0.25, 1, 0, 0, 0]
PAST = [3, 0, 1, 1, 0, 0, 0], [-3, 0, 1, 1, 0, 0, 0]  # the face z = 0 slides along the face z = 1


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


def test_an_uncertain_answer_says_why(cube):
    for door, found in answers(cube, *PAST).items():
        assert not found.certain, door
        assert "(uncertain: " in repr(found) and "rounding error" in repr(found), (door, repr(found))


def test_an_unbounded_acceleration_is_a_reason(cube):
    motion = chasles.Trajectory(
        lambda time: [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0], lambda start, end: {"turn_rate": 0, "speed": 4}
    )
    found = chasles.first_contact(cube, cube, motion=motion, time_tolerance=1e-4)
    assert not found.certain and "(uncertain: the bounds of the motion" in repr(found), repr(found)


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


def test_least_distances_say_why_they_are_uncertain(cube):
    found = chasles.least_distance(cube, cube, *PAST)
    assert found.certain or "(uncertain: " in repr(found)
    assert pytest.approx(1) == chasles.least_distance(cube, cube, AWAY, [2, 0.25, 0.25, 1, 0, 0, 0]).distance_upper
