"""Parts and joints of an assembly as a robot, for `chasles.cad`."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer

from ._core import InvalidInput, Polyhedron, Robot
from .arrays import numbers
from .cad_bounds import Array
from .cad_faces import Tessellation, size_of, tessellate
from .cad_joints import MOVING, WORLD, Joint, leader_of, limits_of, require_joint, require_joints, turn
from .cad_tree import Colour, Node, walk


@dataclasses.dataclass
class Part:
    """A part as it is mounted.

    Attributes
    ----------
    name : str
        Its path in the tree of the assembly, as "arm/pin".
    place : array (4, 4)
        Its pose in the world.
    colour : (red, green, blue) or None
        In [0, 1].
    mesh : Polyhedron
        Its triangles, in its own frame.
    bound : float
        No point of the true part is farther from `mesh`, and no point of the surface of `mesh` farther from that of the part. mm.
    kinds : dict
        How many faces of each kind of surface.
    is_proven : bool
        Whether `bound` is proven. With free-form faces it is what OCCT aims at.
    shape : TopoDS_Shape
        The part of OCCT, in its own frame.
    """

    name: str
    place: Array
    colour: Colour | None
    mesh: Polyhedron
    bound: float
    kinds: dict[str, int]
    shape: Any
    curved: Polyhedron | None = None  # the triangles that are not exact, with the bound as radius

    @property
    def is_proven(self) -> bool:
        return not any("free-form" in kind for kind in self.kinds)

    def outer(self, allowed_overlap: float = 0.0) -> list[Polyhedron]:
        """Bodies that together contain the true part; with an allowed overlap, moved inwards by half of it."""
        if allowed_overlap == 0:
            return [self.mesh] if self.curved is None else [self.mesh, self.curved]
        return [self.mesh.with_radius(self.bound - allowed_overlap / 2)]


class Assembly:
    """Parts as they are mounted, and the joints between them: what `chasles.cad.load` returns."""

    def __init__(self, root: Node, *, deflection: float | None = None, angle: float = 0.3, skip_empty: bool = False) -> None:
        self.name = root.name or "assembly"
        self.parts: dict[str, Part] = {}
        self.joints: list[Joint] = []
        self.assemblies: list[str] = []
        self.warnings: list[str] = []
        known: dict[int, tuple[Tessellation, Any]] = {}
        for path, node, place in walk(root):
            if node.shape is None:
                self.assemblies.append(path)
                continue
            if not TopExp_Explorer(node.shape, TopAbs_ShapeEnum.TopAbs_FACE).More():
                is_empty = not TopExp_Explorer(node.shape, TopAbs_ShapeEnum.TopAbs_VERTEX).More()
                if is_empty and not skip_empty:
                    raise InvalidInput(
                        f"{path}: is empty: its shape is not there; add it, or leave such parts out (skip_empty=True, --skip-empty)"
                    )
                what = "is empty" if is_empty else "has no faces, only curves or points"
                self.warnings.append(f"{path}: {what}, and is left out")
                continue
            key = hash(node.shape)
            if key not in known or not known[key][1].IsSame(node.shape):
                known[key] = (_tessellated(path, node.shape, deflection, angle), node.shape)
            self.parts[path] = _part(path, node, place, known[key][0])
        if not self.parts:
            raise InvalidInput(f"{self.name}: has no parts: nothing in it has faces")

    def add_joint(
        self,
        name: str,
        type: str,
        parent: str,
        child: str,
        *,
        point: npt.ArrayLike = (0, 0, 0),
        axis: npt.ArrayLike = (0, 0, 1),
        lower: float = -np.inf,
        upper: float = np.inf,
        value: float = 0.0,
        follows: tuple[str, float, float] | None = None,
    ) -> Joint:
        """A joint of your own; see `Joint` for its numbers. STEP files have none."""
        ends = (np.array(numbers(given, f"joint {name!r}: {what}")) for given, what in ((point, "point"), (axis, "axis")))
        joint = Joint(name, type, parent, child, *ends, lower, upper, value, follows)
        require_joint(joint, [*self.joints, joint], {*self.parts, *self.assemblies})
        self.joints.append(joint)
        return joint

    def require_joints(self) -> None:
        """Raises InvalidInput for a joint that is none, as one that moves no part, or that follows no other one."""
        require_joints(self.joints, {*self.parts, *self.assemblies})

    @property
    def size(self) -> float:
        """The diagonal of a box around all parts as mounted, mm."""
        corners = [part.mesh.vertices @ part.place[:3, :3].T + part.place[:3, 3] for part in self.parts.values()]
        return float(np.linalg.norm(np.ptp(np.concatenate(corners), axis=0)))

    @property
    def rest(self) -> Array:
        """The configuration of `robot()` in which the assembly is mounted."""
        return np.array([joint.value for joint in self.joints if joint.type in MOVING and joint.follows is None], np.float64)

    def robot(self, *, allowed_overlap: float = 0.0, left_out: Iterable[tuple[str, str]] = ()) -> Robot:
        """The assembly as a robot: each part is a link of its name, and all pairs that a joint moves against each other are tested.

        The frame of a link is the world's as mounted, moved to the point of its joint; `poses` has those of the parts.

        Parameters
        ----------
        allowed_overlap : float
            Two parts that overlap by this much do not touch yet, mm: see docs/cad.md. A warning of the robot names parts whose
            faces cannot be moved inwards; they touch as soon as they are met. Distances of this robot are those of the moved
            faces, which are larger; ask a robot without it for those of the parts.
        left_out : list of (str, str)
            Pairs that are not tested.
        """
        bodies, warnings = self.bodies(allowed_overlap)
        return self.robot_of(bodies, left_out, warnings)

    def bodies(self, allowed_overlap: float) -> tuple[dict[str, list[Polyhedron]], list[str]]:
        """What contains each part, or it with its faces moved inwards; and warnings."""
        found, warnings = {}, []
        for name, part in self.parts.items():
            try:
                found[name] = part.outer(allowed_overlap)
            except InvalidInput as error:
                found[name] = part.outer()
                warnings.append(f"{name}: its faces cannot be moved inwards, so no overlap is allowed: {error}")
        coarse = sum(0 < allowed_overlap < 2 * part.bound for part in self.parts.values())
        if coarse:
            warnings.append(
                f"{coarse} parts have a larger error than half of the allowed overlap; a smaller deflection makes it less"
            )
        return found, warnings

    def robot_of(
        self,
        bodies: Mapping[str, list[Polyhedron]],
        left_out: Iterable[tuple[str, str]] = (),
        warnings: Sequence[str] = (),
        moving: Collection[str] | None = None,
    ) -> Robot:
        """The robot whose parts have these bodies. With `moving`, all joints but these and their followers stay as mounted."""
        self.require_joints()
        groups = self._groups()
        still = {joint.name for joint in self.joints if moving is not None and joint.name not in moving}
        still -= {joint.name for joint in self.joints if leader_of(joint, self.joints)[0].name not in still}
        links: dict[str, dict[str, Any]] = {WORLD: {"name": WORLD}}
        joints = []
        for joint in self.joints:
            links[joint.child] = {"name": joint.child}
            limits = limits_of(joint, self.joints)
            joints.append(_described(joint, limits, self._origin(groups, joint.parent), groups, joint.name in still))
        for name, part in self.parts.items():
            place = part.place.copy()
            place[:3, 3] -= self._origin(groups, name)
            if name not in links:
                links[name] = {"name": name}
                joints.append({"name": f"{name} is fixed", "type": "fixed", "parent": groups[name], "child": name})
            links[name]["collisions"] = [{"shape": body, "origin": place, "deviation": part.bound} for body in bodies[name]]
        out = {frozenset(pair) for pair in left_out}
        rigid = {name: self._rigid(groups, name, still) for name in self.parts}
        moved = [pair for pair in itertools.combinations(self.parts, 2) if rigid[pair[0]] != rigid[pair[1]]]
        return Robot(
            name=self.name,
            links=list(links.values()),
            joints=joints,
            enabled_pairs=[pair for pair in moved if frozenset(pair) not in out],
            disabled_pairs=[(*pair, "left out") for pair in moved if frozenset(pair) in out],
            warnings=warnings,
        )

    def loose(self, bodies: Mapping[str, list[Polyhedron]], left_out: Iterable[tuple[str, str]] = ()) -> tuple[Robot, Array]:
        """A robot whose parts all float, and its configuration as mounted: for questions about all pairs at rest."""
        links: list[dict[str, Any]] = [{"name": WORLD}]
        joints = []
        for name, part in self.parts.items():
            links.append({"name": name, "collisions": [{"shape": body, "origin": part.place} for body in bodies[name]]})
            joints.append({"name": f"{name} floats", "type": "floating", "parent": WORLD, "child": name})
        disabled = [(*pair, "left out") for pair in left_out]
        at_rest = np.tile([0.0, 0, 0, 0, 0, 0, 1], len(self.parts))
        return Robot(name=self.name, links=links, joints=joints, disabled_pairs=disabled), at_rest

    def poses(self, robot: Robot, configuration: npt.ArrayLike) -> dict[str, Array]:
        """The pose (4, 4) of each part at a configuration of `robot()`."""
        groups, links, found = self._groups(), robot.link_poses(configuration), {}
        for name, part in self.parts.items():
            local = part.place.copy()
            local[:3, 3] -= self._origin(groups, name)
            found[name] = links[name] @ local
        return found

    def _groups(self) -> dict[str, str]:
        """For each path and each child of a joint: the child of the joint that moves it, or the world."""
        children = {joint.child for joint in self.joints}
        groups = {WORLD: WORLD}
        for path in [*self.assemblies, *self.parts, *children]:
            above = [path, *(path.rsplit("/", cut)[0] for cut in range(1, path.count("/") + 1))]
            groups[path] = next((name for name in above if name in children), WORLD)
        return groups

    def _origin(self, groups: dict[str, str], path: str) -> Array:
        group = groups[path]
        return next((joint.point for joint in self.joints if joint.child == group), np.zeros(3))

    def _rigid(self, groups: dict[str, str], path: str, still: Collection[str]) -> str:
        """The topmost group that no joint moves against the group of a path."""
        group = groups[path]
        joint = next((joint for joint in self.joints if joint.child == group), None)
        is_fixed = joint is not None and (joint.type == "fixed" or joint.name in still)
        return self._rigid(groups, joint.parent, still) if joint is not None and is_fixed else group


def _tessellated(name: str, shape: Any, deflection: float | None, angle: float) -> Tessellation:
    try:
        return tessellate(shape, deflection or size_of(shape) / 2000, angle)
    except InvalidInput as error:
        raise InvalidInput(f"part {name!r}: {error}") from None


def _part(path: str, node: Node, place: Array, mesh: Tessellation) -> Part:
    try:
        body = Polyhedron(mesh.vertices, mesh.triangles)
        curved = (
            Polyhedron(mesh.vertices, mesh.triangles[mesh.curved], solid="no", radius=mesh.bound) if len(mesh.curved) else None
        )
    except InvalidInput as error:
        raise InvalidInput(f"part {path!r}: {error}") from None
    return Part(path, place, node.colour, body, mesh.bound, mesh.kinds, node.shape, curved)


def _described(
    joint: Joint, limits: tuple[float, float], above: Array, groups: Mapping[str, str], is_still: bool
) -> dict[str, Any]:
    """As a dict of `chasles.Robot`. At the value of the mounted assembly the frame of the child has the axes of the world."""
    axis = joint.axis / np.linalg.norm(joint.axis)
    origin = np.eye(4)
    origin[:3, 3] = joint.point - above
    described: dict[str, Any] = {"name": joint.name, "type": joint.type, "parent": groups[joint.parent], "child": joint.child}
    if is_still:
        return described | {"type": "fixed", "origin": origin}
    if joint.type == "revolute":
        origin[:3, :3] = turn(axis, -joint.value)
    elif joint.type == "prismatic":
        origin[:3, 3] -= joint.value * axis
    if joint.type in MOVING:
        described |= {"axis": axis, "lower": limits[0], "upper": limits[1]}
        if joint.type == "revolute" and not np.isfinite(limits).any():
            described["type"] = "continuous"
    if joint.follows is not None:
        driver, factor, offset = joint.follows
        described["mimic"] = {"joint": driver, "multiplier": factor, "offset": offset}
    return described | {"origin": origin}
