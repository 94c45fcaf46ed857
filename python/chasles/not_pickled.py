"""What cannot be pickled: one line says so, and names the way out."""

from typing import Any, NoReturn

from . import _core

_WAYS_OUT = {
    "keep the numbers that you need from this answer, or ask again": [
        _core.ClearBox,
        _core.Contact,
        _core.DistanceMatrix,
        _core.DistanceProfile,
        _core.DragContact,
        _core.DragEvent,
        _core.DragStep,
        _core.FirstContact,
        _core.LeastDistance,
        _core.MeshReport,
        _core.Overlap,
        _core.PairProof,
        _core.PathContact,
        _core.RobotClearance,
        _core.RobotContact,
        _core.RobotRange,
        _core.SceneContact,
        _core.StepEvent,
        _core.UntestedPairs,
        _core.Work,
    ],
    "pickle its robot and its scene, and make another one": [_core.RobotChecker],
    "pickle its scene, and make another one": [_core.DraggedBody, _core.Stepper],
    "make another one": [_core.Limit, _core.PairMemory],
}


def prepare() -> None:
    """Makes pickle and copy refuse these types by name."""
    for way_out, kinds in _WAYS_OUT.items():
        for kind in kinds:
            kind.__reduce__ = _refusal(way_out)  # type: ignore[assignment, method-assign]


def _refusal(way_out: str) -> Any:
    def refuse(self: object) -> NoReturn:
        raise TypeError(f"cannot pickle or copy a chasles.{type(self).__name__}: {way_out}")

    return refuse
