"""The structured arrays that batches return.

They have the columns of ``chasles batch``, ``clear_until``, for least distances ``distance`` and ``distance_upper``, and
for paths ``segment``:

==================  =====================================================================================
``id``              number of the row
``verdict``         "clear", "contact" or "contact_at_start"; "not_done" for a row that is not yet answered;
                    "error" for an invalid pose (only with ``errors="mark"``). For least distances, "unknown" if
                    neither contact nor a distance above 0 is proven
``time``            lower end of the bracket around the first contact; NaN if there is no contact
``time_upper``      upper end of this bracket
``tau``             lower end of the same bracket in the paper's parameter
``tau_upper``       upper end of the bracket in this parameter
``certain``         False if a contact could not be separated from a miss
``kind``            kind of the first feature pair in contact; "" if there is none
``moving_feature``  the moving body's feature: two vertices of an edge, otherwise one id twice; -1 if none
``fixed_feature``   the fixed body's feature, in the same form
``px py pz``        contact point in the world; NaN if there is none
``nx ny nz``        contact normal, from the fixed body to the moving body
``clear_until``     the bodies are proven to stay farther apart than the margin before this time; with ``hold``
                    than the hold distance, or that of the start if it is less
``distance``        (least distances only) lower end of the bracket around the least distance: the surfaces
                    never come nearer. If it is above 0, the times and the features are those of the least
                    distance
``distance_upper``  (least distances only) upper end of this bracket
``segment``         (paths only) the contact is between pose ``segment`` and the next one; -1 if clear
==================  =====================================================================================
"""

import numpy as np
import numpy.typing as npt

NOT_DONE = "not_done"

#: One row of a batch of motions. `Row` in python/src/table.h has the same layout.
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

#: One row of a batch of least distances.
least_dtype = np.dtype(
    [
        *((name, motion_dtype[name]) for name in motion_dtype.names or ()),
        ("distance", np.float64),
        ("distance_upper", np.float64),
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
    for name in ("distance", "distance_upper"):
        if name in (dtype.names or ()):
            row[name] = np.nan
    for name in ("moving_feature", "fixed_feature", "segment"):
        if name in (dtype.names or ()):
            row[name] = -1
    return row


def empty_table(rows: int, dtype: np.dtype = motion_dtype) -> npt.NDArray[np.void]:
    """A table whose rows all have the verdict "not_done"."""
    bytes_of_a_row = np.dtype((np.void, dtype.itemsize))  # copying bytes is ten times as fast as copying fields
    table = np.full(rows, _blank_row(dtype).view(bytes_of_a_row)).view(dtype)
    table["id"] = np.arange(rows)
    return table
