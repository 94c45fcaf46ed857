"""Motions from Parquet, results to Parquet: in one process, and on a cluster with one killed worker."""

import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, random_motions

import chasles

pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")
from chasles import distributed, partitions  # noqa: E402  (needs pyarrow)


def write_motions(
    file: pathlib.Path, count: int, rows_in_group: int, ids: list | None = None, seed: int = 1
) -> pa.Table:
    poses = np.hstack(random_motions(count, seed))
    columns = dict(zip(partitions.START_COLUMNS + partitions.GOAL_COLUMNS, poses.T))
    table = pa.table({"id": ids, **columns} if ids else columns)
    pq.write_table(table, file, row_group_size=rows_in_group)
    return table


def results(out: pathlib.Path) -> pa.Table:
    return pa.concat_tables(pq.read_table(file) for file in sorted(out.glob("part-*.parquet"))).unify_dictionaries()


def test_results_are_those_of_a_batch(cube, tmp_path):
    write_motions(tmp_path / "motions.parquet", 250, 100)
    run = distributed.first_contact_parquet(cube, cube, tmp_path / "motions.parquet", tmp_path / "out")
    assert (run.partitions, run.already_done, run.rows) == (3, 0, 250)
    table = chasles.first_contact_batch(cube, cube, *random_motions(250))
    found = results(tmp_path / "out")
    assert found.column_names == list(table.dtype.names)
    for name in ("id", "time", "time_upper", "tau", "tau_upper", "certain", "px", "nz", "clear_until"):
        np.testing.assert_array_equal(found[name].to_numpy(), table[name])
    assert found["verdict"].to_pylist() == table["verdict"].tolist()
    features = [pair if pair[0] >= 0 else None for pair in table["moving_feature"].tolist()]
    assert found["moving_feature"].to_pylist() == features
    assert run.verdicts() == {name: int(np.count_nonzero(table["verdict"] == name)) for name in ("clear", "contact")}


def test_a_folder_of_files_with_ids_and_a_row_that_cannot_be_read(cube, tmp_path):
    folder = tmp_path / "motions"
    folder.mkdir()
    write_motions(folder / "b.parquet", 30, 30, [f"b{i}" for i in range(30)])
    broken = write_motions(folder / "a.parquet", 20, 30, [f"a{i}" for i in range(20)]).set_column(
        1, "x0", pa.array([None] + [3.0] * 19)
    )
    pq.write_table(broken, folder / "a.parquet")
    distributed.first_contact_parquet(cube, cube, folder, tmp_path / "out")
    found = results(tmp_path / "out")
    assert found["id"].to_pylist() == [f"a{i}" for i in range(20)] + [f"b{i}" for i in range(30)]
    assert [row for row, verdict in enumerate(found["verdict"].to_pylist()) if verdict == "error"] == [0]


def test_partitions_that_are_there_are_not_done_again(cube, tmp_path):
    write_motions(tmp_path / "motions.parquet", 300, 100)
    arguments = cube, cube, tmp_path / "motions.parquet", tmp_path / "out"
    distributed.first_contact_parquet(*arguments)
    expected = results(tmp_path / "out")
    kept = (tmp_path / "out" / "part-000001.parquet").stat().st_mtime_ns
    (tmp_path / "out" / "part-000002.parquet").unlink()
    run = distributed.first_contact_parquet(*arguments)
    assert (run.partitions, run.already_done) == (3, 2)
    assert (tmp_path / "out" / "part-000001.parquet").stat().st_mtime_ns == kept
    assert results(tmp_path / "out").equals(expected)


def test_results_of_another_question_are_refused(cube, tmp_path):
    motions, out = tmp_path / "motions.parquet", tmp_path / "out"
    write_motions(motions, 20, 10)
    distributed.first_contact_parquet(cube, cube, motions, out)
    with pytest.raises(chasles.InvalidInput, match="other options"):
        distributed.first_contact_parquet(cube, cube, motions, out, find="any")
    larger = chasles.Polyhedron(CUBE_VERTICES * 2, CUBE_FACES)
    with pytest.raises(chasles.InvalidInput, match="other fixed"):
        distributed.first_contact_parquet(cube, larger, motions, out)
    write_motions(motions, 20, 10, seed=2)
    with pytest.raises(chasles.InvalidInput, match="other motions"):
        distributed.first_contact_parquet(cube, cube, motions, out)
    with pytest.raises(chasles.InvalidInput, match="is not empty"):
        distributed.first_contact_parquet(cube, cube, motions, tmp_path)


