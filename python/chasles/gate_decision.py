"""The answer of a gate: what of a chunk may be sent, and why not more."""

from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput
from .arrays import finite, numbers

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class GateDecision:
    """What of a chunk may be sent, and why not more. Times count actions: action k is due at k + 1, the present is 0."""

    verdict: str  #: "passed", "slowed" (passed below full speed), "shortened" (the first actions passed) or "refused" (none)
    actions: Floats  #: what may be sent, (k, variables), the first k actions, unchanged; then the robot has to stop
    speeds: Floats  #: the greatest speed on the way to each of them, (k,), as a part of full speed in (0, 1]
    reason: str = ""  #: what stands against more, or against full speed; empty if passed
    pair: tuple[str, str] | None = None  #: two links or parts, or one and a body of the scene
    time: float | None = None  #: when the pair comes within the margin, at full speed
    place: Floats | None = None  #: where, in the world, (3,)
    clear_until: float = 0.0  #: before this time everything is proven to stay apart by its margin
    milliseconds: float = 0.0  #: wall time that the decision took

    @property
    def times(self) -> Floats:
        """When each action is due at its speed, (k,), which is 1, 2, 3, ... at full speed."""
        return np.cumsum(1.0 / self.speeds)

    def at_period(self, present: npt.ArrayLike, actions: npt.ArrayLike) -> Floats:
        """The actions at their speeds for a controller with a fixed period and straight interpolation.

        Each way is cut into so many equal parts that none is faster than its speed.

        Parameters
        ----------
        present : array (numbers,)
            Where the robot is: as it was given to the gate, or in other units.
        actions : array (n, numbers)
            As they were given to the gate, or in the same other units; rows beyond the first k are ignored.

        Returns
        -------
        array (m, numbers)
            m is at least k. Values between two actions are rounded.

        Raises
        ------
        InvalidInput
            For other shapes, and numbers that are not finite.
        """
        first, rest = finite(present, "present"), numbers(actions, "actions")
        if first.ndim != 1 or rest.ndim != 2 or rest.shape[1] != len(first) or len(rest) < len(self.speeds):
            needed = f"(numbers,) and (n, numbers) with n of at least {len(self.speeds)} are needed"
            raise InvalidInput(f"present, actions: the shapes are {first.shape} and {rest.shape}; {needed}")
        rows = np.vstack([first, finite(rest[: len(self.speeds)], "actions")])
        parts = np.ceil(1.0 / self.speeds).astype(int)
        ways = [np.linspace(a, b, n + 1)[1:] for a, b, n in zip(rows[:-1], rows[1:], parts, strict=True)]
        return np.vstack(ways) if ways else rows[:0]

    def record(self) -> dict[str, Any]:
        """The decision in words and numbers, for a log in JSON."""
        return {
            "verdict": self.verdict,
            "actions": len(self.actions),
            "speed": float(self.speeds.min(initial=1.0)),
            "reason": self.reason,
            "pair": list(self.pair) if self.pair else None,
            "time": self.time,
            "place": self.place.tolist() if self.place is not None else None,
            "clear_until": self.clear_until,
            "milliseconds": self.milliseconds,
        }

    def __bool__(self) -> NoReturn:
        raise TypeError("a decision has no truth value: compare its verdict, as in `decision.verdict == 'passed'`")
