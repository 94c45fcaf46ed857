"""The structured arrays that batches answer with; the columns are those of ``chasles batch``.

==================  =====================================================================================
``id``              number of the row
``verdict``         "clear", "contact" or "contact_at_start"; "not_done" where nobody has asked yet, and
                    "error" for a pose that cannot be used (only with ``errors="mark"``)
``time``            lower end of the bracket around the first contact; NaN without contact
``time_upper``      its upper end
``tau``             the same in the paper's parameter
``tau_upper``       its upper end
``certain``         False where contact could not be told from a miss
``kind``            of the first feature pair in contact, "" if there is none
``moving_feature``  its feature of the moving body: two vertices of an edge, else one id twice; -1 for none
``fixed_feature``   its feature of the fixed body
``px py pz``        the point of contact in the world; NaN for none
``nx ny nz``        the normal there, from the fixed body to the moving one
``clear_until``     before this time the bodies are proven to be farther apart than the margin
``segment``         (paths only) where the first contact is, from pose ``segment`` to the next; -1 if clear
==================  =====================================================================================
"""

import numpy as np
import numpy.typing as npt

NOT_DONE = "not_done"

#: One row of a batch of motions; python/src/table.h has the same.
motion_dtype = np.dtype(
    [
        ("id", np.int64),
        ("verdict", "U16"),
        ("time", np.float64),
        ("time_upper", np.float64),
        ("tau", np.float64),
        ("tau_upper", np.float64),
        ("certain", np.bool_),
        ("kind", "U13"),
        ("moving_feature", np.int64, (2,)),
        ("fixed_feature", np.int64, (2,)),
        *((name, np.float64) for name in ("px", "py", "pz", "nx", "ny", "nz")),
        ("clear_until", np.float64),
    ],
    align=True,
)

#: One row of a batch of paths.
path_dtype = np.dtype(
    [*((name, motion_dtype[name]) for name in motion_dtype.names or ()), ("segment", np.int64)], align=True
)


def _blank_row(dtype: np.dtype) -> npt.NDArray[np.void]:
    row = np.zeros((), dtype)
    row["verdict"] = NOT_DONE
    for name in ("time", "time_upper", "tau", "tau_upper", "px", "py", "pz", "nx", "ny", "nz"):
        row[name] = np.nan
    for name in ("moving_feature", "fixed_feature", "segment"):
        if name in (dtype.names or ()):
            row[name] = -1
    return row


def empty_table(rows: int, dtype: np.dtype = motion_dtype) -> npt.NDArray[np.void]:
    """A table in which nothing is done yet."""
    bytes_of_a_row = np.dtype((np.void, dtype.itemsize))  # copied as they are, ten times as fast as field by field
    table = np.full(rows, _blank_row(dtype).view(bytes_of_a_row)).view(dtype)
    table["id"] = np.arange(rows)
    return table
