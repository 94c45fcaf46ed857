"""Objects by name at rest: which touch, and how near they are, in the manner of ``trimesh.collision``."""

import copy
import math
from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from ._core import Cancelled, InvalidInput, Motion, Polyhedron, Scene, SceneContact, _nearest_pair, _Use, _why_cancelled
from .articles import with_article
from .arrays import numbers
from .collision_data import ContactData, DistanceData
from .enums import Verdict
from .in_use import change, question
from .meshes import from_trimesh
from .placed import Placed, scene_of

EXTERNAL = "__external"  # the name of an object that is not in the manager, as in trimesh

class CollisionManager:
    """Objects by name with transforms, in the manner of ``trimesh.collision.CollisionManager``.

    The methods, arguments and return values are those of trimesh, which needs python-fcl. There are four differences:

    - Closed objects are solid: an object wholly inside another one touches it, as far as its surface may be.
    - Distances are never negative; they are 0 where objects touch or overlap. Contacts have no depth.
    - Meshes are a `chasles.Polyhedron` or a ``trimesh.Trimesh``. Many objects may share one Polyhedron.
    - `first_contact` tells which objects touch first, and when, while they move from their transforms to goals.

    Lengths are in the meshes' own unit. Transforms are arrays (4, 4), or (7,) for x y z qw qx qy qz. Wrong arguments
    raise InvalidInput, a ValueError, and change nothing. Threads may ask a manager at the same time. A change while
    another thread asks it is refused, by InvalidInput. ``copy.copy(manager)`` can be changed by itself.
    """

    def __init__(self) -> None:
        self._objects: dict[str, Placed] = {}
        self._scene = Scene()
        self._use = _Use()

    def __copy__(self) -> "CollisionManager":
        other = CollisionManager()
        other.__setstate__(self.__getstate__())
        return other

    @question("manager")
    def __getstate__(self) -> dict[str, Any]:
        return {"_objects": dict(self._objects), "_scene": copy.copy(self._scene)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state, _use=_Use())

    def __repr__(self) -> str:
        return f"<chasles.CollisionManager: {len(self._objects)} objects>"

    @change("manager")
    def add_object(self, name: str, mesh: Any, transform: npt.ArrayLike | None = None) -> Polyhedron:
        """Add an object, in the place of one with the same name if there is one, and return its Polyhedron.

        Parameters
        ----------
        name : str
            Printable, not empty, and not "__external".
        mesh : Polyhedron or trimesh.Trimesh
        transform : array (4, 4) or (7,), optional
            The pose in the world; the identity by default.
        """
        if not isinstance(name, str) or name in ("", EXTERNAL) or not name.isprintable():
            raise InvalidInput(f"name: {name!r}: must be a printable text, not empty and not {EXTERNAL!r}")
        placed = _placed(mesh, transform)
        if name in self._objects:
            self._scene.remove(name)
        self._scene.add(name, placed.shape, placed.pose)
        self._objects[name] = placed
        return placed.shape

    @change("manager")
    def remove_object(self, name: str) -> None:
        """Remove an object. Raises InvalidInput for an unknown name."""
        self._get(name)
        self._scene.remove(name)
        del self._objects[name]

    @change("manager")
    def set_transform(self, name: str, transform: npt.ArrayLike) -> None:
        """Give an object another transform. Raises InvalidInput for an unknown name, and for no transform."""
        moved = Placed(self._get(name).shape, _pose(transform))
        self._scene.move(name, moved.pose)
        self._objects[name] = moved

    def _beside(self, placed: Placed) -> Scene:
        """A scene with one more object, in which those of the manager are not tested against each other."""
        scene = copy.copy(self._scene)
        scene.ignore_groups("", "")
        scene.add(EXTERNAL, placed.shape, placed.pose, group=EXTERNAL)
        return scene

    def _get(self, name: str) -> Placed:
        if not isinstance(name, str) or name not in self._objects:
            raise InvalidInput(f"{name} not in collision manager")
        return self._objects[name]

    @question("manager")
    def in_collision_single(
        self, mesh: Any, transform: npt.ArrayLike | None = None, return_names: bool = False, return_data: bool = False
    ) -> Any:
        """Whether an object that is not in the manager touches one in it.

        Parameters
        ----------
        mesh, transform
            As for `add_object`.
        return_names : bool
            Also return the set of names of the objects that it touches.
        return_data : bool
            Also return a list of ContactData, in which the given object has the name "__external".

        Returns
        -------
        bool, or a tuple of it and what was asked for
        """
        placed = _placed(mesh, transform)
        found = _contacts(self._beside(placed), return_names, return_data)
        bodies = {**self._objects, EXTERNAL: placed}
        names = {name for contact in found for name in contact.pair if name != EXTERNAL}  # type: ignore[union-attr]
        return _collisions(found, names, bodies, return_names, return_data)

    @question("manager")
    def in_collision_internal(self, return_names: bool = False, return_data: bool = False) -> Any:
        """Whether any two objects of the manager touch.

        Parameters
        ----------
        return_names : bool
            Also return the set of pairs of names, each in the order of the alphabet.
        return_data : bool
            Also return a list of ContactData.

        Returns
        -------
        bool, or a tuple of it and what was asked for
        """
        found = _contacts(self._scene, return_names, return_data)
        names = {tuple(sorted(contact.pair)) for contact in found}  # type: ignore[type-var]
        return _collisions(found, names, self._objects, return_names, return_data)

    @question("manager")
    def in_collision_other(
        self, other_manager: "CollisionManager", return_names: bool = False, return_data: bool = False
    ) -> Any:
        """Whether any object of this manager touches one of another manager.

        Parameters
        ----------
        other_manager : CollisionManager
        return_names : bool
            Also return the set of pairs of names, that of this manager first.
        return_data : bool
            Also return a list of ContactData.

        Returns
        -------
        bool, or a tuple of it and what was asked for
        """
        scene, bodies = scene_of([self._objects, _objects_of(other_manager)])
        found = _contacts(scene, return_names, return_data)
        names = {tuple(name[1:] for name in sorted(contact.pair)) for contact in found}  # type: ignore[type-var]
        return _collisions(found, names, bodies, return_names, return_data, first_letter=1)

    @question("manager")
    def min_distance_single(
        self, mesh: Any, transform: npt.ArrayLike | None = None, return_name: bool = False, return_data: bool = False
    ) -> Any:
        """The least distance of an object that is not in the manager from those in it; infinite if there are none.

        Parameters
        ----------
        mesh, transform
            As for `add_object`.
        return_name : bool
            Also return the name of the nearest object, or None.
        return_data : bool
            Also return a DistanceData, or None. The given object has the name "__external".

        Returns
        -------
        float, or a tuple of it and what was asked for
        """
        placed = _placed(mesh, transform)
        bodies = {**self._objects, EXTERNAL: placed}
        distance, names, data = _nearest(self._beside(placed), bodies, list(self._objects), [EXTERNAL])
        return _chosen(distance, (return_name, names and names[0]), (return_data, data))

    @question("manager")
    def min_distance_internal(
        self, name: str | None = None, return_names: bool = False, return_data: bool = False
    ) -> Any:
        """The least distance of any two objects, or of one object from the others; infinite if there is no pair.

        Parameters
        ----------
        name : str, optional
            The one object. Raises InvalidInput if it is unknown.
        return_names : bool
            Also return both names in the order of the alphabet, or None.
        return_data : bool
            Also return a DistanceData, or None.

        Returns
        -------
        float, or a tuple of it and what was asked for
        """
        if name is not None:
            self._get(name)
        first = list(self._objects) if name is None else [name]
        second = None if name is None else [other for other in self._objects if other != name]
        distance, names, data = _nearest(self._scene, self._objects, first, second)
        return _chosen(distance, (return_names, names and tuple(sorted(names))), (return_data, data))

    @question("manager")
    def min_distance_other(
        self, other_manager: "CollisionManager", return_names: bool = False, return_data: bool = False
    ) -> Any:
        """The least distance of any object of this manager from any of another one; infinite if there is no pair.

        Parameters
        ----------
        other_manager : CollisionManager
        return_names : bool
            Also return both names, that of this manager first, or None.
        return_data : bool
            Also return a DistanceData, or None.

        Returns
        -------
        float, or a tuple of it and what was asked for
        """
        scene, bodies = scene_of([self._objects, _objects_of(other_manager)])
        groups = [[name for name in bodies if name[0] == group] for group in "01"]
        distance, names, data = _nearest(scene, bodies, *groups, first_letter=1)
        return _chosen(distance, (return_names, names), (return_data, data))

    @question("manager")
    def first_contact(
        self,
        goals: Mapping[str, npt.ArrayLike],
        *,
        margin: float = 0.0,
        motion: Literal["velocity", "twist"] = "velocity",
    ) -> SceneContact:
        """The first contact of all objects, while those with goals move from their transforms to their goals.

        The manager stays as it is. The answer is proven for the whole motion, not for samples.

        Parameters
        ----------
        goals : dict of arrays (4, 4) or (7,)
            By name. Objects without a goal stand still.
        margin : float
            Distance that counts as contact, mesh unit.
        motion : "velocity" or "twist"
            How the objects move: as `Scene.add` says.

        Returns
        -------
        SceneContact
            Its `pair` names the two objects, or is None if the whole motion is clear. Times are in [0, 1].
        """
        if not isinstance(goals, Mapping):
            raise InvalidInput(f"goals: {with_article(goals)} is not a dict of transforms by name")
        if motion not in ("velocity", "twist"):
            raise InvalidInput(f"motion: {motion!r} is no kind of motion in a scene; velocity and twist are")
        for name in goals:
            self._get(name)
        scene = Scene()
        for name, placed in self._objects.items():
            goal = _pose(goals[name], f"goals[{name!r}]") if name in goals else None
            scene.add(name, placed.shape, placed.pose, goal, motion=None if goal is None else motion)
        return scene.first_contact(margin=margin)


