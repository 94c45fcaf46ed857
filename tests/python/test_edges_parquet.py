"""Edges of a robot from Parquet, results to Parquet: in one process, and on a cluster."""

import numpy as np
import pytest

import chasles

pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")
from chasles import distributed, questions  # noqa: E402  (needs pyarrow)

ARM = """<robot name="arm">
  <link name="base"/>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.9 0.1 0.1"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.9 0.1 0.08"/></geometry></collision></link>
  <joint name="joint1" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
  <joint name="joint10" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/></joint>
</robot>"""


@pytest.fixture
def arm(tmp_path):
    (tmp_path / "arm.urdf").write_text(ARM)
    robot = chasles.Robot.load(tmp_path / "arm.urdf")
    (tmp_path / "arm.urdf").unlink()  # workers need no files of the robot
    return robot


@pytest.fixture
def world(cube):
    scene = chasles.Scene()
    scene.add("wall", cube, pose=np.array([0.45, 1.2, -0.5, 1, 0, 0, 0]))
    scene.add("door", cube, [-3, 0, -0.5, 1, 0, 0, 0], [-1.5, 0, -0.5, 1, 0, 0, 0])
    turn = chasles.Motion.hinge([0, 0, 0], [0, 0, 1], [0, 0.1]) * chasles.Motion.at_rest([9, 9, 9, 1, 0, 0, 0])
    scene.add("fan", cube, motion=turn)
    return scene


def random_edges(count, seed=1):
    return np.random.default_rng(seed).uniform(-1, 2.5, (2, count, 2))


def write_edges(file, robot, count, rows_in_group, **more):
    starts, goals = random_edges(count)
    columns = dict(zip(sum(questions.edge_columns(robot), []), np.hstack([starts, goals]).T))
    table = pa.table({**columns, **more})
    pq.write_table(table, file, row_group_size=rows_in_group)
    return table


def results(out):
    return pa.concat_tables(pq.read_table(file) for file in sorted(out.glob("part-*.parquet"))).unify_dictionaries()


def test_columns_are_named_by_variables(arm):
    assert questions.edge_columns(arm) == (["start_joint1", "start_joint10"], ["goal_joint1", "goal_joint10"])


def test_results_are_those_of_a_batch(arm, world, tmp_path):
    write_edges(tmp_path / "edges.parquet", arm, 250, 100)
    arguments = dict(scene=world, margin=0.05)
    run = distributed.edges_parquet(arm, tmp_path / "edges.parquet", tmp_path / "out", **arguments)
    assert (run.partitions, run.already_done, run.rows) == (3, 0, 250)
    table = chasles.first_contacts_on_edges(arm, *random_edges(250), **arguments)
    found = results(tmp_path / "out")
    assert found.column_names == ["id", *table.dtype.names]
    assert found["id"].to_pylist() == list(range(250))
    for name in ("time", "time_upper", "clear_until", "certain"):
        np.testing.assert_array_equal(found[name].to_numpy(), table[name])
    assert found["verdict"].to_pylist() == table["verdict"].tolist()
    for name in ("first", "second"):
        assert found[name].to_pylist() == [text or None for text in table[name]]
    assert {"wall", "door"} <= set(table["second"])
    is_clear = table["verdict"] == "clear"
    assert is_clear.any() and all(time is None for time in found["time"].filter(pa.array(is_clear)).to_pylist())
    assert run.verdicts() == {name: int(np.count_nonzero(table["verdict"] == name)) for name in set(table["verdict"])}
    again = distributed.edges_parquet(arm, tmp_path / "edges.parquet", tmp_path / "out", **arguments)
    assert again.already_done == 3


def test_edges_that_cannot_be_used_are_marked_and_keep_their_ids(arm, tmp_path):
    table = write_edges(tmp_path / "edges.parquet", arm, 6, 6, id=list("abcdef"))
    broken = table.set_column(0, "start_joint1", pa.array([None, 0.5, 2000.0, 0.5, 0.5, 0.5]))
    pq.write_table(broken, tmp_path / "edges.parquet")
    distributed.edges_parquet(arm, tmp_path / "edges.parquet", tmp_path / "out")
    found = results(tmp_path / "out")
    assert found["id"].to_pylist() == list("abcdef")
    assert [v == "error" for v in found["verdict"].to_pylist()] == [True, False, True, False, False, False]
    assert found["time"].to_pylist()[0] is None and found["first"].to_pylist()[0] is None


