"""An object that one thread changes while another thread asks it: one error, never a crash, and questions stay parallel.

Questions are held by functions of a trajectory or by a progress function (gates.py).
"""

import copy
import threading
import time

import numpy as np
import pytest
from cubes import pose
from gates import Gate, both_at_once, held

import chasles

ORIGIN = pose(0, 0, 0)
QUESTION = "a question about it is still running"
CHANGE = "a change of it is still running"


def scene_at(gate, cube):
    scene = chasles.Scene()
    gate.open.set()
    scene.add("own", cube, motion=gate.trajectory())
    scene.add("rest", cube)
    scene.add("third", cube, pose(0, 9, 0), pose(0, 8, 0))
    gate.open.clear()
    gate.came.clear()
    return scene


# --- Scenes ---

SCENE_CHANGES = {
    "add": lambda s, cube: s.add("new", cube),
    "ignore": lambda s, cube: s.ignore("own", "rest"),
    "ignore_groups": lambda s, cube: s.ignore_groups("", ""),
    "ignore_touching_at_start": lambda s, cube: s.ignore_touching_at_start(),
    "move": lambda s, cube: s.move("rest", pose(0, 5, 0)),
    "move_all": lambda s, cube: s.move_all(np.tile(pose(0, 5, 0), (3, 1)), np.tile(pose(0, 5, 0), (3, 1))),
    "remove": lambda s, cube: s.remove("rest"),
    "set_group_hold": lambda s, cube: s.set_group_hold("", "", 0.1),
    "set_group_margin": lambda s, cube: s.set_group_margin("", "", 0.1),
    "set_hold": lambda s, cube: s.set_hold("own", "rest", 0.1),
    "set_margin": lambda s, cube: s.set_margin("own", "rest", 0.1),
}
SCENE_QUESTIONS = {
    "all_contacts": lambda s: s.all_contacts()[0].time,
    "clear_until": lambda s: s.clear_until(),
    "first_contact": lambda s: s.first_contact().time,
    "least_distance": lambda s: s.least_distance().distance_upper,
    "least_distances": lambda s: s.least_distances().upper.shape,
    "profile": lambda s: s.profile().upper.min(),
}
SCENE_READS = {"names", "untested", "view"}
SCENE_PROOFS = {"certificate", "verify"}  # of scenes without motions of one's own


def public(kind):
    return {name for name in dir(kind) if not name.startswith("_")}


def test_every_function_of_a_scene_is_known():
    """A new function of a scene has to be named above."""
    assert set(SCENE_CHANGES) | set(SCENE_QUESTIONS) | SCENE_READS | SCENE_PROOFS == public(chasles.Scene)


@pytest.mark.parametrize("change", SCENE_CHANGES)
def test_a_scene_does_not_change_while_it_is_asked(change, cube):
    gate = Gate()
    scene = scene_at(gate, cube)
    with held(gate, scene.first_contact) as answers:
        with pytest.raises(chasles.InvalidInput, match=f"scene: {QUESTION}.*change it after the answer, or change a copy"):
            SCENE_CHANGES[change](scene, cube)
        assert scene.names == ["own", "rest", "third"] and len(scene) == 3 and "3 bodies" in repr(scene)
    assert answers[0].pair == ("own", "rest") and answers[0].time == pytest.approx(0.5)
    SCENE_CHANGES[change](scene, cube)  # after the answer


@pytest.mark.parametrize("question", SCENE_QUESTIONS)
def test_every_question_keeps_a_scene_as_it_is(question, cube):
    gate = Gate()
    scene = scene_at(gate, cube)
    expected = SCENE_QUESTIONS[question](scene_at(open_gate(), cube))
    with held(gate, lambda: SCENE_QUESTIONS[question](scene)) as answers:
        with pytest.raises(chasles.InvalidInput, match=QUESTION):
            scene.remove("rest")
        other = copy.copy(scene)
        other.remove("rest")
        other.add("own copy", cube)
        assert other.names == ["own", "third", "own copy"] and scene.names == ["own", "rest", "third"]
        assert scene.untested().named == []
    assert answers == [expected]


def open_gate():
    gate = Gate()
    gate.open.set()
    gate.open.clear = lambda: None  # type: ignore[method-assign]
    return gate


