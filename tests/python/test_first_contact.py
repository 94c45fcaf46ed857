"""One motion, one answer."""

import json
import math
import threading

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, RAGGED, matrix, pose

import chasles

START, GOAL = pose(3, 0.2, 0.3), pose(-1, 0.2, 0.3, 0.9, 0.1, 0.2, 0.3)  # docs/command-line.md


def test_first_contact(cube):
    found = chasles.first_contact(cube, cube, START, GOAL)
    assert found.verdict is chasles.Verdict.contact and found.verdict == "contact"
    assert 0.465661545123 <= found.time <= found.time_upper <= 0.465661545124
    assert 0.465540203518 <= found.tau <= found.tau_upper <= 0.465540203519
    assert found.certain
    (contact,) = found.contacts
    assert contact.kind is chasles.ContactKind.edge_edge
    assert contact.moving == (0, 3) and contact.fixed == (2, 6)
    np.testing.assert_allclose(contact.point, [1, 1, 0.14993267921487])
    np.testing.assert_allclose(contact.normal, [0.959907177974, 0.280318050925, 0], atol=1e-12)
    assert contact.approach_speed == pytest.approx(4.19796154296)
    np.testing.assert_allclose(found.pose[:3, 3], [1.14073316366, 0.51808036076, 0.08698176691])
    assert found.overlap is None and found.held == ()
    assert found.work.elementary_tests > 0


def test_clear(cube):
    found = chasles.first_contact(cube, cube, START, pose(5, 0, 0))
    assert found.verdict == chasles.Verdict.clear
    assert found.clear_until == 1 and found.contacts == ()
    assert repr(found) == "<chasles.FirstContact: clear>"


def test_contact_at_the_start(cube):
    found = chasles.first_contact(cube, cube, pose(0.5, 0.5, 0.25), pose(5, 0, 0))
    assert found.verdict == chasles.Verdict.contact_at_start
    assert found.overlap.certain and "through face" in repr(found.overlap)


def test_all_contacts_are_found_if_asked_for(cube):
    arguments = cube, cube, pose(0.25, 3, 0.5), pose(0.25, 0, 0.5)
    assert len(chasles.first_contact(*arguments).contacts) == 1
    found = chasles.first_contact(*arguments, find="first_with_all_contacts")
    assert len(found.contacts) == 4 and not found.contacts_cut
    overlapping = chasles.first_contact(cube, cube, pose(0.5, 0.5, 0.25), pose(5, 0, 0), find="first_with_all_contacts")
    assert overlapping.contacts_cut
    for find in ("first", chasles.Find.first, "any"):
        assert len(chasles.first_contact(*arguments, find=find).contacts) == 1


def test_a_verdict_has_no_truth_value(cube):
    found = chasles.first_contact(cube, cube, START, GOAL)
    with pytest.raises(TypeError, match="no truth value"):
        if found.verdict:
            pass
    with pytest.raises(TypeError, match="no truth value"):
        assert not found.verdict
    assert json.dumps({"verdict": found.verdict}) == '{"verdict": "contact"}'
    assert str(found.verdict) == "contact"


def test_words_are_those_of_the_library():
    names = ["vertex_face", "face_vertex", "edge_edge", "vertex_edge", "edge_vertex", "vertex_vertex"]
    assert [kind.value for kind in chasles.ContactKind] == names
    assert [find.value for find in chasles.Find] == ["first", "any", "first_with_all_contacts"]
    assert [verdict.value for verdict in chasles.Verdict] == ["unknown", "clear", "contact", "contact_at_start"]


def test_constraint_rows_give_the_rate_of_each_gap(cube):
    found = chasles.first_contact(
        cube, cube, pose(0.25, 3, 0.5), pose(0.25, 0, 0.5), find="first_with_all_contacts"
    )
    rows = chasles.constraint_rows(found.contacts)
    assert rows.shape == (4, 6) and rows.dtype == np.float64
    rates = rows @ [0, -3, 0, 0, 0, 0]
    np.testing.assert_allclose(rates, [-contact.approach_speed for contact in found.contacts])
    assert chasles.constraint_rows([]).shape == (0, 6)