@pytest.mark.parametrize("change", ["order", "id", "value"])
def test_rows_that_changed_in_a_file_of_the_same_size_are_refused(cube, tmp_path, change):
    """Neither the size of the file nor its metadata differ then; the results of the first partition are still true."""
    motions, out = tmp_path / "motions.parquet", tmp_path / "out"
    table = write_motions(motions, 40, 20, list(range(40)))

    def write(table: pa.Table) -> int:
        pq.write_table(table, motions, row_group_size=20, use_dictionary=False, compression="none", write_statistics=False)
        return motions.stat().st_size

    size = write(table)
    distributed.first_contact_parquet(cube, cube, motions, out)
    before = results(out)
    if change == "order":
        changed = pa.concat_tables([table.slice(0, 20), table.slice(20, 20).take(list(range(20))[::-1])])
    else:
        column = "id" if change == "id" else "x1"
        values = table[column].to_numpy().copy()
        values[33] += 1
        changed = table.set_column(table.column_names.index(column), column, pa.array(values))
    assert write(changed) == size
    with pytest.raises(chasles.InvalidInput, match="other motions: .*row group 1: has changed since; name a new folder"):
        distributed.first_contact_parquet(cube, cube, motions, out)
    assert results(out).equals(before)
    write(table)
    assert distributed.first_contact_parquet(cube, cube, motions, out).already_done == 2


def test_an_interruption_names_the_way_on(cube, tmp_path, monkeypatch):
    write_motions(tmp_path / "motions.parquet", 60, 20)
    answer = distributed.answer_partition

    def interrupted(partition, *arguments):
        if partition.index == 1:
            raise chasles.BatchInterrupted(chasles.first_contact_batch(cube, cube, *random_motions(1)))
        return answer(partition, *arguments)

    monkeypatch.setattr(distributed, "answer_partition", interrupted)
    arguments = cube, cube, tmp_path / "motions.parquet", tmp_path / "out"
    message = "^1 of 3 partitions are finished; the same call again answers the others$"
    with pytest.raises(KeyboardInterrupt, match=message):
        distributed.first_contact_parquet(*arguments)
    monkeypatch.undo()
    assert distributed.first_contact_parquet(*arguments).already_done == 1


def cut(file: pathlib.Path, size: int) -> None:
    file.write_bytes(file.read_bytes()[:size])


def test_what_a_crash_leaves_is_repaired(cube, tmp_path):
    """Every file of the folder at every stage of a run: absent, empty, or cut, as a loss of power may leave it."""
    write_motions(tmp_path / "motions.parquet", 300, 100)
    out = tmp_path / "out"
    arguments = cube, cube, tmp_path / "motions.parquet", out
    distributed.first_contact_parquet(*arguments)
    expected = results(out)
    names = sorted(file.name for file in out.iterdir())
    assert names == ["_manifest.json", "_question.pickle", *(f"part-00000{i}.parquet" for i in range(3))]

    for size in (0, 4, 500, -8, -1):
        cut(out / "part-000001.parquet", size)
        run = distributed.first_contact_parquet(*arguments)
        assert (run.partitions, run.already_done, sum(run.verdicts().values())) == (3, 2, 300)
        assert results(out).equals(expected)
    pq.write_table(pq.read_table(out / "part-000000.parquet").slice(0, 99), out / "part-000000.parquet")
    cut(out / "_question.pickle", 10)
    for unfinished in ("._manifest.json.0a", "._question.pickle.0b", ".part-000002.parquet.0c"):
        (out / unfinished).write_bytes(b"PAR1")
    assert distributed.first_contact_parquet(*arguments).already_done == 2
    assert results(out).equals(expected)
    assert sorted(file.name for file in out.iterdir()) == names


def test_a_run_that_ended_before_its_manifest_starts_anew(cube, tmp_path):
    write_motions(tmp_path / "motions.parquet", 20, 10)
    out = tmp_path / "out"
    out.mkdir()
    (out / "_question.pickle").write_bytes(b"")
    (out / "._manifest.json.0a").write_bytes(b"{")
    run = distributed.first_contact_parquet(cube, cube, tmp_path / "motions.parquet", out)
    assert (run.already_done, run.rows, len(list(out.iterdir()))) == (0, 20, 4)


