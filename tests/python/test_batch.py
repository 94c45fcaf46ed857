"""Many motions and many paths at once."""

import math
import multiprocessing
import re

import numpy as np
import pytest
from cubes import CUBE_VERTICES, RAGGED, matrix, pose, random_motions

import chasles


def assert_same_rows(first, second):
    for name in first.dtype.names:
        np.testing.assert_array_equal(first[name], second[name], err_msg=name)


def test_a_batch_answers_as_single_questions_do(cube):
    starts, goals = random_motions(300)
    table = chasles.first_contact_batch(cube, cube, starts, goals)
    assert table.dtype == chasles.motion_dtype
    np.testing.assert_array_equal(table["id"], np.arange(300))
    assert 100 < np.count_nonzero(table["verdict"] == chasles.Verdict.contact) < 200
    for row, start, goal in zip(table, starts, goals):
        found = chasles.first_contact(cube, cube, start, goal, find="first")
        assert row["verdict"] == found.verdict and row["certain"] == found.certain
        assert row["clear_until"] == found.clear_until
        if found.verdict == "clear":
            assert np.isnan([row["time"], row["tau_upper"], row["px"], row["nz"]]).all() and row["kind"] == ""
            assert row["moving_feature"].tolist() == [-1, -1]
            continue
        assert (row["time"], row["time_upper"]) == (found.time, found.time_upper)
        assert (row["tau"], row["tau_upper"]) == (found.tau, found.tau_upper)
        contact = found.contacts[0]
        assert row["kind"] == contact.kind
        assert tuple(row["moving_feature"][: len(contact.moving)]) == contact.moving
        assert tuple(row["fixed_feature"][: len(contact.fixed)]) == contact.fixed
        np.testing.assert_array_equal([row["px"], row["py"], row["pz"]], contact.point)
        np.testing.assert_array_equal([row["nx"], row["ny"], row["nz"]], contact.normal)


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_the_same_rows_for_any_number_of_threads(cube, threads):
    starts, goals = random_motions(200)
    expected = chasles.first_contact_batch(cube, cube, starts, goals)
    assert_same_rows(chasles.first_contact_batch(cube, cube, starts, goals, threads=threads), expected)


@pytest.mark.parametrize("layout", ["matrices", "float32", "strided", "fortran", "list"])
def test_poses_of_any_layout(cube, layout):
    starts, goals = np.stack([matrix(3, 0, 0)] * 3), np.stack([matrix(x, 0, 0) for x in (0, 2, 2.5)])
    change = {
        "matrices": lambda a: a,
        "float32": lambda a: a.astype(np.float32),
        "strided": lambda a: np.repeat(a, 2, axis=0)[::2],
        "fortran": np.asfortranarray,
        "list": lambda a: a.tolist(),
    }[layout]
    table = chasles.first_contact_batch(cube, cube, change(starts), change(goals))
    assert table["verdict"].tolist() == ["contact", "clear", "clear"] or table["verdict"][2] == "clear"
    assert table["time"][0] == pytest.approx(2 / 3)


def test_overlap_has_features_and_a_point_but_no_kind(cube):
    row = chasles.first_contact_batch(cube, cube, [pose(0.5, 0.5, 0.25)], [pose(5, 0, 0)])[0]
    assert row["verdict"] == "contact_at_start" and row["kind"] == ""
    assert row["moving_feature"][0] >= 0 and np.isfinite(row["px"]) and np.isnan(row["nx"])


def test_nothing_is_a_batch_too(cube):
    assert len(chasles.first_contact_batch(cube, cube, np.empty((0, 7)), np.empty((0, 4, 4)))) == 0
    assert len(chasles.first_contact_batch(cube, cube, [], [])) == 0
    assert len(chasles.path_is_clear_batch(cube, cube, [])) == 0