@pytest.mark.parametrize("kind", ["matrix", "float32", "int", "list", "strided", "fortran", "scaled quaternion"])
def test_poses_of_any_kind(cube, kind):
    start, goal = {
        "matrix": (matrix(3, 0, 0), matrix(0, 0, 0)),
        "float32": (matrix(3, 0, 0).astype(np.float32), matrix(0, 0, 0).astype(np.float32)),
        "int": (matrix(3, 0, 0).astype(int), np.eye(4, dtype=np.int8)),
        "list": (matrix(3, 0, 0).tolist(), (0, 0, 0, 1, 0, 0, 0)),
        "strided": (np.repeat(pose(3, 0, 0), 2)[::2], np.repeat(pose(0, 0, 0), 3)[::3]),
        "fortran": (np.asfortranarray(matrix(3, 0, 0)), np.asfortranarray(matrix(0, 0, 0))),
        "scaled quaternion": (pose(3, 0, 0, 1e-200, 0, 0, 0), pose(0, 0, 0, -1e200, 0, 0, 0)),
    }[kind]
    assert chasles.first_contact(cube, cube, start, goal).time == pytest.approx(2 / 3)


def test_a_matrix_in_single_precision_is_taken_for_the_nearest_rotation(cube):
    angle = 0.3
    turned = np.eye(4, dtype=np.float32)
    turned[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
    found = chasles.first_contact(cube, cube, matrix(3, 0, 0), turned)
    assert found.motion.angle == pytest.approx(angle, abs=1e-7)


@pytest.mark.parametrize(
    ("bad", "why"),
    [
        ([1, 2], r"the shape is \(2,\); a pose has \(4, 4\), or \(7,\)"),
        (np.eye(3), r"the shape is \(3, 3\)"),
        (np.eye(4)[:3], r"the shape is \(3, 4\)"),
        (np.empty((0, 7)), r"the shape is \(0, 7\)"),
        (np.full((4, 4), np.nan), "NaN"),
        (np.full(7, np.inf), "NaN or infinite"),
        (np.zeros((4, 4)), "last row"),
        (np.diag([1, 1, 0, 1]), "not a rotation"),
        (np.diag([1, 1, -1, 1]), "reflection"),
        (np.diag([2, 2, 2, 1]), "not a rotation"),
        (np.zeros(7), "quaternion"),
        (pose(1e40, 0, 0), "1e30"),
        ("here", "not an array of real numbers"),
        (["1"] * 7, "not an array of real numbers"),
        (b"1234567", "not an array of real numbers"),
        ([1j] * 7, "not an array of real numbers"),
        ([True] * 7, "not an array of real numbers"),
        (object(), "not an array of real numbers"),
        ({}, "not an array of real numbers"),
        ([[1, 2], [3]], RAGGED),
        (5, r"the shape is \(\)"),
    ],
)
@pytest.mark.parametrize("name", ["start", "goal"])
def test_what_is_no_pose_is_refused_by_name(cube, name, bad, why):
    poses = {"start": START, "goal": GOAL, name: bad}
    with pytest.raises(chasles.InvalidInput, match=f"{name}: .*{why}"):
        chasles.first_contact(cube, cube, **poses)


@pytest.mark.parametrize(
    ("options", "why"),
    [
        ({"margin": -1}, "margin"),
        ({"margin": math.nan}, "margin"),
        ({"time_tolerance": 0}, "time_tolerance|tolerance"),
        ({"max_turn": 0}, "max_turn"),
        ({"find": "last"}, "find: 'last': must be"),
        ({"find": 3}, "find: 3: must be"),
        ({"find": None}, "find: None: must be"),
        ({"margin": 0.1, "hold": 0.1}, "hold: .* less than the margin"),
        ({"hold": 0.0}, "hold: .* less than the margin"),
        ({"fixed_start": START}, "fixed_start and fixed_goal are needed together"),
        ({"motion": chasles.ScrewMotion.between(START, GOAL)}, "only one of them is allowed"),
        ({"start": None}, "start and goal are needed"),
        ({"start": None, "goal": None, "motion": 5}, "motion: 5 must be a motion, such as"),
    ],
)
def test_options_out_of_range_are_refused(cube, options, why):
    with pytest.raises(chasles.InvalidInput, match=why):
        chasles.first_contact(cube, cube, **{"start": START, "goal": GOAL, **options})


def test_max_turn_belongs_to_the_motion(cube):
    screw = chasles.ScrewMotion.between(START, GOAL, max_turn=0.05)
    with pytest.raises(chasles.InvalidInput, match="max_turn: belongs to the motion, which is given"):
        chasles.first_contact(cube, cube, motion=screw, max_turn=0.05)
    found = chasles.first_contact(cube, cube, START, GOAL, max_turn=0.05)
    assert found.motion.max_turn == 0.05
    assert chasles.first_contact(cube, cube, motion=screw).time == found.time
    fixed = {"fixed_start": pose(0, 0, 0), "fixed_goal": pose(0, 0, 1)}
    assert chasles.first_contact(cube, cube, START, GOAL, **fixed, max_turn=0.05).motion.max_turn == 0.05


NAMED = {
    "screw": chasles.ScrewMotion,
    "sweep": chasles.SweepMotion,
    "velocity": chasles.ConstantVelocity,
    "twist": chasles.ConstantTwist,
}


@pytest.mark.parametrize("name", NAMED)
def test_the_motion_between_poses_may_be_named(name, cube):
    """As in batches: the answers are those of the motion itself, also for two moving bodies."""
    kind = NAMED[name]
    motion = kind.between(START, GOAL)
    for ask in (chasles.first_contact, chasles.least_distance):
        named = ask(cube, cube, START, GOAL, motion=name)
        assert named.time == ask(cube, cube, motion=motion).time and type(named.motion) is kind
    fixed = {"fixed_start": pose(0, 0, 0), "fixed_goal": pose(0, 0.1, 0.2)}
    both = (
        kind.relative(START, GOAL, *fixed.values())
        if hasattr(kind, "relative")
        else chasles.relative(motion, kind.between(*fixed.values()))
    )
    moving = chasles.first_contact(cube, cube, START, GOAL, motion=name, **fixed)
    assert moving.time == chasles.first_contact(cube, cube, motion=both).time


def test_a_named_motion_needs_poses_and_a_right_name(cube):
    with pytest.raises(chasles.InvalidInput, match="motion: 'helix': must be 'screw', 'sweep', 'velocity' or 'twist'"):
        chasles.first_contact(cube, cube, START, GOAL, motion="helix")
    with pytest.raises(chasles.InvalidInput, match="motion: start and goal are needed"):
        chasles.first_contact(cube, cube, motion="velocity")
    with pytest.raises(chasles.InvalidInput, match="max_turn: belongs to motion='screw', and the motion is 'twist'"):
        chasles.first_contact(cube, cube, START, GOAL, motion="twist", max_turn=0.1)
    assert chasles.first_contact(cube, cube, START, GOAL, motion="screw", max_turn=0.05).motion.max_turn == 0.05
    with pytest.raises(chasles.InvalidInput, match="With poses, the motion may be 'screw', 'sweep'"):
        chasles.first_contact(cube, cube, START, GOAL, motion=chasles.ScrewMotion.between(START, GOAL))


def test_a_path_at_the_limit_says_which_segments_are_proven(cube):
    with chasles.Limit(1e-9):
        found = chasles.first_contact_on_path(cube, cube, [START, GOAL])
    assert found.verdict == "unknown" and found.segment == 0 and found.clear_until == 0
    assert repr(found) == "<chasles.PathContact: unknown: the limit was reached; proven clear until 0 in segment 0>"


def test_bodies_swap_their_roles(cube):
    small = chasles.Polyhedron(CUBE_VERTICES / 2, cube.faces)
    found = chasles.first_contact(small, cube, START, GOAL)
    other = found.swapped()
    assert (other.moving is cube, other.fixed is small, other.is_swapped) == (True, True, True)
    assert (other.verdict, other.time, other.margin) == (found.verdict, found.time, found.margin)
    np.testing.assert_array_equal(other.fixed_pose, found.pose)
    np.testing.assert_array_equal(other.pose, found.fixed_pose)
    np.testing.assert_array_equal(found.fixed_pose, np.eye(4))
    np.testing.assert_array_equal(other.contacts[0].normal, -found.contacts[0].normal)
    assert (other.contacts[0].moving, other.contacts[0].fixed) == (found.contacts[0].fixed, found.contacts[0].moving)
    assert repr(other.swapped()) == repr(found) and not other.swapped().is_swapped
    path = chasles.first_contact_on_path(small, cube, [pose(5, 0, 0), START, GOAL])
    assert path.swapped().segment == path.segment == 1 and path.swapped().moving is cube


def test_invalid_input_is_a_value_error_of_one_line(cube):
    with pytest.raises(ValueError) as caught:
        chasles.first_contact(cube, cube, START, np.zeros(7))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("wrong", [None, CUBE_VERTICES, "cube.obj"])
def test_what_is_no_body_is_a_type_error(wrong, cube):
    for bodies in ((wrong, cube), (cube, wrong)):
        with pytest.raises(TypeError, match="must be a chasles.Polyhedron"):
            chasles.first_contact(*bodies, START, GOAL)


@pytest.mark.filterwarnings("ignore:nanobind")
def test_what_nothing_was_put_into_is_refused(cube):
    empty = chasles.Polyhedron.__new__(chasles.Polyhedron)
    with pytest.raises(TypeError):
        chasles.first_contact(empty, cube, START, GOAL)
    with pytest.raises(TypeError):
        getattr(empty, "vertices")
    motion = chasles.ScrewMotion.__new__(chasles.ScrewMotion)
    with pytest.raises(chasles.InvalidInput, match="^motion: a ScrewMotion must be a motion, such as"):
        chasles.first_contact(cube, cube, motion=motion)


def test_answers_have_a_readable_repr(cube):
    found = chasles.first_contact(cube, cube, START, GOAL)
    assert repr(found) == "<chasles.FirstContact: contact at time 0.465661545123, 1 contact: edge 0-3 on edge 2-6>"
    assert repr(found.contacts[0]).startswith("<chasles.Contact: edge 0-3 on edge 2-6 at (1, 1, 0.149933)")
    assert repr(found.work).startswith("Work(node_pairs=")


def test_threads_share_bodies(cube):
    expected = chasles.first_contact(cube, cube, START, GOAL).time
    times = []
    threads = [
        threading.Thread(
            target=lambda: times.extend(chasles.first_contact(cube, cube, START, GOAL).time for _ in range(200))
        )
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert times == [expected] * 800


def test_margin_is_a_distance_of_the_surfaces(cube):
    found = chasles.first_contact(cube, cube, pose(4, 0, 0), pose(0, 0, 0), margin=0.5)
    assert found.time == pytest.approx(2.5 / 4)
    assert found.contacts[0].gap == pytest.approx(0.5)


def test_bodies_that_are_held_go_on(cube):
    start, goal = pose(1.005, 0, 0), pose(3, 0, 0)
    assert chasles.first_contact(cube, cube, start, goal, margin=0.01).verdict == "contact_at_start"
    found = chasles.first_contact(cube, cube, start, goal, margin=0.01, hold=0.001)
    assert found.verdict == "clear" and found.held
    path = chasles.first_contact_on_path(cube, cube, [start, goal], margin=0.01, hold=0.001)
    assert path.verdict == "clear" and path.held


def test_a_memory_changes_no_answer():
    box, table = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES), chasles.Polyhedron(CUBE_VERTICES * [9, 9, 1], CUBE_FACES)
    memory = chasles.PairMemory(box, table)
    at = np.array([4, 4, 1.015, 1, 0, 0, 0])
    for i in range(50):
        goal = at + [0.01, -0.005, 0.004 * (-1) ** i, 0, 0, 0, 0]
        options = {"margin": 0.02, "hold": 0.01, "find": "first_with_all_contacts"}
        found = chasles.first_contact(box, table, at, goal, memory=memory, **options)
        expected = chasles.first_contact(box, table, at, goal, **options)
        assert found.verdict == expected.verdict
        assert found.clear_until == pytest.approx(expected.clear_until, abs=1e-12)
        assert len(found.held) == len(expected.held) == 4
        at = goal
    with pytest.raises(chasles.InvalidInput, match="query: memory: is of other bodies"):
        chasles.first_contact(table, box, at, goal, memory=memory)
    with pytest.raises(TypeError, match="moving: must be a chasles.Polyhedron"):
        chasles.PairMemory(None, box)
