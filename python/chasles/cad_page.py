"""The page of a checked assembly, for `chasles.cad`: each joint goes to its ends and back."""

from __future__ import annotations

import os
import pathlib
from typing import Any

import numpy as np

from .cad_bounds import Array
from .cad_report import JointRange, Report
from .poses import seven_numbers
from .record import recording_page

STEPS = 24  # poses of a joint on its way to one end; a quarter turn has more than one


def write_page(report: Report, out: str | os.PathLike[str], title: str) -> pathlib.Path:
    """See `Report.view`. A unit of time is the way of one joint to one end, or back."""
    assembly = report.assembly
    robot, rest = assembly.robot(), assembly.rest
    times, rows, events = (
        [0.0],
        [rest],
        [_event(touch.pair, touch.point, 0.0, "as mounted", touch.is_proven) for touch in report.touching],
    )
    for joint in report.joints:
        number = robot.variables.index(joint.name)
        for side, end in enumerate((joint.lower, joint.upper)):
            if end == joint.value:
                continue
            start, stop = times[-1], joint.stops[side]
            share = 1.0 if stop is None else (stop.clear_until - joint.value) / (end - joint.value)
            for step in np.unique([*np.linspace(0, 1, STEPS + 1)[1:], *([share] if share > 0 else [])]):
                times.append(start + step)
                rows.append(_with(rest, number, joint.value + step * (end - joint.value)))
            if stop is not None and stop.pair is not None:
                events.append(_event(stop.pair, stop.point, start + share, joint.name, stop.touches_by is not None))
            for step in np.linspace(0, 1, STEPS + 1)[1:]:
                times.append(start + 1 + step)
                rows.append(_with(rest, number, end + step * (joint.value - end)))
    poses = np.array([[seven_numbers(pose) for pose in assembly.poses(robot, row).values()] for row in rows])
    bodies = {name: part.mesh for name, part in assembly.parts.items()}
    return recording_page(out, bodies, np.array(times), poses, events, title=title)


def _with(rest: Array, number: int, value: float) -> Array:
    row = rest.copy()
    row[number] = value
    return row


def _event(pair: tuple[str, str], point: list[float] | None, time: float, kind: str, certain: bool) -> dict[str, Any]:
    points: list[list[float]] = [] if point is None else [point]
    normals = [[0.0, 0.0, 1.0] for _ in points]
    return {"time": time, "pair": pair, "kind": kind, "certain": certain, "points": points, "normals": normals}
