"""Answers have no truth value, because no answer is "yes" or "no": one line says so, and what to compare."""

from typing import Any, NoReturn

from . import _core

_COMPARISONS = {
    "its verdict, as in `found.verdict == chasles.Verdict.clear`": [
        _core.FirstContact,
        _core.PathContact,
        _core.RobotContact,
        _core.SceneContact,
    ],
    "its distance, as in `found.distance > 0`": [_core.LeastDistance, _core.RobotClearance],
    "its bounds, as in `profile.lower.min() > 0`": [_core.DistanceProfile],
    "its bounds, as in `numpy.nanmin(matrix.lower) > 0`": [_core.DistanceMatrix],
    "its verdict, as in `found.verdict == 'clear'`": [_core.ClearBox, _core.RobotRange],
    "its reason, as in `proof.reason == 'never'`": [_core.PairProof],
    "its state, as in `step.state == 'reached'`": [_core.DragStep],
}


def prepare() -> None:
    """Makes `bool` refuse these types."""
    for comparison, kinds in _COMPARISONS.items():
        for kind in kinds:
            kind.__bool__ = _refusal(comparison)  # type: ignore[assignment, attr-defined, method-assign, union-attr]


def _refusal(comparison: str) -> Any:
    def refuse(self: object) -> NoReturn:
        raise TypeError(f"an answer has no truth value: compare {comparison}")

    return refuse
