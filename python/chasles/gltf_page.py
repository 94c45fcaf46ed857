"""The page of an animation, for `chasles.gltf`."""

from __future__ import annotations

import pathlib
from typing import TYPE_CHECKING, Any

import numpy as np

from .gltf_answer import AnimationContact
from .program import beside
from .poses import seven_numbers
from .record import recording_page

if TYPE_CHECKING:
    from .gltf_animation import Animation

FRAMES = 240
MOST_POSES = 400_000  # of all bodies, for fast turns
MOST_TURN = 0.5  # radians from frame to frame


def write_page(animation: Animation, answers: list[AnimationContact], out: pathlib.Path, title: str) -> pathlib.Path:
    """See `Animation.view`."""
    duration = animation.duration
    times = [np.linspace(0, duration, FRAMES + 1), animation.jumps, np.nextafter(animation.jumps, 0)]
    contacts = [answer for answer in answers if answer.pair is not None]
    times.append(np.clip([answer.time for answer in contacts], 0, duration))
    turns = animation.frames(MOST_TURN)
    stamps = np.unique(np.concatenate([*times, turns[:: 1 + len(turns) * len(animation.bodies) // MOST_POSES]]))
    poses = np.array([[seven_numbers(pose) for pose in animation.poses(float(time)).values()] for time in stamps])
    with beside(out, animation.files) as file:
        recording_page(file, animation.bodies, stamps, poses, [_event(answer) for answer in contacts], title=title)
    return out


def _event(answer: AnimationContact) -> dict[str, Any]:
    return {
        "time": answer.time,
        "time_upper": answer.time_upper,
        "pair": answer.pair,
        "certain": answer.certain,
        "points": [contact.point.tolist() for contact in answer.contacts],
        "normals": [contact.normal.tolist() for contact in answer.contacts],
        "gaps": [contact.gap for contact in answer.contacts],
    }
