"""Motions in Parquet files: the list of partitions, and the answers of one partition.

A partition is a row group of a file. Its results become one file, which is written under a temporary name and then
renamed. A file of results is therefore always complete, and a partition without such a file has yet to be answered.
"""

import functools
import hashlib
import json
import os
import pathlib
import pickle
import uuid
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.parquet as pq

from ._core import InvalidInput, Polyhedron, __version__
from .batch import first_contact_batch

_POSE = ("x", "y", "z", "qw", "qx", "qy", "qz")
START_COLUMNS = [name + "0" for name in _POSE]
GOAL_COLUMNS = [name + "1" for name in _POSE]
MANIFEST = "_manifest.json"  # readers of data sets ignore names that begin with an underscore
BODIES = "_bodies.pickle"


@dataclass(frozen=True)
class Partition:
    """One row group of one file."""

    index: int
    file: str
    row_group: int
    first_row: int  # counted over all files
    rows: int

    @property
    def name(self) -> str:
        return f"part-{self.index:06}.parquet"


def motion_files(motions: str | os.PathLike[str]) -> list[pathlib.Path]:
    """The file, or the Parquet files of a folder, sorted by name."""
    path = pathlib.Path(motions).resolve()
    if path.is_file():
        return [path]
    files = sorted(file for file in path.glob("*.parquet") if not file.name.startswith(("_", ".")))
    if not files:
        raise InvalidInput(f"motions: {motions}: is neither a file nor a folder with Parquet files")
    return files


def partitions_of(files: list[pathlib.Path]) -> list[Partition]:
    """All row groups of all files, in order."""
    found: list[Partition] = []
    row = 0
    for file in files:
        metadata = _metadata(file)
        for group in range(metadata.num_row_groups):
            rows = metadata.row_group(group).num_rows
            found.append(Partition(len(found), str(file), group, row, rows))
            row += rows
    return found


def _metadata(file: pathlib.Path) -> pq.FileMetaData:
    try:
        metadata = pq.read_metadata(file)
    except (OSError, pa.ArrowException) as error:
        raise InvalidInput(f"motions: {file}: cannot be read: {error}".replace("\n", " ")) from None
    missing = [name for name in START_COLUMNS + GOAL_COLUMNS if name not in metadata.schema.names]
    if missing:
        raise InvalidInput(f"motions: {file}: has no column {missing[0]}")
    return metadata


def digest_of(body: Polyhedron) -> str:
    digest = hashlib.sha256(np.ascontiguousarray(body.vertices).tobytes())
    digest.update(json.dumps(body.faces).encode())
    return digest.hexdigest()


def manifest_of(
    moving: Polyhedron, fixed: Polyhedron, files: list[pathlib.Path], options: dict[str, Any]
) -> dict[str, Any]:
    """All inputs of the results. A file is identified by its size and its metadata, so it is not read whole."""
    return {
        "chasles": __version__,
        "moving": digest_of(moving),
        "fixed": digest_of(fixed),
        "options": options,
        "motions": [
            {
                "bytes": file.stat().st_size,
                "metadata": hashlib.sha256(repr(_metadata(file).to_dict()).encode()).hexdigest(),
            }
            for file in files
        ],
    }


def prepare(out: pathlib.Path, moving: Polyhedron, fixed: Polyhedron, manifest: dict[str, Any]) -> None:
    """Makes the folder of the results. Refuses a folder whose results have other inputs."""
    out.mkdir(parents=True, exist_ok=True)
    file = out / MANIFEST
    if file.exists():
        _check_same(out, json.loads(file.read_text("utf-8")), manifest)
    elif any(out.iterdir()):
        raise InvalidInput(f"out: {out}: is not empty and has no results of an earlier run")
    write_whole(out / BODIES, pickle.dumps((moving, fixed)))
    write_whole(file, json.dumps(manifest, indent=1).encode())


def _check_same(out: pathlib.Path, earlier: dict[str, Any], wanted: dict[str, Any]) -> None:
    different = [key for key in wanted if earlier.get(key) != wanted[key]]
    if different:
        raise InvalidInput(f"out: {out}: has results for other {' and '.join(different)}")


def write_whole(file: pathlib.Path, content: bytes) -> None:
    """Writes a file completely or not at all, even if this process is killed."""
    unfinished = file.with_name(f".{file.name}.{uuid.uuid4().hex}")
    try:
        unfinished.write_bytes(content)
        unfinished.replace(file)
    finally:
        unfinished.unlink(missing_ok=True)


@functools.lru_cache(maxsize=4)
def _bodies(out: pathlib.Path, digest: str) -> tuple[Polyhedron, Polyhedron]:
    """Both bodies, loaded once per process and run; `digest` identifies the run in its folder."""
    return pickle.loads((out / BODIES).read_bytes())


def answer_partition(
    partition: Partition, out: pathlib.Path, digest: str, options: dict[str, Any], threads: int
) -> int:
    """Answers the motions of a partition, unless its file exists, and returns their number."""
    file = out / partition.name
    if not file.exists():
        moving, fixed = _bodies(out, digest)
        motions = pq.ParquetFile(partition.file).read_row_group(partition.row_group)
        starts, goals = (_poses(motions, names) for names in (START_COLUMNS, GOAL_COLUMNS))
        table = first_contact_batch(moving, fixed, starts, goals, threads=threads, errors="mark", **options)
        write_whole(file, _parquet(results_of(table, _ids(motions, partition))))
    return partition.rows


def _poses(motions: pa.Table, names: list[str]) -> npt.NDArray[np.float64]:
    """The poses in these columns. A missing number becomes NaN, which makes the pose invalid."""
    return np.stack([motions[name].to_numpy().astype(np.float64) for name in names], axis=1)


def _ids(motions: pa.Table, partition: Partition) -> pa.Array | pa.ChunkedArray:
    if "id" in motions.column_names:
        return motions["id"]
    return pa.array(np.arange(partition.first_row, partition.first_row + partition.rows))


def results_of(table: npt.NDArray[np.void], ids: pa.Array | pa.ChunkedArray) -> pa.Table:
    """The table of a batch with the ids of its motions. Missing values are null."""
    columns: dict[str, Any] = {"id": ids}
    for name in table.dtype.names[1:]:  # type: ignore[index]
        values = np.ascontiguousarray(table[name])
        if values.ndim == 2:
            columns[name] = _pairs(values)
        elif values.dtype.kind == "U":
            columns[name] = pa.array(values).dictionary_encode()
        else:
            columns[name] = pa.array(values, from_pandas=True)  # NaN becomes null
    return pa.table(columns)


def _pairs(values: npt.NDArray[np.int64]) -> pa.ListArray:
    """Lists of two numbers; a row of -1 becomes null."""
    has = values[:, 0] >= 0
    ends = np.concatenate([[0], np.cumsum(2 * has)]).astype(np.int32)
    return pa.ListArray.from_arrays(pa.array(ends), pa.array(values[has].ravel()), mask=pa.array(~has))


def _parquet(table: pa.Table) -> bytes:
    sink = pa.BufferOutputStream()
    pq.write_table(table, sink)
    return sink.getvalue().to_pybytes()
