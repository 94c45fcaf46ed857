"""What a user gives as an array of numbers: the one place of the package in Python that reads it, as python/src/arrays.cpp in C++."""

from __future__ import annotations

import numbers as kinds
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import InvalidInput

Array = npt.NDArray[np.float64]


def array_of(given: Any, name: str) -> npt.NDArray[Any]:
    """An array of any type, not always a copy. Raises InvalidInput for masked entries, and what is no array."""
    _core._refuse_masked(given, name)  # asarray drops the mask
    try:
        return np.asarray(given)
    except (TypeError, ValueError, RuntimeError, OverflowError) as error:  # RuntimeError: of a tensor that is being trained
        raise InvalidInput(f"{name}: not an array of numbers: {' '.join(str(error).split())}") from None


def numbers(given: Any, name: str) -> Array:
    """An array of real numbers, not always a copy. Raises InvalidInput also for texts, None and complex numbers."""
    array = array_of(given, name)
    if array.size and array.dtype.kind not in "iuf":
        about = _about_objects(array) if array.dtype.kind == "O" else ""
        raise InvalidInput(f"{name}: not an array of numbers: an array of {array.dtype}{about}")
    return array.astype(np.float64, copy=False)


def finite(given: Any, name: str) -> Array:
    """An array of finite numbers, not always a copy."""
    array = numbers(given, name)
    is_bad = ~np.isfinite(array)
    if is_bad.any():
        place = np.argwhere(is_bad)[0].tolist()
        which = f"the entry {place} is" if place else "is"
        raise InvalidInput(f"{name}: {which} {array[tuple(place)]}; finite numbers are needed")
    return array


def _about_objects(array: npt.NDArray[Any]) -> str:
    for place, entry in np.ndenumerate(array):
        if entry is None:
            return f": the entry {list(place)} is None"
        if not isinstance(entry, kinds.Real):
            return f" (of {type(entry).__name__})"
    return "; its entries are numbers, and array.astype(float) makes one"
