"""Trajectories of Drake as polynomials in powers of time, for `chasles.drake`."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
from pydrake import trajectories as dt

from ._core import InvalidInput
from .articles import with_article
from .arrays import finite
from .primitive_shapes import Array

Pieces = tuple[Array, Array]  # breaks, coefficients: as JointPath.polynomials has them


def polynomials_of(trajectory: Any) -> Pieces:
    if isinstance(trajectory, dt.CompositeTrajectory):
        parts = [polynomials_of(trajectory.segment(i)) for i in range(trajectory.get_number_of_segments())]
        return _joined(parts)
    if not isinstance(trajectory, dt.PiecewisePolynomial | dt.BsplineTrajectory | dt.BezierCurve):
        what = "no piecewise polynomial, B-spline, Bezier curve or composite of them"
        raise InvalidInput(f"trajectory: {with_article(trajectory)} is {what}{_way_out(trajectory)}")
    if isinstance(trajectory, dt.PiecewisePolynomial) and not trajectory.get_number_of_segments():
        raise InvalidInput("trajectory: is empty")
    if trajectory.cols() != 1:
        raise InvalidInput(f"trajectory: has {trajectory.cols()} columns, and one is needed")
    if isinstance(trajectory, dt.PiecewisePolynomial):
        return _of_piecewise(trajectory)
    if isinstance(trajectory, dt.BezierCurve):
        points = finite(trajectory.control_points(), "trajectory: control points").T
        ends = [trajectory.start_time()] * len(points), [trajectory.end_time()] * len(points)
        return _of_spline(ends[0] + ends[1], points)
    points = finite([np.ravel(point) for point in trajectory.control_points()], "trajectory: control points")
    return _of_spline(list(trajectory.basis().knots()), points)


def _way_out(trajectory: Any) -> str:
    if isinstance(trajectory, dt.PathParameterizedTrajectory):
        return "; its timing does not change what touches, so give its path()"
    return ""


def _of_piecewise(trajectory: dt.PiecewisePolynomial) -> Pieces:
    breaks = np.array(trajectory.get_segment_times())
    count, rows = len(breaks) - 1, trajectory.rows()
    given = [[trajectory.getPolynomial(s, i, 0).GetCoefficients() for i in range(rows)] for s in range(count)]
    powers = max(len(numbers) for row in given for numbers in row)
    coefficients = np.zeros((powers, count, rows))
    for s, row in enumerate(given):
        for i, numbers in enumerate(row):
            coefficients[powers - len(numbers) :, s, i] = numbers[::-1]
    return breaks, coefficients


def _joined(parts: list[Pieces]) -> Pieces:
    powers = max(len(coefficients) for _, coefficients in parts)
    padded = [np.pad(c, ((powers - len(c), 0), (0, 0), (0, 0))) for _, c in parts]
    breaks = [part[:-1] for part, _ in parts] + [parts[-1][0][-1:]]
    return np.concatenate(breaks), np.concatenate(padded, axis=1)


def _of_spline(knots: list[float], points: Array) -> Pieces:
    """A B-spline by its knots and control points (n, rows). A Bezier curve is one without knots between its ends."""
    degree = len(knots) - len(points) - 1
    exact = [Fraction(knot) for knot in finite(knots, "trajectory: knots").tolist()]
    unit = max(Fraction(number).denominator for number in points.ravel().tolist())
    values = np.array([[int(Fraction(number) * unit) for number in point] for point in points.tolist()], object)
    spans = [k for k in range(degree, len(points)) if exact[k] < exact[k + 1]]
    coefficients = np.zeros((degree + 1, len(spans), points.shape[1]))
    for s, k in enumerate(spans):
        basis = _basis_on(exact, k, degree)
        shared = math.lcm(*(number.denominator for polynomial in basis for number in polynomial))
        integers = np.array([[int(number * shared) for number in polynomial] for polynomial in basis], object)
        try:  # a quotient of integers is rounded once
            coefficients[::-1, s] = (integers.T @ values[k - degree : k + 1]) / (shared * unit)
        except OverflowError:
            raise InvalidInput(f"trajectory: from {knots[k]} to {knots[k + 1]} s: is too large or too fast for floating point") from None
    return np.array([knots[k] for k in spans] + [knots[len(points)]]), coefficients


def _basis_on(knots: list[Fraction], k: int, degree: int) -> list[list[Fraction]]:
    """The basis functions that are not 0 from knot k to the next one, in powers of the time since knot k.

    Source: the recursion of Cox and de Boor, of polynomials instead of values (de Boor, A Practical Guide to Splines, IX).
    """
    basis = [[Fraction(1)]]
    for p in range(1, degree + 1):
        wider = [[Fraction(0)] * (p + 1) for _ in range(p + 1)]
        for j, polynomial in enumerate(basis):  # that of number k - p + 1 + j, of the degree p - 1
            left, right = knots[k - p + 1 + j], knots[k + 1 + j]
            for power, number in enumerate(polynomial):
                part = number / (right - left)
                wider[j][power] += part * (right - knots[k])
                wider[j][power + 1] -= part
                wider[j + 1][power] += part * (knots[k] - left)
                wider[j + 1][power + 1] += part
        basis = wider
    return basis