@pytest.mark.parametrize(
    ("starts", "goals", "why"),
    [
        (np.zeros((2, 6)), np.zeros((2, 7)), r"starts: the shape is \(2, 6\)"),
        (np.zeros(7), np.zeros(7), r"starts: the shape is \(7,\)"),
        (np.ones((2, 7)), np.ones((3, 7)), "goals: there are 3 for 2 starts"),
        (np.ones((2, 7)), np.stack([pose(0, 0, 0), np.zeros(7)]), r"goals\[1\]: pose: quaternion"),
        (np.stack([pose(0, 0, 0), pose(np.nan, 0, 0)]), np.ones((2, 7)), r"starts\[1\]: pose: translation: .*NaN"),
        (np.zeros((1, 4, 4)), np.ones((1, 7)), r"starts\[0\]: pose: matrix: the last row"),
        (np.ones((1, 7)) * 1j, np.ones((1, 7)), "starts: .*complex"),
        ("abc", np.ones((1, 7)), "starts"),
        (5, 5, "starts"),
        (np.eye(4), np.ones((2, 7)), r"starts: the shape is \(4, 4\)"),
        ([np.eye(4), np.ones(7)], np.ones((2, 7)), f"starts: {RAGGED}"),
        (np.ones((1, 7)), [[1, 2], [3]], f"goals: {RAGGED}"),
    ],
)
def test_what_are_no_poses_is_refused_by_name(cube, starts, goals, why):
    with pytest.raises(chasles.InvalidInput, match=why):
        chasles.first_contact_batch(cube, cube, starts, goals)


def test_a_bad_pose_costs_its_row_alone_if_asked_for(cube):
    starts, goals = random_motions(20)
    expected = chasles.first_contact_batch(cube, cube, starts, goals)
    starts[3] = np.nan
    goals[7, 3:] = 0
    table = chasles.first_contact_batch(cube, cube, starts, goals, errors="mark")
    bad = np.isin(np.arange(20), [3, 7])
    assert (table["verdict"][bad] == "error").all()
    assert_same_rows(table[~bad], expected[~bad])


def test_a_motion_that_goes_too_far_is_refused_before_any_row_or_costs_its_row_alone(cube):
    """docs/decisions/0012-range-of-coordinates.md"""
    starts = [pose(0, 0, 9), pose(0, 0, 1e20), pose(0, 0, 9)]
    goals = [pose(0, 0, 5, 0.9, 0.3, 0, 0.2)] * 3
    motions = [chasles.ConstantVelocity.between(*ends) for ends in zip(starts, goals)]
    for ask in (chasles.first_contact_batch, chasles.least_distance_batch):
        for kind in ("velocity", "twist"):
            table = chasles.empty_table(3) if ask is chasles.first_contact_batch else None
            with pytest.raises(chasles.InvalidInput, match=r"starts\[1\], goals\[1\]: motion: goes up to 1e\+20 far"):
                ask(cube, cube, starts, goals, motion=kind, table=table)
            assert table is None or (table["verdict"] == chasles.empty_table(3)["verdict"]).all()
        with pytest.raises(chasles.InvalidInput, match=r"motions\[1\]: motion: goes up to 1e\+20 far"):
            ask(cube, cube, motions=motions)
    for arguments in ({"starts": starts, "goals": goals, "motion": "velocity"}, {"motions": motions}):
        table = chasles.first_contact_batch(cube, cube, **arguments, errors="mark")
        assert table["verdict"].tolist() == ["clear", "error", "clear"]
    assert (chasles.first_contact_batch(cube, cube, starts, goals)["verdict"] == "clear").all(), "screws are exact"


@pytest.mark.parametrize(
    "options", [{"margin": -1}, {"max_turn": 0}, {"find": "last"}, {"threads": -1}, {"errors": "x"}]
)
def test_options_out_of_range_are_refused_whatever_the_motions(cube, options):
    arguments = {"errors": "mark", **options}
    with pytest.raises(chasles.InvalidInput, match=next(iter(options))):
        chasles.first_contact_batch(cube, cube, np.empty((0, 7)), np.empty((0, 7)), **arguments)


@pytest.mark.parametrize("batch", [chasles.first_contact_batch, chasles.least_distance_batch])
def test_max_turn_belongs_to_screws_between_poses(cube, batch):
    starts, goals = random_motions(3)
    with pytest.raises(chasles.InvalidInput, match="max_turn: belongs to motion='screw', and the motion is 'velocity'"):
        batch(cube, cube, starts, goals, motion="velocity", max_turn=0.1)
    motions = [chasles.ScrewMotion.between(*ends) for ends in zip(starts, goals, strict=True)]
    with pytest.raises(chasles.InvalidInput, match="max_turn: belongs to the motions, which are given"):
        batch(cube, cube, motions=motions, max_turn=0.1)
    assert_same_rows(batch(cube, cube, starts, goals, max_turn=math.pi / 18), batch(cube, cube, starts, goals))


