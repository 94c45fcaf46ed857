"""Animations of glTF files (.gltf, .glb): what touches first, when and where, proven for the motion between the keys, too.

    found = chasles.gltf.read("scene.glb").first_contact()
    chasles.gltf.mark("scene.glb", found, "marked.glb")

The page docs/gltf.md says what is supported. Nothing but this package is needed.
"""

from __future__ import annotations

import os
import pathlib
from collections.abc import Collection, Iterable, Sequence

from .gltf_animation import Animation
from .gltf_answer import AnimationContact, TimedContact, Untested
from .gltf_bodies import load_bodies
from .gltf_file import Document
from .gltf_marks import write_marked
from .gltf_tracks import Tracks
from .gltf_tree import Tree

__all__ = ["Animation", "AnimationContact", "TimedContact", "Untested", "animations", "mark", "read"]


def animations(path: str | os.PathLike[str]) -> list[str]:
    """The names of the animations of a file, in its order; those without a name are "animation 0", "animation 1" and so on.

    Raises
    ------
    InvalidInput
        If the file cannot be read.
    """
    return names_of(Document(path))


def read(
    path: str | os.PathLike[str],
    animation: str | int | Sequence[str | int] | None = None,
    *,
    leave_out: Collection[str] = (),
    solid: str = "automatic",
    radius: float = 0.0,
    threads: int = 0,
) -> Animation:
    """Read the bodies of a file and how an animation moves them.

    Parameters
    ----------
    path : path
        A file .glb or .gltf.
    animation : str, int or a list of them, optional
        A name or a number from 0. Several are played at the same time. May be left out if the file has only one.
    leave_out : names
        Nodes whose meshes are no bodies, as those that deform.
    solid, radius
        As for `chasles.load_parts`, for all bodies: what is inside of them, and all points within this distance. Below 0, faces of
        closed bodies move inwards: an overlap that is allowed.
    threads : int
        At most so many, to read the meshes; 0 for all cores.

    Returns
    -------
    Animation

    Raises
    ------
    InvalidInput
        For a damaged file, for an animation that does not exist, and for what makes bodies deform: skins, morph targets and
        animated scales. The message names the node.
    """
    return animation_of(Document(path), animation, leave_out=leave_out, solid=solid, radius=radius, threads=threads)


def animation_of(
    document: Document,
    animation: str | int | Sequence[str | int] | None,
    *,
    leave_out: Collection[str],
    solid: str,
    radius: float,
    threads: int,
) -> Animation:
    """See `read`. The program reads a file once, for all that it does with it."""
    names = names_of(document)
    chosen = _chosen(document, names, animation)
    tracks = Tracks(document, chosen)
    if tracks.duration == 0:
        raise document.fault(f"animation {names[chosen[0]]!r} has no duration: nothing moves")
    tree = Tree(document, tracks)
    carriers = tree.carriers(leave_out)
    if not carriers:
        raise document.fault("has no face; a scene needs at least one body")
    bodies = load_bodies(document, carriers, solid=solid, radius=radius, threads=threads)
    kept = [carrier for carrier in carriers if carrier.name in bodies]
    return Animation(
        document.path, document.files, {index: names[index] for index in chosen}, tracks, tree, kept, bodies
    )


def mark(
    path: str | os.PathLike[str],
    found: AnimationContact | Iterable[AnimationContact],
    out: str | os.PathLike[str],
    *,
    size: float | None = None,
) -> pathlib.Path:
    """Write a GLB of the file with a marker at each contact, and return its path.

    A marker is a ball at the point of the contact with an arrow along the normal, towards the moving body. It appears at the time
    of the contact, by a key of its scale in the animation. The name of its node says which bodies touch, and when. The extras of
    the node and of the asset hold the numbers (key "chasles"). A clear answer has no markers. Markers of a former answer are taken out.

    Parameters
    ----------
    path : path
        The file that was read.
    found : AnimationContact, or several
        Answers of `first_contact` or `all_contacts`.
    out : path
        A new file .glb. It is written beside its place and then renamed; no input is written over.
    size : float, optional
        The length of an arrow, in the unit of the scene; a twentieth of the scene by default.

    Raises
    ------
    InvalidInput
        If a file cannot be read or written, or if `out` is an input.
    """
    answers = [found] if isinstance(found, AnimationContact) else list(found)
    document = Document(path)
    return write_marked(document, answers, pathlib.Path(out), size)


def names_of(document: Document) -> list[str]:
    """See `animations`."""
    found = [animation.get("name") for animation in document.items("animations")]
    return [name if isinstance(name, str) and name else f"animation {index}" for index, name in enumerate(found)]


def _chosen(document: Document, names: list[str], animation: str | int | Sequence[str | int] | None) -> list[int]:
    listed = ", ".join(map(repr, names[:20])) + (", ..." if len(names) > 20 else "")
    if not names:
        raise document.fault(
            "has no animation; `chasles scene` and `chasles.Scene` take bodies and motions of one's own"
        )
    if animation is None:
        if len(names) > 1:
            raise document.fault(
                f"has {len(names)} animations ({listed}); choose one, or several that are played at the same time"
            )
        return [0]
    wanted = [animation] if isinstance(animation, (str, int)) else list(animation)
    result = []
    for one in wanted:
        found = [i for i, name in enumerate(names) if name == one] if isinstance(one, str) else [int(one)]
        if len(found) > 1:
            raise document.fault(f"animation {one!r}: {len(found)} have this name; give its number from 0")
        if not found or not 0 <= found[0] < len(names):
            raise document.fault(f"there is no animation {one!r}; there are {listed}")
        result.append(found[0])
    if not result or len(set(result)) < len(result):
        raise document.fault("animation: name at least one, and each once")
    return result
