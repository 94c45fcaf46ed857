"""Parts of CadQuery's assemblies, and the joints that their constraints leave, for `chasles.cad`."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from ._core import InvalidInput
from .cad_assembly import Assembly
from .cad_bounds import Array
from .cad_joints import WORLD, turn
from .cad_tree import Colour, Node, matrix_of, split, walk, without_place

_FREE = 1e-6  # of the largest singular value: CadQuery's solver leaves residuals of some 1e-8
_OFF = 1e-4  # of the size: what constraints may be off after a finite step along a freedom

Residual = Callable[[dict[str, Array]], Array]  # of the poses of parts: zeros where the constraint holds


def is_its(thing: Any) -> bool:
    """Whether it is an assembly of CadQuery."""
    return any(f"{type_.__module__}.{type_.__name__}" == "cadquery.assembly.Assembly" for type_ in type(thing).__mro__)


def tree_of(thing: Any, inherited: Colour | None = None) -> Node:
    """The tree of an assembly."""
    colour = thing.color.toTuple()[:3] if thing.color is not None else inherited
    node = Node(thing.name, matrix_of(thing.loc.wrapped), colour, source=thing)
    shapes = thing.shapes
    if shapes:
        from cadquery import Compound  # it is there: the assembly came from it

        whole = shapes[0] if len(shapes) == 1 else Compound.makeCompound(shapes)
        place = matrix_of(whole.wrapped.Location())
        if (place == np.eye(4)).all():
            node.shape = without_place(whole.wrapped)
        else:  # the shape has a place of its own within the part
            node.children.append(Node("shape", place, node.colour, without_place(whole.wrapped)))
        for part in [node, *node.children]:
            if part.shape is not None:
                split(part)
    node.children += [tree_of(child, colour) for child in thing.children]
    return node


def add_joints(assembly: Assembly, root: Node) -> None:
    """The joints that the constraints of the root leave, where the parts are now; all values are 0 there."""
    thing = root.source
    if not thing.constraints:
        return
    places = {thing.name: root.place}
    paths = {thing.name: WORLD}
    for path, node, place in walk(root):
        if node.source is not None and node is not root:
            places.setdefault(node.source.name, place)
            paths.setdefault(node.source.name, path)
    constraints = [_Constraint(tuple(c.objects), pod) for c in thing.constraints for pod in c.toPODs() if c.kind != "Fixed"]
    names = list(dict.fromkeys(name for c in thing.constraints for name in c.objects))
    fixed = [
        name for name in names if name == thing.name or any(c.kind == "Fixed" and name in c.objects for c in thing.constraints)
    ]
    _Tree(assembly, constraints, places, paths).grow(fixed or names[:1], names)


class _Constraint:
    """What has to be zero of the poses of one or two parts."""

    def __init__(self, objects: tuple[str, ...], pod: Any) -> None:
        self.objects = objects
        (markers, self.kind, self.number) = pod
        self.markers = [_numbers(marker) for marker in markers]
        if self.kind not in _RESIDUALS:
            raise InvalidInput(f"constraint {self.kind} of {', '.join(objects)}: is not known; add the joints by add_joint")

    def off(self, poses: dict[str, Array]) -> Array:
        ends = []
        for name, (point, direction) in zip(self.objects, self.markers, strict=True):
            pose = poses[name]
            ends += [pose[:3, :3] @ point + pose[:3, 3], pose[:3, :3] @ direction]
        return np.atleast_1d(_RESIDUALS[self.kind](self.number, *ends))


def _numbers(marker: Any) -> tuple[Array, Array]:
    """The point and the direction of a point, a direction, a line or a plane of OCCT."""
    point, direction = np.zeros(3), np.zeros(3)
    kind = type(marker).__name__
    if kind == "gp_Pnt":
        point = np.array([marker.X(), marker.Y(), marker.Z()])
    elif kind == "gp_Dir":
        direction = np.array([marker.X(), marker.Y(), marker.Z()])
    elif kind in ("gp_Lin", "gp_Pln"):
        at, along = marker.Location(), marker.Direction() if kind == "gp_Lin" else marker.Axis().Direction()
        point = np.array([at.X(), at.Y(), at.Z()])
        direction = np.array([along.X(), along.Y(), along.Z()])
    return point, direction


def _points(distance: float | None, p: Array, _: Array, q: Array, __: Array) -> Array:
    return np.array([np.linalg.norm(p - q) - distance]) if distance else p - q


def _axes(angle: float | None, _: Array, d: Array, __: Array, e: Array) -> Array:
    if angle is None or angle == np.pi:
        return d + e
    return d - e if angle == 0 else np.array([d @ e - np.cos(angle)])


def _in_plane(distance: float | None, p: Array, _: Array, q: Array, normal: Array) -> Array:
    return np.array([(p - q) @ normal - (distance or 0.0)])


def _on_line(distance: float | None, p: Array, _: Array, q: Array, along: Array) -> Array:
    off = p - q - ((p - q) @ along) * along
    return np.array([np.linalg.norm(off) - distance]) if distance else off


_RESIDUALS: dict[str, Callable[..., Array]] = {
    "Point": _points,
    "Axis": _axes,
    "PointInPlane": _in_plane,
    "PointOnLine": _on_line,
}


@dataclasses.dataclass
class _Tree:
    """Parts are joined one after another to those that are placed already."""

    assembly: Assembly
    constraints: list[_Constraint]
    places: dict[str, Array]
    paths: dict[str, str]

    def grow(self, fixed: Iterable[str], names: list[str]) -> None:
        rigid = dict.fromkeys(fixed, WORLD)  # of each placed part: the part, or the world, that it is fixed to
        waiting = [name for name in names if name not in rigid]
        while waiting:
            name = next((name for name in waiting if self.between(name, rigid)), None)
            if name is None:
                raise InvalidInput(f"constraints: {waiting[0]!r} is not connected to a part that is fixed")
            parents = {rigid[end] for c in self.between(name, rigid) for end in c.objects if end != name}
            if len(parents) > 1:
                raise InvalidInput(
                    f"constraints: {name!r} is bound to parts that move: a closed loop; use add_joint with `follows`"
                )
            waiting.remove(name)
            rigid[name] = self.join(name, parents.pop(), self.between(name, rigid))

    def between(self, name: str, rigid: dict[str, str]) -> list[_Constraint]:
        """The constraints of a part with parts that are placed."""
        found = [c for c in self.constraints if name in c.objects and len(c.objects) == 2]
        return [c for c in found if all(end == name or end in rigid for end in c.objects)]

    def join(self, name: str, parent: str, constraints: list[_Constraint]) -> str:
        """Add the joints of a part, and say what it is fixed to afterwards."""
        place = self.places[name]

        def off(move: Array) -> Array:
            return np.concatenate([c.off(self.places | {name: move @ place}) for c in constraints])

        size = 1 + float(np.abs(place[:3, 3]).max())
        freedoms = _freedoms(off, place[:3, 3], size, name)
        child = self.paths[name]
        above = parent if parent == WORLD else self.paths[parent]
        for number, (kind, point, axis) in enumerate(freedoms):
            label = name if len(freedoms) == 1 else f"{name} {number + 1}"
            below = child if number + 1 == len(freedoms) else f"{label} carrier"
            self.assembly.add_joint(label, kind, above, below, point=point, axis=axis)
            above = below
        if not freedoms:
            self.assembly.add_joint(f"{name} is bound", "fixed", above, child)
        return name if freedoms else parent


def _freedoms(off: Callable[[Array], Array], at: Array, size: float, name: str) -> list[tuple[str, Array, Array]]:
    """The joints (kind, point, axis) that leave the residual as it is, from the null space of its derivatives."""
    rows = []
    for twist in np.eye(6):
        steps = [off(_move(twist * step, at, size)) for step in (1e-5, -1e-5)]
        rows.append((steps[0] - steps[1]) / 2e-5)
    _, values, basis = np.linalg.svd(np.array(rows).T, full_matrices=True)
    free = basis[int((values > _FREE * values[0]).sum()) :]
    turns, sizes, mixed = np.linalg.svd(free[:, :3].T, full_matrices=True) if len(free) else (None, np.zeros(0), np.zeros((0, 0)))
    count = int((sizes > 1e-4).sum())
    slides = [twist[3:] / np.linalg.norm(twist[3:]) for twist in (mixed[count:] @ free if len(free) else [])]
    found = [("prismatic", at, axis) for axis in slides]
    twists = mixed[:count] @ free if count else np.zeros((0, 6))
    if count == 1:
        found.append(("revolute", *_axis(twists[0], slides, at, size)))
    elif count == 3 and not slides:
        # Speeds v = w x (at - centre) of all turns: the centre of a ball.
        rows_of = np.concatenate([np.cross(np.eye(3), twist[:3]) for twist in twists])
        centre = at - np.linalg.lstsq(-rows_of, -np.concatenate([twist[3:] * size for twist in twists]), rcond=None)[0]
        found += [("revolute", centre, axis) for axis in np.eye(3)]
    elif count:
        raise InvalidInput(
            f"constraints: {name!r} keeps {len(free)} freedoms that are no joint; add constraints, or joints by add_joint"
        )
    zero = np.abs(off(np.eye(4))).max()
    for angle, way in itertools.product((0.5, -1.0), repeat=2):
        move = np.eye(4)
        for kind, point, axis in found:
            step = np.eye(4)
            step[:3, :3] = turn(axis, angle) if kind == "revolute" else np.eye(3)
            step[:3, 3] = point - step[:3, :3] @ point if kind == "revolute" else way * axis
            move = move @ step
        if np.abs(off(move)).max() > zero + _OFF * size:
            raise InvalidInput(f"constraints: {name!r} moves in a way that is no joint; add joints by add_joint")
    return found


def _move(twist: Array, at: Array, size: float) -> Array:
    """A small turn about a point, and a shift by a part of the size."""
    angle = float(np.linalg.norm(twist[:3]))
    move = np.eye(4)
    move[:3, :3] = turn(twist[:3] / angle, angle) if angle > 0 else np.eye(3)
    move[:3, 3] = at - move[:3, :3] @ at + twist[3:] * size
    return move


def _axis(twist: Array, slides: list[Array], at: Array, size: float) -> tuple[Array, Array]:
    """The point and the direction of the axis of a twist; shifts along slides make no difference."""
    axis = twist[:3] / np.linalg.norm(twist[:3])
    speed = twist[3:] * size / np.linalg.norm(twist[:3])
    for slide in slides:
        speed = speed - (speed @ slide) * slide
    return at + np.cross(axis, speed), axis
