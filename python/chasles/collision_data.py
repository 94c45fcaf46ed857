"""Contacts and distances of two objects at rest, in the manner of ``trimesh.collision``."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import Contact, InvalidInput, Overlap
from .enums import ContactKind
from .placed import Placed

_FEATURES = {kind: str(kind).split("_") for kind in ContactKind}


class ContactData:
    """A contact of two objects at rest.

    `names` is the set of both names. There is no `depth`: no penetration is measured. Of an object that is inside of
    another one there is a vertex, and neither a `normal` nor a face of the other object.
    """

    def __init__(self, names: tuple[str, str], placed: tuple[Placed, Placed], contact: Any):
        self.names = set(names)
        self._bodies = dict(zip(names, placed, strict=True))
        self._features: dict[str, tuple[int, ...]]
        if isinstance(contact, Contact):
            self._features, self._normal = dict(zip(names, (contact.moving, contact.fixed))), contact.normal
            self._kinds = dict(zip(names, _FEATURES[contact.kind]))
        elif isinstance(contact, Overlap):  # an edge of one object through a face of the other
            of_edge, of_face = names if contact.edge_is_moving else names[::-1]
            self._features = {of_edge: contact.edge, of_face: (contact.face,)}
            self._kinds = {of_edge: "edge", of_face: "face"}
            self._normal = self._bodies[of_face].normal_of(contact.face)
        else:  # an answer: a vertex of one object inside of the other
            inner = names[0] if contact.inside == "moving" else names[1]
            self._features, self._kinds, self._normal = {inner: (contact.inside_vertex,)}, {inner: "vertex"}, None
        self._point = contact.point if self._normal is not None else contact.inside_point

    def __repr__(self) -> str:
        return f"<chasles ContactData: {' and '.join(sorted(self.names))} at {self._point}>"

    @property
    def normal(self) -> npt.NDArray[np.float64]:
        """A unit normal of the contact (3,), in the world; where surfaces cross, that of the face that is crossed."""
        if self._normal is None:
            raise AttributeError("normal: one object is inside of the other one, and no surfaces touch")
        return self._normal

    @property
    def point(self) -> npt.NDArray[np.float64]:
        """A point of both objects (3,), in the world."""
        return self._point

    @property
    def depth(self) -> float:
        raise AttributeError("depth: chasles measures no penetration")

    def index(self, name: str) -> int:
        """The index of a face in contact, of the object of this name. Raises InvalidInput for another name."""
        return _face_index(self._bodies, self._kinds, self._features, name)


class DistanceData:
    """The distance of two objects at rest. `names` is the set of both names."""

    def __init__(self, names: tuple[str, str], placed: tuple[Placed, Placed], found: Any):
        self.names = set(names)
        self._bodies = dict(zip(names, placed, strict=True))
        self._distance, self._lower = found.distance_upper, found.distance
        self._features: dict[str, tuple[int, ...]] = {}
        self._kinds: dict[str, str] = {}
        self._points: dict[str, npt.NDArray[np.float64]] = {}
        self._set_place(names, placed, found)

    def _set_place(self, names: tuple[str, str], placed: tuple[Placed, Placed], found: Any) -> None:
        if found.contacts:
            contact = found.contacts[0]
            self._features = dict(zip(names, (contact.moving, contact.fixed)))
            self._kinds = dict(zip(names, _FEATURES[contact.kind]))
            points = contact.point + contact.gap * contact.normal, contact.point
        elif found.overlap is None and found.inside is None:  # they touch, and no feature is known
            return
        else:
            crossing = ContactData(names, placed, found if found.overlap is None else found.overlap)
            self._features, self._kinds, points = crossing._features, crossing._kinds, (crossing.point,) * 2
        self._points = dict(zip(names, points))

    def __repr__(self) -> str:
        return f"<chasles DistanceData: {self._distance:.12g} between {' and '.join(sorted(self.names))}>"

    @property
    def distance(self) -> float:
        """The distance of the two points: the upper end of the bracket around the least distance. 0 if they touch."""
        return self._distance

    @property
    def lower(self) -> float:
        """The proven lower end of this bracket: the surfaces are not nearer."""
        return self._lower

    def index(self, name: str) -> int:
        """The index of a nearest face, of the object of this name. Raises InvalidInput for another name."""
        return _face_index(self._bodies, self._kinds, self._features, name)

    def point(self, name: str) -> npt.NDArray[np.float64]:
        """The nearest point (3,) of the object of this name, in the world. Raises InvalidInput for another name."""
        if name not in self._points:
            raise InvalidInput(f"{name}: is none of the two objects {' and '.join(sorted(self.names))}")
        return self._points[name]


def _face_index(bodies: Any, kinds: dict[str, str], features: dict[str, tuple[int, ...]], name: str) -> int:
    if name not in bodies:
        raise InvalidInput(f"{name}: is none of the two objects {' and '.join(sorted(bodies))}")
    if name not in features:
        raise InvalidInput(f"{name}: the other object is inside of it, and no face of it touches")
    return bodies[name].face_with(kinds[name], features[name])
