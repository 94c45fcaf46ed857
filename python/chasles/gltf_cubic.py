"""Cubic splines of glTF as motions: translations on cubic curves, rotations by normalised cubic curves of quaternions.

A curve is in Bernstein form on each segment, so its control points bound it and its derivatives (convex hull). For a quaternion
q(t) of any length, with ' for d/dt and w the angular velocity:

    w = 2 Im(q' q*) / |q|^2,    w' = 2 Im(q'' q*) / |q|^2 - 2 w (q . q') / |q|^2,

since q' q'* is real. So |w| <= 2 |q'| / |q|, and |w'| <= 2 |q''| / |q| + 4 |q'|^2 / |q|^2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, Trajectory

Array = npt.NDArray[np.float64]

MOST_HALVES = 12  # of a segment, until its quaternions are proven to stay away from 0
OUTWARD = 1 + 1e-9  # more than the roundings of all bounds


@dataclass
class Part:
    """A part, from 0 to 1, of one cubic."""

    points: Array  #: (4, k), of the whole cubic
    length: float  #: of the whole cubic, in time
    start: float = 0.0
    end: float = 1.0

    def bound(self, order: int) -> float:
        """An upper bound of a derivative."""
        factor = {1: 3, 2: 6}[order] / self.length**order
        points = np.diff(self.points, order, axis=0)
        within = _cut(points, self.start, self.end)
        return factor * (_longest(within) * OUTWARD + 1e-14 * _longest(points))

    def turn_rates(self, halves: int = 0) -> tuple[float, float, float]:
        """Of a quaternion: bounds of the angular velocity and of its derivative, and a lower bound of its length."""
        points = _cut(self.points, self.start, self.end)
        towards = points.sum(axis=0)
        size = float(np.linalg.norm(towards))
        least = float((points @ towards).min()) / size if size > 0 else 0.0
        if least > 0.5 * _longest(points) or (least > 0 and halves >= 4):
            least *= 2 - OUTWARD
            first, second = self.bound(1), self.bound(2)
            return 2 * first / least, 2 * second / least + 4 * (first / least) ** 2, least
        if halves == MOST_HALVES:
            raise InvalidInput(
                "the cubic spline of a rotation may pass 0 between two keys, where it has no direction; export more keys"
            )
        middle = 0.5 * (self.start + self.end)
        parts = [replace(self, end=middle).turn_rates(halves + 1), replace(self, start=middle).turn_rates(halves + 1)]
        return max(part[0] for part in parts), max(part[1] for part in parts), min(part[2] for part in parts)


@dataclass
class CubicCurve:
    """Cubics one after another over the time in [0, 1]; constant before the first one and after the last one."""

    knots: Array  #: (n + 1,), ascending
    points: Array  #: (n, 4, k), Bernstein coefficients of each cubic over its own interval

    @staticmethod
    def constant(value: Array) -> CubicCurve:
        """A curve that stays."""
        return CubicCurve(np.array([0.0, 1.0]), np.broadcast_to(value, (1, 4, len(value))))

    @staticmethod
    def hermite(stamps: Array, values: Array, tangents: Array, duration: float) -> CubicCurve:
        """Through values (n, k) with tangents (n, 2, k), in and out, per unit of the stamps (appendix C.5 of the specification)."""
        steps = np.diff(stamps)[:, None]
        points = np.stack(
            [
                values[:-1],
                values[:-1] + steps * tangents[:-1, 1] / 3,
                values[1:] - steps * tangents[1:, 0] / 3,
                values[1:],
            ],
            axis=1,
        )
        rests = [np.broadcast_to(value, (1, 4, values.shape[1])) for value in (values[0], values[-1])]
        knots = stamps / duration
        if knots[0] > 0:
            knots, points = np.concatenate([[0.0], knots]), np.concatenate([rests[0], points])
        if knots[-1] < 1:
            knots, points = np.concatenate([knots, [1.0]]), np.concatenate([points, rests[1]])
        return CubicCurve(knots, points)

    def at(self, time: float) -> Array:
        """The value, by the algorithm of de Casteljau."""
        segment, part = self._place(time)
        points = self.points[segment]
        for _ in range(3):
            points = points[:-1] + part * (points[1:] - points[:-1])
        return points[0]

    def within(self, start: float, end: float) -> Part:
        """The part between two times, with no knot inside."""
        middle, _ = self._place(0.5 * (start + end))
        first, length = self.knots[middle], self.knots[middle + 1] - self.knots[middle]
        low, high = np.clip((np.array([start, end]) - first) / length, 0.0, 1.0)
        return Part(self.points[middle], float(length), float(low), float(high))

    def segments(self) -> list[Part]:
        """All cubics, whole."""
        return [Part(points, length) for points, length in zip(self.points, np.diff(self.knots).tolist())]

    def _place(self, time: float) -> tuple[int, float]:
        segment = int(np.clip(np.searchsorted(self.knots, time, side="right") - 1, 0, len(self.points) - 1))
        first, last = self.knots[segment : segment + 2]
        return segment, float(np.clip((time - first) / (last - first), 0.0, 1.0))


def cubic_motion(places: CubicCurve, quaternions: CubicCurve) -> Trajectory:
    """The motion whose origin is on the one curve, turned by the other one, normalised (x y z w)."""

    def pose_at(time: float) -> Array:
        x, y, z, w = quaternions.at(time)
        return np.concatenate([places.at(time), [w, x, y, z]])

    def bounds(start: float, end: float) -> dict[str, float]:
        shift = places.within(start, end)
        turn, turn_acceleration, _ = quaternions.within(start, end).turn_rates()
        rates = {"turn_rate": turn, "turn_acceleration": turn_acceleration}
        return {**rates, "speed": shift.bound(1), "acceleration": shift.bound(2)}

    knots = np.unique(np.concatenate([places.knots, quaternions.knots]))
    return Trajectory(pose_at, bounds, knots=knots[1:-1].tolist(), rounding=_rounding(places, quaternions))


def _rounding(places: CubicCurve, quaternions: CubicCurve) -> float:
    """Of poses: of the curves, and of the time, which moves the body by its rates."""
    turns = [part.turn_rates() for part in quaternions.segments()]
    speed = max(part.bound(1) for part in places.segments())
    largest = float(np.abs(places.points).max())
    size = float(np.abs(places.points[:, [0, 3]]).max()) or largest or 1.0
    ratio = max(_longest(part.points) / turn[2] for part, turn in zip(quaternions.segments(), turns))
    units = 8 + (largest + speed) / size + 2 * ratio + max(turn[0] for turn in turns)
    return float(min(max(2**-47, units * 2**-50), 1e-3))


def _longest(points: Array) -> float:
    return float(np.linalg.norm(points, axis=1).max())


def _cut(points: Array, start: float, end: float) -> Array:
    """The Bernstein coefficients between two parts of the interval: the polar form at (start, ..., end, ...)."""
    result = np.empty_like(points)
    degree = len(points) - 1
    for i in range(degree + 1):
        left = points
        for part in [start] * (degree - i) + [end] * i:
            left = left[:-1] + part * (left[1:] - left[:-1])
        result[i] = left[0]
    return result