@pytest.mark.parametrize("content", [b"", b'{"chasles": ', b"[1]", b"\xff\xfe"])
def test_results_whose_manifest_is_damaged_are_refused_in_one_line(cube, tmp_path, content):
    write_motions(tmp_path / "motions.parquet", 20, 10)
    out = tmp_path / "out"
    distributed.first_contact_parquet(cube, cube, tmp_path / "motions.parquet", out)
    (out / "_manifest.json").write_bytes(content)
    with pytest.raises(chasles.InvalidInput, match=r"_manifest.json: is damaged, .* name a new folder$"):
        distributed.first_contact_parquet(cube, cube, tmp_path / "motions.parquet", out)


def test_motions_that_are_damaged_behind_their_metadata_are_named(cube, tmp_path):
    file = tmp_path / "motions.parquet"
    write_motions(file, 400, 100)
    content = bytearray(file.read_bytes())
    content[4:2000] = bytes(1996)
    file.write_bytes(content)
    with pytest.raises(chasles.InvalidInput, match="motions.parquet: row group 0: cannot be read: "):
        distributed.first_contact_parquet(cube, cube, file, tmp_path / "out")


def test_what_are_no_motions_is_refused_by_name(cube, tmp_path):
    with pytest.raises(chasles.InvalidInput, match="neither a file nor a folder"):
        distributed.first_contact_parquet(cube, cube, tmp_path / "nothing", tmp_path / "out")
    (tmp_path / "text.parquet").write_text("no Parquet")
    with pytest.raises(chasles.InvalidInput, match="cannot be read"):
        distributed.first_contact_parquet(cube, cube, tmp_path / "text.parquet", tmp_path / "out")
    pq.write_table(pa.table({"x0": [1.0]}), tmp_path / "less.parquet")
    with pytest.raises(chasles.InvalidInput, match="no column y0"):
        distributed.first_contact_parquet(cube, cube, tmp_path / "less.parquet", tmp_path / "out")
    with pytest.raises(chasles.InvalidInput, match="find"):
        distributed.first_contact_parquet(cube, cube, tmp_path / "less.parquet", tmp_path / "out", find="last")
    assert not (tmp_path / "out").exists()


CLUSTER = """
import sys
sys.path.insert(0, {tests!r})
import pathlib
import chasles
from chasles import distributed
from cubes import CUBE_FACES, CUBE_VERTICES
from dask.distributed import Client, LocalCluster

if __name__ == "__main__":
    cube = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)
    folder = pathlib.Path({folder!r})
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            print(*client.run(lambda: __import__("os").getpid()).values(), flush=True)
            run = distributed.first_contact_parquet(
                cube, cube, folder / "motions.parquet", folder / "out", client=client)
            print(run.partitions, run.rows, flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="workers are killed otherwise there")
def test_a_cluster_loses_nothing_with_a_worker(cube, tmp_path, request):
    """Two worker processes: one is killed after the first results, and all results agree."""
    pytest.importorskip("distributed")
    write_motions(tmp_path / "motions.parquet", 40_000, 1000)
    program = tmp_path / "cluster.py"
    program.write_text(CLUSTER.format(tests=str(request.path.parent), folder=str(tmp_path)))
    process = subprocess.Popen([sys.executable, program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        workers = [int(pid) for pid in process.stdout.readline().split()]
        assert len(workers) == 2, process.stderr.read()
        deadline = time.monotonic() + 60
        while len(list((tmp_path / "out").glob("part-*.parquet"))) < 3 and time.monotonic() < deadline:
            time.sleep(0.005)
        os.kill(workers[0], signal.SIGKILL)
        at_the_kill = len(list((tmp_path / "out").glob("part-*.parquet")))
        assert 3 <= at_the_kill < 40
        assert process.stdout.readline() == "40 40000\n", process.stderr.read()
        assert process.wait(timeout=60) == 0
    finally:
        process.kill()
        process.communicate()
    distributed.first_contact_parquet(cube, cube, tmp_path / "motions.parquet", tmp_path / "here")
    assert results(tmp_path / "out").equals(results(tmp_path / "here"))
    assert not list((tmp_path / "out").glob(".part*"))