@pytest.mark.parametrize("threads", [1.5, "2", None])
def test_threads_are_a_whole_number(cube, threads):
    with pytest.raises(TypeError, match="threads: .* is not a whole number"):
        chasles.first_contact_batch(cube, cube, [], [], threads=threads)


def test_there_may_be_more_threads_than_any_machine_has(cube):
    starts, goals = random_motions(20)
    expected = chasles.first_contact_batch(cube, cube, starts, goals)
    assert_same_rows(chasles.first_contact_batch(cube, cube, starts, goals, threads=10**12), expected)


@pytest.mark.parametrize("wrong", [None, CUBE_VERTICES])
def test_what_is_no_body_is_a_type_error(cube, wrong):
    for name, bodies in (("moving", (wrong, cube)), ("fixed", (cube, wrong))):
        with pytest.raises(TypeError, match=f"{name}: must be a chasles.Polyhedron"):
            chasles.first_contact_batch(*bodies, [], [])
        with pytest.raises(TypeError, match=f"{name}: must be a chasles.Polyhedron"):
            chasles.path_is_clear_batch(*bodies, [])


def test_a_table_is_gone_on_with(cube):
    starts, goals = random_motions(50)
    expected = chasles.first_contact_batch(cube, cube, starts, goals)
    table = chasles.empty_table(50)
    table[:20] = expected[:20]
    table["time_upper"][:20] = 7  # a value that no answer has
    again = chasles.first_contact_batch(cube, cube, starts, goals, table=table)
    assert again is table
    assert (table["time_upper"][:20] == 7).all()
    assert_same_rows(table[20:], expected[20:])


@pytest.mark.parametrize("table", [np.zeros(2), chasles.empty_table(3), chasles.empty_table(2, chasles.path_dtype), 5])
def test_a_table_of_another_kind_is_refused(cube, table):
    with pytest.raises(chasles.InvalidInput, match="table"):
        chasles.first_contact_batch(cube, cube, np.ones((2, 7)), np.ones((2, 7)), table=table)


def test_a_table_that_cannot_be_written_is_refused(cube):
    table = chasles.empty_table(2)
    table.flags.writeable = False
    with pytest.raises(chasles.InvalidInput, match="table"):
        chasles.first_contact_batch(cube, cube, np.ones((2, 7)), np.ones((2, 7)), table=table)
    strided = chasles.empty_table(4)[::2]
    with pytest.raises(chasles.InvalidInput, match="table"):
        chasles.first_contact_batch(cube, cube, np.ones((2, 7)), np.ones((2, 7)), table=strided)


def test_a_path_tells_its_segment(cube):
    found = chasles.first_contact_on_path(cube, cube, [pose(3, 0, 0), pose(2, 0, 0), pose(0, 0, 0)])
    assert (found.verdict, found.segment) == ("contact", 1)
    assert found.time == pytest.approx(0.5)
    assert re.search(r"segment 1, contact at time 0\.(5|49999)", repr(found))
    with pytest.raises(chasles.InvalidInput, match="at least two"):
        chasles.first_contact_on_path(cube, cube, [pose(3, 0, 0)])
    with pytest.raises(chasles.InvalidInput, match="at least two"):
        chasles.first_contact_on_path(cube, cube, [])
    with pytest.raises(chasles.InvalidInput, match=r"poses\[1\]: pose"):
        chasles.first_contact_on_path(cube, cube, np.zeros((2, 7)) + [[1], [0]])


@pytest.mark.parametrize("motion", ["screw", "sweep", "velocity", "twist"])
def test_a_path_follows_the_named_motion(cube, motion):
    starts, goals = random_motions(60)
    touches = 0
    for path in np.stack([starts, goals, starts[::-1]], axis=1):
        found = chasles.first_contact_on_path(cube, cube, path, motion=motion)
        parts = [chasles.first_contact(cube, cube, *ends, motion=motion) for ends in zip(path[:-1], path[1:])]
        first = next((i for i, part in enumerate(parts) if part.verdict != "clear"), None)
        assert (found.verdict != "clear") == (first is not None)
        if first is not None:
            touches += 1
            assert (found.segment, found.time, found.verdict) == (first, parts[first].time, parts[first].verdict)
            assert type(found.motion) is type(parts[first].motion)
    assert 10 < touches < 60
    if motion != "screw":
        with pytest.raises(chasles.InvalidInput, match="max_turn: belongs to motion='screw'"):
            chasles.first_contact_on_path(cube, cube, [pose(3, 0, 0), pose(2, 0, 0)], motion=motion, max_turn=0.1)