def test_a_function_of_a_question_cannot_change_the_scene_that_is_asked(cube):
    scene = chasles.Scene()
    scene.add("rest", cube)

    changes_scene = [False]
    own = chasles.Trajectory(
        lambda time: (changes_scene[0] and scene.remove("rest")) or [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0],
        lambda start, end: {"turn_rate": 0, "turn_acceleration": 0, "speed": 4, "acceleration": 0},
    )
    scene.add("own", cube, motion=own)
    changes_scene[0] = True
    with pytest.raises(chasles.InvalidInput, match=f"scene: {QUESTION}"):
        scene.first_contact()
    changes_scene[0] = False
    assert scene.first_contact().pair == ("own", "rest")


def meets(barrier):
    """A trajectory that waits for the other thread at its first call of each question."""
    met = [False]

    def pose_at(time):
        if not met[0] and barrier.parties_are_wanted:
            try:
                barrier.wait(60)
                met[0] = True
            except threading.BrokenBarrierError:
                pass
        return [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0]

    return chasles.Trajectory(
        pose_at, lambda start, end: {"turn_rate": 0, "turn_acceleration": 0, "speed": 4, "acceleration": 0}
    )


@pytest.mark.parametrize("question", SCENE_QUESTIONS)
def test_two_threads_ask_a_scene_at_the_same_time(question, cube):
    barrier = threading.Barrier(2)
    barrier.parties_are_wanted = False  # type: ignore[attr-defined]
    scene = chasles.Scene()
    scene.add("own", cube, motion=meets(barrier))
    scene.add("rest", cube)
    barrier.parties_are_wanted = True  # type: ignore[attr-defined]
    first, second = both_at_once(barrier, lambda: SCENE_QUESTIONS[question](scene))
    assert first == second and not isinstance(first, Exception)


# --- Hands: an update changes the scene ---


def test_an_update_keeps_the_scene_and_the_hand(cube):
    gate = Gate()
    scene = scene_at(gate, cube)
    gate.open.set()
    hand = chasles.DraggedBody(scene, "third", margin=1e-3)
    before = scene.first_contact().time
    scene.add("mover", cube, motion=gate.trajectory())
    gate.open.clear()
    gate.came.clear()
    with held(gate, lambda: hand.update(pose(0, 7, 0))) as answers:
        for call, what, why in [
            (scene.first_contact, "scene", CHANGE),
            (scene.untested, "scene", CHANGE),
            (lambda: scene.move("rest", ORIGIN), "scene", CHANGE),
            (lambda: copy.copy(scene), "scene", CHANGE),
            (lambda: chasles.Stepper(scene, margin=0.1), "scene", CHANGE),
            (lambda: chasles.DraggedBody(scene, "rest"), "scene", CHANGE),
            (lambda: hand.update(ORIGIN), "dragged body", CHANGE),
            (lambda: hand.follow([ORIGIN]), "dragged body", CHANGE),
            (lambda: hand.pose, "dragged body", CHANGE),
        ]:
            with pytest.raises(chasles.InvalidInput, match=f"^{what}: {why}"):
                call()
        assert hand.force(pose(0, 7, 0)).shape == (6,)  # as is promised
        assert scene.names == ["own", "rest", "third", "mover"] and "third" in repr(hand)
    assert answers[0].state == "reached" and hand.pose[1, 3] == 7
    scene.remove("mover")
    assert scene.first_contact().time == before
    assert copy.deepcopy(scene_without_own(scene)).all_contacts(until=0) == []


def scene_without_own(scene):
    other = copy.copy(scene)
    other.remove("own")
    return other


def test_a_question_keeps_the_scene_of_a_hand(cube):
    gate = Gate()
    scene = scene_at(gate, cube)
    gate.open.set()
    hand = chasles.DraggedBody(scene, "third", margin=1e-3)
    gate.open.clear()
    gate.came.clear()
    with held(gate, scene.first_contact):
        for move in (lambda: hand.update(pose(0, 7, 0)), lambda: hand.follow([pose(0, 7, 0)])):
            with pytest.raises(chasles.InvalidInput, match=f"^scene: {QUESTION}"):
                move()
        assert hand.pose[1, 3] == 8
    assert hand.update(pose(0, 7, 0)).state == "reached"