def _placed(mesh: Any, transform: npt.ArrayLike | None) -> Placed:
    shape = mesh if isinstance(mesh, Polyhedron) else from_trimesh(mesh)
    return Placed(shape, _pose(np.eye(4) if transform is None else transform))


def _pose(transform: npt.ArrayLike, name: str = "transform") -> npt.NDArray[np.float64]:
    """A copy that later changes of the argument do not reach. Refuses what is no pose."""
    pose = np.array(numbers(transform, name))
    try:
        Motion.at_rest(pose)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"{name}: {str(error).removeprefix('pose: ')}") from None
    return pose


def _objects_of(manager: Any) -> dict[str, Placed]:
    if not isinstance(manager, CollisionManager):
        raise TypeError(f"other_manager: {with_article(manager)} is not a chasles.CollisionManager")
    return dict(manager._objects)  # another thread may change the manager


def _contacts(scene: Scene, return_names: bool, return_data: bool) -> list[SceneContact]:
    """All pairs that touch at the start if they are asked for, otherwise at most one."""
    if return_names or return_data:
        return scene.all_contacts(until=0, find="first_with_all_contacts" if return_data else "first")
    found = scene.first_contact(until=0, find="any")
    if found.verdict == Verdict.unknown:
        raise Cancelled(_why_cancelled)
    return [] if found.verdict == Verdict.clear else [found]


