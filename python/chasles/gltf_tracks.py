"""The channels of an animation of glTF: keys of the translation, rotation and scale of nodes.

Source: Khronos Group, "glTF 2.0 Specification", sections 3.11 and appendix C (interpolation).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from ._core import Motion, TimedPoses
from .gltf_cubic import CubicCurve, cubic_motion
from .gltf_file import Document, Json, is_index

Array = npt.NDArray[np.float64]

MOST_KEYS = 10_000_000  # of all channels together
KINDS = {"translation": "VEC3", "rotation": "VEC4", "scale": "VEC3"}
NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])
HALF_TURN = 1e-6  # cosine of half of a turn, below which its way round is a matter of rounding


@dataclass
class Track:
    """The keys of one channel. Before the first key and after the last one it has their values."""

    stamps: Array  #: (n,), seconds
    values: Array  #: (n, 3), or (n, 4) for x y z w of a rotation
    interpolation: str
    tangents: Array | None = None  #: (n, 2, k), in and out, of a cubic spline

    @cached_property
    def is_constant(self) -> bool:
        """Whether nothing moves. A quaternion and its negative are one rotation."""
        first = self.values[0]
        same = np.abs(self.values - first).max(axis=1) == 0
        if len(first) == 4 and self.tangents is None:
            same |= np.abs(self.values + first).max(axis=1) == 0
        return bool(same.all()) and (len(self.stamps) == 1 or self.tangents is None or not self.tangents.any())

    def steady(self) -> tuple[Array, float]:
        """The middle of all values that the track takes, and how far they are from it, as a part of it."""
        points = [self.values]
        if self.tangents is not None:
            steps = np.diff(self.stamps)[:, None] / 3  # control points of the cubics, whose hull holds them
            points += [self.values[:-1] + steps * self.tangents[:-1, 1], self.values[1:] - steps * self.tangents[1:, 0]]
        low, high = np.vstack(points).min(axis=0), np.vstack(points).max(axis=0)
        middle = 0.5 * (low + high)
        return middle, float(np.max(0.5 * (high - low) / np.maximum(np.abs(middle), 1e-300)))

    def jumps(self) -> Array:
        """The times at which the value jumps."""
        if self.interpolation != "STEP":
            return np.zeros(0)
        return self.stamps[1:][(np.diff(self.values, axis=0) != 0).any(axis=1)]

    def frames(self, angle: float) -> Array:
        """Of a rotation: times between which it turns by about this angle or less."""
        units = self.values / np.linalg.norm(self.values, axis=1)[:, None]
        turns = 2 * np.arccos(np.clip(np.abs((units[1:] * units[:-1]).sum(axis=1)), 0, 1))
        counts = np.ceil(turns / angle).astype(np.int64)
        parts = [np.arange(count) / count for count in counts]
        return np.concatenate(
            [self.stamps[:1], *(a + p * (b - a) for a, b, p in zip(self.stamps, self.stamps[1:], parts))]
        )

    def step_at(self, time: float) -> Array:
        """The value of a track of steps, from the time on."""
        return self.values[max(int(np.searchsorted(self.stamps, time, side="right")) - 1, 0)]


#: A track, or a value that stays.
Value = Union[Array, Track]


class Tracks:
    """What moves the nodes of a file, for one animation or several at the same time."""

    def __init__(self, document: Document, animations: Sequence[int]):
        self._document = document
        self._keys = 0
        self.warnings: list[str] = []
        self.of_node: dict[tuple[int, str], Track] = {}
        self.morphed: set[int] = set()  #: nodes whose weights are animated
        self.duration = 0.0
        for index in animations:
            self._read(index, document.item("animations", index, "animations"))

    def moving(self, node: int) -> bool:
        """Whether the node changes its place or its orientation."""
        found = (self.of_node.get((node, path)) for path in ("translation", "rotation"))
        return any(track is not None and not track.is_constant for track in found)

    def value(self, node: int, path: str, at_rest: Array) -> Value:
        """The track of a node, or its constant value."""
        track = self.of_node.get((node, path))
        if track is None:
            return at_rest
        return track.values[0] if track.is_constant else track

    def _read(self, index: int, animation: Json) -> None:
        where = f"animation {index}" + (f" ({animation['name']!r})" if isinstance(animation.get("name"), str) else "")
        samplers = self._document.objects(animation, "samplers", where)
        for number, channel in enumerate(self._document.objects(animation, "channels", where)):
            place = f"{where}: channel {number}"
            target = channel.get("target")
            if not isinstance(target, dict):
                raise self._document.fault(f"{place}: target: must be an object")
            sampler = channel.get("sampler")
            if not isinstance(sampler, int) or not 0 <= sampler < len(samplers):
                raise self._document.fault(f"{place}: there is no sampler {str(sampler)[:20]}")
            self._read_channel(target, samplers[sampler], place)

    def _read_channel(self, target: Json, sampler: Json, place: str) -> None:
        path = target.get("path")
        if path == "pointer":
            self._read_pointer(target, place)
        elif "node" not in target:
            self.warnings.append(f"{place}: names no node, and is ignored")
        elif is_index(target["node"]) and target["node"] in self._document.markers:
            return
        elif path == "weights":
            self._document.item("nodes", target["node"], place)
            self.morphed.add(int(target["node"]))
            self.duration = max(self.duration, float(self._stamps(sampler, place)[-1]))
        elif not isinstance(path, str) or path not in KINDS:
            raise self._document.fault(
                f"{place}: path: {str(path)[:20]!r} is none of translation, rotation, scale, weights"
            )
        else:
            self._add(target["node"], path, sampler, place)

    def _read_pointer(self, target: Json, place: str) -> None:
        """KHR_animation_pointer: what animates materials, lights and cameras touches nothing."""
        extensions = target.get("extensions")
        found = extensions.get("KHR_animation_pointer") if isinstance(extensions, dict) else None
        pointer = str(found.get("pointer") if isinstance(found, dict) else None)
        if not pointer.startswith(("/materials/", "/cameras/", "/extensions/KHR_lights_punctual/")):
            raise self._document.fault(f"{place}: animates {pointer[:80]!r} (KHR_animation_pointer), which is not read")
        self.warnings.append(f"{place}: animates {pointer[:80]}, which moves nothing")

    def _add(self, node: Any, path: str, sampler: Json, place: str) -> None:
        if "matrix" in self._document.item("nodes", node, place):
            raise self._document.fault(
                f"{place}: node {node} has a matrix; an animated node has translation, rotation and scale"
            )
        if (int(node), path) in self.of_node:
            raise self._document.fault(f"{place}: the {path} of node {node} is animated twice; choose one animation")
        track = self._track(path, sampler, place)
        self.of_node[int(node), path] = track
        self.duration = max(self.duration, float(track.stamps[-1]))

    def _track(self, path: str, sampler: Json, place: str) -> Track:
        interpolation = sampler.get("interpolation", "LINEAR")
        if interpolation not in ("LINEAR", "STEP", "CUBICSPLINE"):
            raise self._document.fault(
                f"{place}: interpolation: {str(interpolation)[:20]!r} is none of LINEAR, STEP, CUBICSPLINE"
            )
        stamps = self._stamps(sampler, place)
        values = self._document.numbers(sampler.get("output"), KINDS[path], place)
        each = 3 if interpolation == "CUBICSPLINE" else 1
        if len(values) != each * len(stamps):
            raise self._document.fault(
                f"{place}: {len(stamps)} times and {len(values)} values; it needs {each} for each time"
            )
        tangents = None
        if each == 3:
            values = values.reshape(len(stamps), 3, -1)
            values, tangents = values[:, 1], values[:, [0, 2]]
        if path == "rotation":
            self._check_turns(values, interpolation, place)
        return Track(stamps, values, interpolation, tangents)

    def _stamps(self, sampler: Json, place: str) -> Array:
        stamps = self._document.numbers(sampler.get("input"), "SCALAR", place)[:, 0]
        self._keys += len(stamps)
        if self._keys > MOST_KEYS:
            raise self._document.fault(f"has more than {MOST_KEYS} keys")
        if not len(stamps):
            raise self._document.fault(f"{place}: has no key")
        wrong = np.flatnonzero(np.diff(stamps) <= 0)
        if len(wrong) or stamps[0] < 0:
            at = int(wrong[0]) + 1 if len(wrong) else 0
            raise self._document.fault(f"{place}: time {at}: must be from 0 on and increase, but is {stamps[at]:.9g}")
        return stamps

    def _check_turns(self, values: Array, interpolation: str, place: str) -> None:
        lengths = np.linalg.norm(values, axis=1)
        wrong = np.flatnonzero(~((lengths > 1e-3) & (lengths < 1e3)))
        if len(wrong):
            raise self._document.fault(
                f"{place}: rotation {wrong[0]}: is no unit quaternion, but has the length {lengths[wrong[0]]:.3g}"
            )
        units = values / lengths[:, None]
        if interpolation == "LINEAR" and (np.abs((units[1:] * units[:-1]).sum(axis=1)) < HALF_TURN).any():
            self.warnings.append(
                f"{place}: a half turn from key to key has two ways round; taken is that of quaternions as they are written"
            )


def moved(shift: Value, turn: Value, since: float, duration: float, linear: Array) -> Motion:
    """The motion of one node over the whole duration: a turn about its origin, which shifts. Steps are as from `since` on.

    `linear` (3, 3) is that of all nodes above, by which the shifts are multiplied.
    """
    shift, turn = _at_step(shift, since), _at_step(turn, since)
    tracks = [track for track in (shift, turn) if isinstance(track, Track)]
    if not tracks:
        return Motion.at_rest(_poses(shift, turn, linear)[0])
    if all(track.interpolation == "CUBICSPLINE" for track in tracks):
        return cubic_motion(_curve(shift, duration, linear), _curve(turn, duration, np.eye(4)))  # type: ignore[return-value]
    if all(track.interpolation == "LINEAR" and np.array_equal(track.stamps, tracks[0].stamps) for track in tracks):
        return _linear(tracks[0].stamps, _poses(shift, turn, linear), duration)
    # Keys at different times: a product needs no pose between keys, so nothing is rounded.
    return moved(shift, NO_TURN, since, duration, linear) * moved(np.zeros(3), turn, since, duration, linear)


def _at_step(track: Value, since: float) -> Value:
    return track.step_at(since) if isinstance(track, Track) and track.interpolation == "STEP" else track


def _poses(shift: Value, turn: Value, linear: Array) -> Array:
    """Poses (n, 7): x y z qw qx qy qz."""
    shifts, turns = (track.values if isinstance(track, Track) else track[None] for track in (shift, turn))
    count = max(len(shifts), len(turns))
    return np.hstack(
        [np.broadcast_to(shifts @ linear.T, (count, 3)), np.broadcast_to(turns[:, [3, 0, 1, 2]], (count, 4))]
    )


def _linear(stamps: Array, poses: Array, duration: float) -> Motion:
    """Even from key to key. It rests until the first key, and from the last one on."""
    if stamps[0] > 0:
        stamps, poses = np.concatenate([[0.0], stamps]), np.vstack([poses[:1], poses])
    if stamps[-1] < duration:
        stamps, poses = np.concatenate([stamps, [duration]]), np.vstack([poses, poses[-1:]])
    return TimedPoses.through(stamps.tolist(), poses)  # type: ignore[return-value]


def _curve(track: Value, duration: float, linear: Array) -> CubicCurve:
    if not isinstance(track, Track):
        return CubicCurve.constant(linear @ track)
    assert track.tangents is not None
    return CubicCurve.hermite(track.stamps, track.values @ linear.T, track.tangents @ linear.T, duration)