# --- Steppers ---


def test_a_stepper_is_used_by_one_thread_at_a_time(cube):
    gate = Gate()
    scene = scene_at(gate, cube)
    gate.open.set()
    stepper = chasles.Stepper(scene, margin=0.01)
    gate.open.clear()
    gate.came.clear()
    with held(gate, stepper.advance) as answers:
        for call in (
            stepper.advance,
            lambda: stepper.move("rest", ORIGIN),
            lambda: stepper.pose("rest"),
            stepper.poses,
            lambda: stepper.time,
        ):
            with pytest.raises(chasles.InvalidInput, match=f"^stepper: {CHANGE}"):
                call()
        assert repr(stepper) == "<chasles.Stepper: 3 bodies advancing>"
        scene.remove("rest")  # the stepper has a copy
    assert answers[0].contacts[0].pair == ("own", "rest")
    assert stepper.time == answers[0].time and "at time 0.49" in repr(stepper)
    assert public(chasles.Stepper) == {"advance", "move", "pose", "poses", "time"}
    assert public(chasles.DraggedBody) == {"follow", "force", "margin", "pose", "update"}


# --- Robots ---

ROBOT = """<robot name="r"><link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
<link name="arm"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.9 0.1 0.1"/></geometry></collision></link>
<link name="end"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.9 0.1 0.1"/></geometry></collision></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
<joint name="elbow" type="revolute"><parent link="arm"/><child link="end"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="1" effort="1"/></joint></robot>"""

ROBOT_CHANGES = {
    "attach": lambda r, cube: r.attach("part", "arm", cube),
    "detach": lambda r, cube: r.detach("held"),
    "ignore": lambda r, cube: r.ignore("base", "end"),
    "ignore_in_scene": lambda r, cube: r.ignore_in_scene("end", "wall"),
    "set_base": lambda r, cube: r.set_base(pose(0, 1, 0)),
    "set_margin": lambda r, cube: r.set_margin("base", "end", 0.1),
    "test": lambda r, cube: r.test("base", "arm"),
}
ROBOT_READS = {
    "box_of_joints", "clear_box", "collisions", "continuous", "description", "first_contact", "first_contact_on_path", "is_tested",
    "least_distance", "limits", "link_pose", "link_poses", "links", "load", "name", "neutral", "profile", "prove_pairs", "range", "shape", "state",
    "tested_pairs", "together", "variables", "warnings", "warnings_about",
}  # fmt: skip


def test_every_function_of_a_robot_is_known():
    assert set(ROBOT_CHANGES) | ROBOT_READS == public(chasles.Robot)


@pytest.fixture
def robot(tmp_path, cube):
    (tmp_path / "robot.urdf").write_text(ROBOT)
    robot = chasles.Robot.load(tmp_path / "robot.urdf")
    robot.attach("held", "end", cube)
    return robot


@pytest.mark.parametrize("change", ROBOT_CHANGES)
def test_a_robot_does_not_change_while_its_pairs_are_proven(change, robot, cube):
    gate = Gate()
    with held(gate, lambda: robot.prove_pairs(seconds=0.2, progress=lambda done: gate.wait())) as answers:
        with pytest.raises(chasles.InvalidInput, match=f"^robot: {QUESTION}.*or change a copy"):
            ROBOT_CHANGES[change](robot, cube)
        other = copy.copy(robot)
        ROBOT_CHANGES[change](other, cube)
        assert robot.links == ["base", "arm", "end"]
    assert len(answers[0]) > 0
    ROBOT_CHANGES[change](robot, cube)


