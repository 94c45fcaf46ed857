"""Scenes for pickle: a scene is made again by the functions that made it."""

from collections.abc import Callable
from typing import Any

from ._core import Scene


def scene_from(bodies: list[tuple[Any, ...]], rules: dict[tuple[str, str, str], float]) -> Scene:
    """The scene that has these bodies and rules."""
    scene = Scene()
    for name, shape, motion, group in bodies:
        scene.add(name, shape, motion=motion, group=group)
    for (function, first, second), margin in rules.items():
        margins = (margin,) if function.startswith("set") else ()
        getattr(scene, function)(first, second, *margins)
    return scene


def reduce_scene(scene: Scene) -> tuple[Callable[..., Scene], tuple[Any, ...]]:
    """What pickle calls for a scene."""
    return scene_from, scene.__getstate__()