def _collisions(
    found: list[SceneContact],
    names: set[Any],
    bodies: Mapping[str, Placed],
    return_names: bool,
    return_data: bool,
    first_letter: int = 0,
) -> Any:
    data: list[ContactData] = []
    for pair in found if return_data else []:
        moving, fixed = pair.pair  # type: ignore[misc]
        placed, shown = (bodies[moving], bodies[fixed]), (moving[first_letter:], fixed[first_letter:])
        others = [pair.overlap] * (pair.overlap is not None) + [pair] * (pair.inside is not None)
        data += [ContactData(shown, placed, contact) for contact in [*pair.contacts, *others]]
    return _chosen(bool(found), (return_names, names), (return_data, data))


def _chosen(first: Any, *others: tuple[bool, Any]) -> Any:
    chosen = [first, *(value for is_asked, value in others if is_asked)]
    return tuple(chosen) if len(chosen) > 1 else first


def _nearest(
    scene: Scene, bodies: Mapping[str, Placed], first: list[str], second: list[str] | None, first_letter: int = 0
) -> tuple[float, tuple[str, str] | None, DistanceData | None]:
    """The nearest pair of a body of each list, or of two bodies of the first list."""
    nearest = _nearest_pair(scene, first, second, tolerance=1e-12)
    if nearest is None or nearest.pair is None:
        return math.inf, None, None
    moving, fixed = nearest.pair
    shown = moving[first_letter:], fixed[first_letter:]
    return nearest.distance_upper, shown, DistanceData(shown, (bodies[moving], bodies[fixed]), nearest)