@pytest.mark.parametrize("question", ["first_contact", "first_contact_on_path", "least_distance", "profile"])
def test_a_robot_does_not_change_while_it_is_asked_about_a_scene(question, robot, cube):
    gate = Gate()
    scene = chasles.Scene()
    gate.open.set()
    scene.add("own", cube, motion=gate.trajectory())
    gate.open.clear()
    gate.came.clear()
    questions = {
        "first_contact": lambda: robot.first_contact([0, 0], [0.1, 0], scene=scene),
        "first_contact_on_path": lambda: robot.first_contact_on_path([[0, 0], [0.1, 0]], scene=scene),
        "least_distance": lambda: robot.least_distance([0, 0], [0.1, 0], scene=scene),
        "profile": lambda: robot.profile([[0, 0], [0.1, 0]], scene=scene),
    }
    with held(gate, questions[question]) as answers:
        with pytest.raises(chasles.InvalidInput, match=f"^robot: {QUESTION}"):
            robot.detach("held")
    assert not isinstance(answers[0], Exception)


# --- Managers ---


@pytest.fixture
def manager(cube):
    manager = chasles.CollisionManager()
    for x, name in enumerate("abc"):
        manager.add_object(name, cube, pose(1.5 * x, 0, 0))
    return manager


MANAGER_CHANGES = {
    "add_object": lambda m, cube: m.add_object("a", cube, pose(0, 9, 0)),
    "remove_object": lambda m, cube: m.remove_object("a"),
    "set_transform": lambda m, cube: m.set_transform("a", pose(0, 9, 0)),
}
MANAGER_QUESTIONS = {
    "first_contact": lambda m, cube: m.first_contact({"c": ORIGIN}).pair,
    "in_collision_internal": lambda m, cube: m.in_collision_internal(return_names=True),
    "in_collision_other": lambda m, cube: m.in_collision_other(m, return_names=True),
    "in_collision_single": lambda m, cube: m.in_collision_single(cube, return_names=True),
    "min_distance_internal": lambda m, cube: m.min_distance_internal(return_names=True),
    "min_distance_other": lambda m, cube: m.min_distance_other(m),
    "min_distance_single": lambda m, cube: m.min_distance_single(cube, pose(0, 5, 0), return_name=True),
}


def test_every_function_of_a_manager_is_known():
    assert set(MANAGER_CHANGES) | set(MANAGER_QUESTIONS) == public(chasles.CollisionManager)


def hold_questions(monkeypatch, wait):
    """Questions of managers wait after their scene has answered, before they read names and bodies; first_contact before."""
    from chasles import collision

    for name in ("_contacts", "_nearest_pair"):
        original = getattr(collision, name)

        def and_wait(*arguments, original=original, **options):
            found = original(*arguments, **options)
            wait()
            return found

        monkeypatch.setattr(collision, name, and_wait)
    original_pose = collision._pose

    def pose_and_wait(argument, name="transform"):
        if name.startswith("goals"):
            wait()
        return original_pose(argument, name)

    monkeypatch.setattr(collision, "_pose", pose_and_wait)


@pytest.mark.parametrize("change", MANAGER_CHANGES)
@pytest.mark.parametrize("question", MANAGER_QUESTIONS)
def test_a_manager_does_not_change_while_it_is_asked(question, change, manager, cube, monkeypatch):
    expected = MANAGER_QUESTIONS[question](manager, cube)
    gate = Gate()
    hold_questions(monkeypatch, gate.wait)
    with held(gate, lambda: MANAGER_QUESTIONS[question](manager, cube)) as answers:
        with pytest.raises(chasles.InvalidInput, match=f"^manager: {QUESTION}.*or change a copy"):
            MANAGER_CHANGES[change](manager, cube)
        other = copy.copy(manager)
        MANAGER_CHANGES[change](other, cube)
    assert answers == [expected]
    MANAGER_CHANGES[change](manager, cube)


@pytest.mark.parametrize("question", MANAGER_QUESTIONS)
def test_two_threads_ask_a_manager_at_the_same_time(question, manager, cube, monkeypatch):
    expected = MANAGER_QUESTIONS[question](manager, cube)
    barrier = threading.Barrier(2)
    hold_questions(monkeypatch, lambda: barrier.wait(60))
    assert both_at_once(barrier, lambda: MANAGER_QUESTIONS[question](manager, cube)) == [expected] * 2


def test_a_refused_change_leaves_a_manager_whole(manager, cube):
    with pytest.raises(chasles.InvalidInput):
        manager.add_object("a", cube, "here")
    assert manager.in_collision_internal() is False
    assert manager.min_distance_internal("a", return_names=True)[1] == ("a", "b")
