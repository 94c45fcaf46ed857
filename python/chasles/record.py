"""Many bodies as a page of HTML: an answered scene, or a recording of a simulation."""

import os
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy.typing as npt

from . import _core
from ._core import DistanceMatrix, InvalidInput, Polyhedron, Scene, SceneContact

_KEYS = {"time", "pair", "points", "normals", "gaps", "kind", "time_upper", "certain"}


def write_scene_page(
    scene: Scene,
    found: SceneContact | Sequence[SceneContact] | DistanceMatrix,
    out: str | os.PathLike[str] = "page.html",
    *,
    title: str = "Chasles",
    curve: bool = False,
) -> pathlib.Path:
    """Write a page of HTML that shows an answered scene, and return its path. `scene.view(found, out)` is the same.

    The page shows all bodies, a slider for the time, and a list of the contacts. It is one file and needs no network.

    Parameters
    ----------
    scene : Scene
        As it was when it was asked, or a `copy.copy` of it. A pickled scene is another one.
    found : SceneContact, list of SceneContact, or DistanceMatrix
        The answer of `scene.first_contact`, the whole list of `scene.all_contacts`, or the answer of `scene.least_distances`,
        which the page shows as a table.
    out : path
        The file to write.
    title : str
        The title of the page.
    curve : bool
        Whether the page shows the distance over time below the slider. It takes the time of `scene.profile`.

    Raises
    ------
    InvalidInput
        For the answer of another scene, of this one before it was changed, and for a part of the list of `all_contacts`:
        a page of it would say what is not proven. Also if the package was built without the viewer.
    """
    return _written(_core.scene_page(scene, found, title, curve), out)


def recording_page(
    path: str | os.PathLike[str],
    bodies: Mapping[str, Polyhedron] | Sequence[Polyhedron],
    times: npt.ArrayLike,
    poses: npt.ArrayLike,
    contacts: Iterable[Mapping[str, Any]] = (),
    *,
    title: str = "Chasles",
) -> pathlib.Path:
    """Write a page of HTML that shows recorded motions and contacts of many bodies, and return its path.

    The page interpolates between the recorded poses, and turns a body the shorter way round: record poses that are at most a
    quarter turn apart. It is one file and needs no network.

    Parameters
    ----------
    path : path
        The file to write.
    bodies : dict of str to Polyhedron, or list of Polyhedron
        The shapes, with the names of the bodies. In a list, the names are "body 0", "body 1" and so on. The page holds
        a polyhedron once that several bodies share.
    times : array (n_times,)
        Ascending, in any unit and with any steps. The slider goes from the first time to the last one.
    poses : array (n_times, n_bodies, 7)
        Poses in the world: x y z in the mesh unit, and qw qx qy qz, a quaternion of any length.
    contacts : list of dict
        In any order. Each has the keys

        - ``time``: within `times`.
        - ``pair``: the moving and the fixed body, each as an index or as a name.
        - ``points``: array (k, 3), in the world at this time, on the fixed body; empty by default.
        - ``normals``: array (k, 3), unit vectors from the fixed body to the moving body; as many as points.
        - ``gaps``: array (k,), the distances of the bodies at the points, mesh unit; 0 by default.
        - ``kind``: a text of your choice, for example "impact"; "" by default.
        - ``time_upper``: the upper end of the bracket of the time; `time` by default.
        - ``certain``: whether the contact is proven; True by default.
    title : str
        The title of the page.

    Raises
    ------
    InvalidInput
        For a wrong shape, a pose or a time that is not finite, times that do not ascend, a contact outside of the times
        or of a body that does not exist; or if the package was built without the viewer. The message names the entry.
    """
    names = [str(name) for name in bodies] if isinstance(bodies, Mapping) else [f"body {i}" for i in range(len(bodies))]
    shapes = list(bodies.values()) if isinstance(bodies, Mapping) else list(bodies)
    indices = {name: index for index, name in enumerate(names)}
    events = [_event(contact, f"contacts[{index}]", indices) for index, contact in enumerate(contacts)]
    return _written(_core.recording_page(names, shapes, times, poses, events, title), path)


def _event(contact: Mapping[str, Any], where: str, indices: dict[str, int]) -> dict[str, Any]:
    """The contact with all keys, and with indices instead of names."""
    unknown = [key for key in contact if key not in _KEYS]
    if unknown:
        raise InvalidInput(f"{where}: unknown key {unknown[0]!r}")
    for key in ("time", "pair"):
        if key not in contact:
            raise InvalidInput(f"{where}: {key} is missing")
    if len(contact["pair"]) != 2:
        raise InvalidInput(f"{where}: pair: {len(contact['pair'])} bodies; a pair has 2")
    moving, fixed = (_index(body, where, indices) for body in contact["pair"])
    return {
        "time": float(contact["time"]),
        "time_upper": float(contact.get("time_upper", contact["time"])),
        "certain": bool(contact.get("certain", True)),
        "moving": moving,
        "fixed": fixed,
        "kind": str(contact.get("kind", "")),
        "points": contact.get("points", []),
        "normals": contact.get("normals", []),
        "gaps": contact.get("gaps", []),
    }


def _index(body: Any, where: str, indices: dict[str, int]) -> int:
    if isinstance(body, str):
        if body not in indices:
            raise InvalidInput(f"{where}: pair: there is no body {body!r}")
        return indices[body]
    index = int(body)
    if not 0 <= index < len(indices):
        raise InvalidInput(f"{where}: pair: there is no body {index}, only {len(indices)} from 0")
    return index


def _written(page: str, out: str | os.PathLike[str]) -> pathlib.Path:
    path = pathlib.Path(out)
    path.write_text(page, encoding="utf-8")
    return path