def test_results_of_another_question_are_refused(arm, world, cube, tmp_path):
    edges, out = tmp_path / "edges.parquet", tmp_path / "out"
    write_edges(edges, arm, 20, 10)
    distributed.edges_parquet(arm, edges, out, scene=world)
    with pytest.raises(chasles.InvalidInput, match="other options"):
        distributed.edges_parquet(arm, edges, out, scene=world, margin=0.1)
    with pytest.raises(chasles.InvalidInput, match="other scene"):
        distributed.edges_parquet(arm, edges, out)
    world.move("wall", [0.45, 1.2, -0.4, 1, 0, 0, 0])
    with pytest.raises(chasles.InvalidInput, match="other scene"):
        distributed.edges_parquet(arm, edges, out, scene=world)
    world.move("wall", [0.45, 1.2, -0.5, 1, 0, 0, 0])
    assert distributed.edges_parquet(arm, edges, out, scene=world).already_done == 2
    arm.attach("part", "lower", cube, touch_links=["upper"])
    with pytest.raises(chasles.InvalidInput, match="other robot"):
        distributed.edges_parquet(arm, edges, out, scene=world)
    with pytest.raises(chasles.InvalidInput, match="other"):
        distributed.first_contact_parquet(cube, cube, motions_file(tmp_path), out)


def motions_file(folder):
    columns = {name: [1.0] for name in questions.START_COLUMNS + questions.GOAL_COLUMNS}
    pq.write_table(pa.table(columns), folder / "motions.parquet")
    return folder / "motions.parquet"


def pose_at(time):
    return [3, 0, time, 1, 0, 0, 0]


def bounds(start, end):
    return {"turn_rate": 0, "speed": 1}


def test_wrong_arguments_are_refused_before_any_work(arm, cube, tmp_path):
    table = write_edges(tmp_path / "edges.parquet", arm, 3, 3)
    pq.write_table(table.drop_columns(["goal_joint10"]), tmp_path / "less.parquet")
    texts = table.set_column(0, "start_joint1", pa.array(["a", "b", "c"]))
    pq.write_table(texts, tmp_path / "texts.parquet")
    own, local = chasles.Scene(), chasles.Scene()
    own.add("a", cube, motion=chasles.Trajectory(pose_at, bounds))
    local.add("a", cube, motion=chasles.Trajectory(lambda time: pose_at(time), bounds))
    for robot, file, options, error, message in [
        (arm, "less.parquet", {}, chasles.InvalidInput, "edges: .*has no column goal_joint10"),
        (arm, "texts.parquet", {}, chasles.InvalidInput, "edges: .*column start_joint1: has the type string"),
        (arm, "nothing", {}, chasles.InvalidInput, "edges: .*neither a file nor a folder"),
        (arm, "edges.parquet", {"find": "last"}, chasles.InvalidInput, "find"),
        (arm, "edges.parquet", {"margin": -1}, chasles.InvalidInput, "margin"),
        (arm, "edges.parquet", {"threads": -1}, chasles.InvalidInput, "threads: -1 is negative"),
        (arm, "edges.parquet", {"scene": own}, chasles.InvalidInput, "scene: cannot be sent .*give it chasles.TimedPoses"),
        (arm, "edges.parquet", {"scene": local}, chasles.InvalidInput, "scene: cannot be sent to other processes"),
        (arm, "edges.parquet", {"scene": cube}, TypeError, "scene: must be a chasles.Scene"),
        (cube, "edges.parquet", {}, TypeError, "robot: a Polyhedron is not a chasles.Robot"),
    ]:
        with pytest.raises(error, match=message):
            distributed.edges_parquet(robot, tmp_path / file, tmp_path / "out", **options)
    assert not (tmp_path / "out").exists()
    with pytest.raises(chasles.InvalidInput, match="out: .*is not a folder"):
        distributed.edges_parquet(arm, tmp_path / "edges.parquet", tmp_path / "edges.parquet")


def test_a_cluster_finds_the_same(arm, world, tmp_path):
    """Two worker processes, to which the robot and the scene are sent."""
    dask = pytest.importorskip("distributed")
    write_edges(tmp_path / "edges.parquet", arm, 2000, 200)
    here = distributed.edges_parquet(arm, tmp_path / "edges.parquet", tmp_path / "here", scene=world)
    with dask.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with dask.Client(cluster) as client:
            run = distributed.edges_parquet(
                arm, tmp_path / "edges.parquet", tmp_path / "there", scene=world, client=client
            )
    assert (run.partitions, run.rows) == (here.partitions, here.rows) == (10, 2000)
    assert results(tmp_path / "there").equals(results(tmp_path / "here"))
