"""Paths of polynomials that were rounded, for the adapters of ROS and Drake."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import JointPath, Robot

Array = npt.NDArray[np.float64]


def path_of(robot: Robot, breaks: Any, coefficients: Array) -> JointPath:
    """`JointPath.polynomials`, also where a segment should end at 0 in all variables and ends within roundings of it.

    It compares both sides of a knot with each other, to 1e-9 of their sizes, so a rest of rounding beside 0 counts as a jump. The
    segment after the knot begins at this rest then.
    """
    durations, result = np.diff(np.asarray(breaks, np.float64)), coefficients.copy()
    for s in range(1, len(durations)):
        end, size = _end(result[:, s - 1], durations[s - 1])
        begin = result[-1, s]
        gap = np.abs(end - begin)
        is_close = np.linalg.norm(gap) <= 1e-9 * min(np.linalg.norm(end), np.linalg.norm(begin))
        if not is_close and (gap <= 2.0**-48 * size).all():
            result[-1, s] = end
    return JointPath.polynomials(robot, breaks, result)


def _end(coefficients: Array, duration: float) -> tuple[Array, Array]:
    """The value at the end of a segment, by the operations of the library, and the sum of the sizes of all terms."""
    terms = coefficients.copy()
    for power in range(1, len(terms)):
        for _ in range(power):
            terms[-1 - power] *= duration
    value = np.zeros_like(terms[0])
    for term in terms:
        value = value + term
    return value, np.abs(terms).sum(axis=0)
