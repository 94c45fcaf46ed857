"""Questions in Parquet files: the list of partitions, and the answers of one partition.

A question is asked for each row: about a motion of two bodies, or about an edge of a robot (chasles/questions.py).

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

from ._core import InvalidInput, __version__
from .extras import extra
from .questions import GOAL_COLUMNS, START_COLUMNS, Question, numbers_of

with extra("distributed", "chasles.distributed"):
    import pyarrow as pa
    import pyarrow.parquet as pq

__all__ = ["GOAL_COLUMNS", "START_COLUMNS", "Partition"]

MANIFEST = "_manifest.json"  # readers of data sets ignore names that begin with an underscore
QUESTION = "_question.pickle"
ROWS_DIGEST = b"chasles.rows"  # in the metadata of a file of results
UNFINISHED = (".part-", f".{MANIFEST}.", f".{QUESTION}.")  # how the names of files begin that are being written


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


def files_of(rows: str | os.PathLike[str], question: Question) -> list[pathlib.Path]:
    """The file, or the Parquet files of a folder, sorted by name."""
    path = pathlib.Path(rows).resolve()
    if path.is_file():
        return [path]
    files = sorted(file for file in path.glob("*.parquet") if not file.name.startswith(("_", ".")))
    if not files:
        raise InvalidInput(f"{question.rows}: {rows}: is neither a file nor a folder with Parquet files")
    return files


def partitions_of(files: list[pathlib.Path], question: Question) -> list[Partition]:
    """All row groups of all files, in order."""
    found: list[Partition] = []
    row = 0
    for file in files:
        metadata = _metadata(file, question)
        for group in range(metadata.num_row_groups):
            rows = metadata.row_group(group).num_rows
            found.append(Partition(len(found), str(file), group, row, rows))
            row += rows
    return found


def _metadata(file: pathlib.Path, question: Question) -> pq.FileMetaData:
    try:
        metadata = pq.read_metadata(file)
    except (OSError, pa.ArrowException) as error:
        raise InvalidInput(f"{question.rows}: {file}: cannot be read: {error}".replace("\n", " ")) from None
    _check_columns(f"{question.rows}: {file}", metadata.schema.to_arrow_schema(), question.columns)
    return metadata


_NUMBERS = (pa.types.is_floating, pa.types.is_integer, pa.types.is_decimal, pa.types.is_null)


def _check_columns(place: str, schema: pa.Schema, names: list[str]) -> None:
    for name in names:
        if schema.names.count(name) != 1:
            raise InvalidInput(f"{place}: has {'two columns' if name in schema.names else 'no column'} {name}")
        kind = schema.field(name).type
        if not any(fits(kind) for fits in _NUMBERS):
            raise InvalidInput(f"{place}: column {name}: has the type {kind}; numbers are needed")


def manifest_of(question: Question, files: list[pathlib.Path]) -> dict[str, Any]:
    """All inputs of the results. A file is identified by its size and its metadata, so it is not read whole; the results
    of a partition have the digest of its rows."""
    return {
        "chasles": __version__,
        **question.identity(),
        question.rows: [
            {
                "bytes": file.stat().st_size,
                "metadata": hashlib.sha256(repr(_metadata(file, question).to_dict()).encode()).hexdigest(),
            }
            for file in files
        ],
    }


def prepare(out: pathlib.Path, question: Question, manifest: dict[str, Any]) -> None:
    """Makes the folder of the results. Refuses a folder whose results have other inputs."""
    content = question.pickled()
    if out.exists() and not out.is_dir():
        raise InvalidInput(f"out: {out}: is not a folder")
    out.mkdir(parents=True, exist_ok=True)
    file = out / MANIFEST
    if file.exists():
        _check_same(out, _manifest_in(file), manifest)
    elif not all(_is_of_a_start(file.name) for file in out.iterdir()):
        raise InvalidInput(f"out: {out}: is not empty and has no results of an earlier run; name a new folder")
    write_whole(out / QUESTION, content)
    write_whole(file, json.dumps(manifest, indent=1).encode())


def _is_of_a_start(name: str) -> bool:
    """Whether a file is one that a run leaves that ends before it has a manifest."""
    return name.startswith((QUESTION, *UNFINISHED))


def _manifest_in(file: pathlib.Path) -> dict[str, Any]:
    try:
        manifest = json.loads(file.read_bytes())
    except ValueError:
        manifest = None
    if not isinstance(manifest, dict):
        raise InvalidInput(f"out: {file}: is damaged, so nothing tells which question the results answer; name a new folder")
    return manifest


def _check_same(out: pathlib.Path, earlier: dict[str, Any], wanted: dict[str, Any]) -> None:
    different = [key for key in {**wanted, **earlier} if earlier.get(key) != wanted.get(key)]
    if different:
        raise InvalidInput(f"out: {out}: has results for other {' and '.join(different)}")


def write_whole(file: pathlib.Path, content: bytes) -> None:
    """Writes a file completely or not at all, even if this process is killed or the machine loses its power."""
    unfinished = file.with_name(f".{file.name}.{uuid.uuid4().hex}")
    try:
        with unfinished.open("wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        unfinished.replace(file)
    finally:
        unfinished.unlink(missing_ok=True)


@functools.lru_cache(maxsize=4)
def _question(out: pathlib.Path, digest: str) -> Question:
    """The question, loaded once per process and run; `digest` identifies the run in its folder."""
    return pickle.loads((out / QUESTION).read_bytes())


def answer_partition(partition: Partition, out: pathlib.Path, digest: str, threads: int) -> int:
    """Answers the rows of a partition, unless that is done, and returns their number."""
    question = _question(out, digest)
    if not is_done(partition, out, question):
        rows = _rows(partition)
        table = question.answer(rows, threads)
        results = results_of(table, _ids(rows, partition))
        results = results.replace_schema_metadata({ROWS_DIGEST: _digest_of(rows, question)})
        write_whole(out / partition.name, _parquet(results))
    return partition.rows


def is_done(partition: Partition, out: pathlib.Path, question: Question) -> bool:
    """Whether there is a whole file with the results of the partition. A damaged one is written anew. Raises InvalidInput
    for results of rows that have changed since."""
    try:
        results = pq.read_metadata(out / partition.name)
    except (OSError, pa.ArrowException):
        return False
    digest = (results.metadata or {}).get(ROWS_DIGEST)
    if results.num_rows != partition.rows or digest is None:
        return False
    if digest != _digest_of(_rows(partition), question):
        place = f"{partition.file}: row group {partition.row_group}"
        raise InvalidInput(f"out: {out}: has results for other {question.rows}: {place}: has changed since; name a new folder")
    return True


def _digest_of(rows: pa.Table, question: Question) -> bytes:
    """Of all that the results of these rows depend on."""
    digest = hashlib.sha256(numbers_of(rows, question.columns).tobytes())
    if "id" in rows.column_names:
        ids = rows["id"].to_numpy()
        digest.update(repr(ids.tolist()).encode() if ids.dtype == object else ids.tobytes())
    return digest.hexdigest().encode()


def _rows(partition: Partition) -> pa.Table:
    try:
        return pq.ParquetFile(partition.file).read_row_group(partition.row_group)
    except (OSError, pa.ArrowException) as error:
        place = f"{partition.file}: row group {partition.row_group}"
        raise InvalidInput(f"{place}: cannot be read: {error}".replace("\n", " ")) from None


def _ids(rows: pa.Table, partition: Partition) -> pa.Array | pa.ChunkedArray:
    if "id" in rows.column_names:
        return rows["id"]
    return pa.array(np.arange(partition.first_row, partition.first_row + partition.rows))


def results_of(table: npt.NDArray[np.void], ids: pa.Array | pa.ChunkedArray) -> pa.Table:
    """The table of a batch with the ids of its rows. Missing values are null."""
    columns: dict[str, Any] = {"id": ids}
    for name in table.dtype.names or ():
        if name == "id":
            continue
        values = np.ascontiguousarray(table[name])
        if values.ndim == 2:
            columns[name] = _pairs(values)
        elif values.dtype.kind == "U":
            columns[name] = pa.array(values).dictionary_encode()
        elif values.dtype.kind == "O":  # names; an empty one is missing
            columns[name] = pa.array([text or None for text in values], pa.string()).dictionary_encode()
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