@pytest.mark.parametrize("kind", ["array", "strided", "list", "ragged"])
def test_a_batch_of_paths_answers_as_single_paths_do(cube, kind):
    starts, goals = random_motions(100)
    paths = np.stack([starts, goals, starts], axis=1)
    paths[::2, 1] = paths[::2, 0] + [1, 0, 0, 0, 0, 0, 0]
    asked = {
        "array": paths,
        "strided": np.asfortranarray(paths),
        "list": list(paths),
        "ragged": [path[: 2 + i % 2] for i, path in enumerate(paths)],
    }[kind]
    table = chasles.path_is_clear_batch(cube, cube, asked, find="first")
    assert 20 < np.count_nonzero(table["verdict"] == "clear") < 80
    for row, path in zip(table, asked):
        found = chasles.first_contact_on_path(cube, cube, path, find="first")
        assert row["verdict"] == found.verdict
        if found.verdict != "clear":
            assert (row["segment"], row["time"]) == (found.segment, found.time)
    yes_or_no = chasles.path_is_clear_batch(cube, cube, asked)
    np.testing.assert_array_equal(yes_or_no["verdict"], table["verdict"])


@pytest.mark.parametrize(
    ("paths", "why"),
    [
        ([np.ones((2, 7)), np.ones((1, 7))], r"paths\[1\]: at least two"),
        ([np.ones((2, 7)), np.ones((2, 6))], r"paths\[1\]: the shape"),
        ([np.ones((2, 7)), np.stack([np.eye(4)] * 2)], r"paths\[1\]: its poses have the shape"),
        (np.ones((2, 7)), r"paths\[0\]: the shape"),
        (np.ones(7), r"paths\[0\]: the shape"),
        (np.ones((2, 1, 7)), r"paths\[0\]: at least two"),
        ([np.ones((2, 7)), np.ones((3, 7)) * [[1], [np.nan], [1]]], r"paths\[1\]\[1\]: pose"),
        ([np.ones((2, 7)), [[1, 2], [3]]], rf"paths\[1\]: {RAGGED}"),
        (None, "paths: not a sequence"),
        (np.array(5.0), "paths: not a sequence"),
    ],
)
def test_what_are_no_paths_is_refused_by_name(cube, paths, why):
    with pytest.raises(chasles.InvalidInput, match=why):
        chasles.path_is_clear_batch(cube, cube, paths)


@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
def test_processes_answer_as_one_does(cube, method):
    starts, goals = random_motions(400)
    expected = chasles.first_contact_batch(cube, cube, starts, goals)  # before they are forked from its threads
    questions = [(cube, cube, starts[part], goals[part]) for part in (slice(0, 200), slice(200, 400))]
    with multiprocessing.get_context(method).Pool(2) as pool:
        tables = pool.starmap_async(chasles.first_contact_batch, questions).get(timeout=60)
    found = np.concatenate(tables)
    np.testing.assert_array_equal(found["verdict"], expected["verdict"])
    np.testing.assert_array_equal(found["time"], expected["time"])


def test_a_bar_shows_progress(cube, capsys):
    pytest.importorskip("tqdm")
    chasles.first_contact_batch(cube, cube, *random_motions(10), progress=True)
    assert "10/10" in capsys.readouterr().err


def test_pandas_takes_a_table_as_the_guide_says(cube):
    pandas = pytest.importorskip("pandas")
    table = chasles.first_contact_batch(cube, cube, *random_motions(20))
    frame = pandas.DataFrame({name: list(table[name]) for name in table.dtype.names})
    assert frame.shape == (20, len(table.dtype.names))
    np.testing.assert_array_equal(frame["time"], table["time"])
    assert frame["moving_feature"][4].tolist() == table["moving_feature"][4].tolist()


def test_margin_of_a_batch(cube):
    table = chasles.first_contact_batch(cube, cube, [pose(4, 0, 0)], [pose(0, 0, 0)], margin=0.5)
    assert table["time"][0] == pytest.approx(2.5 / 4)
