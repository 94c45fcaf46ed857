"""Triangles of one part's shape by OCCT, with a bound of their error, for `chasles.cad`."""

from __future__ import annotations

import collections
import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Curve2d, BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.GeomAbs import GeomAbs_CurveType, GeomAbs_SurfaceType
from OCP.GeomConvert import GeomConvert
from OCP.ShapeExtend import ShapeExtend_Status
from OCP.ShapeUpgrade import ShapeUpgrade_ShapeDivideClosed
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS

from . import cad_bounds as bounds
from ._core import InvalidInput
from .cad_bounds import Array, Triangles
from .cad_tree import explored

# The casts have other names before OCP 8.
_as_face = getattr(TopoDS, "Face_s", None) or TopoDS.Face
_as_edge = getattr(TopoDS, "Edge_s", None) or TopoDS.Edge
_as_vertex = getattr(TopoDS, "Vertex_s", None) or TopoDS.Vertex
KINDS = {
    GeomAbs_SurfaceType.GeomAbs_Plane: "plane",
    GeomAbs_SurfaceType.GeomAbs_Cylinder: "cylinder",
    GeomAbs_SurfaceType.GeomAbs_Cone: "cone",
    GeomAbs_SurfaceType.GeomAbs_Sphere: "sphere",
    GeomAbs_SurfaceType.GeomAbs_Torus: "torus",
}
_ROUNDING = 1e-12  # of the coordinates: what evaluating points and frames in double may be off


@dataclasses.dataclass
class Tessellation:
    """Triangles of a shape. `curved` numbers those that may be off the true surface by `bound`; the others are exact."""

    vertices: Array
    triangles: Triangles
    curved: Triangles
    bound: float
    kinds: dict[str, int]  # how many faces of each kind; of "free-form" ones the bound is OCCT's word


def tessellate(shape: Any, deflection: float, angle: float) -> Tessellation:
    """The triangles of all faces of a shape.

    Faces of one edge share its vertices, so a shape without gaps becomes a closed surface.
    """
    nodes = _Nodes()
    triangles, curved, bound = [], [], 0.0
    kinds: collections.Counter[str] = collections.Counter()
    faces = [_Face(face, nodes) for face in _meshed_faces(shape, deflection, angle)]
    if not faces:
        raise InvalidInput("has no faces")
    is_covered = {edge for face in faces if face.kind != "plane" for edge in face.bent}
    count = 0
    for face in faces:
        kinds[face.kind] += 1
        is_exact = face.error == 0 or (face.kind == "plane" and face.is_flat and is_covered >= set(face.bent))
        bound = max(bound, face.error)
        if not is_exact:
            curved.append(np.arange(count, count + len(face.triangles)))
        triangles.append(face.triangles)
        count += len(face.triangles)
    vertices, index, moved = nodes.joined()
    size = float(np.abs(vertices).max())
    bound = bound + moved
    return Tessellation(
        vertices,
        index[np.concatenate(triangles)],
        np.concatenate([np.zeros(0, np.int64), *curved]),
        bound * (1 + 1e-9) + _ROUNDING * size if bound > 0 else 0.0,
        dict(kinds),
    )


def _meshed_faces(shape: Any, deflection: float, angle: float) -> list[Any]:
    """All faces of a shape, each with triangles.

    OCCT's mesher leaves out some faces, mostly closed ones. So the shape is meshed again, never with a larger deflection: with its
    closed faces divided, then with other angles, then finer. Bounds are those of the triangles that come of it.
    """
    left = _left_out(shape, deflection, angle)
    if not left:
        return _faces_of(shape)
    divided = _divided(shape)
    ways = [(divided, 1.0, 1.0)]
    ways += [(way, share, times) for way in (shape, divided) for share, times in ((1.0, 1.4), (1.0, 2.0), (1.0, 0.7), (0.25, 1.0))]
    for way, share, times in ways:
        if way is None:
            continue
        BRepTools.Clean_s(way)  # or triangles that are there are kept
        if not _left_out(way, share * deflection, min(times * angle, 1.0)):
            return _faces_of(way)
    kind = KINDS.get(BRepAdaptor_Surface(left[0]).GetType(), "free-form face")
    corner = BRep_Tool.Pnt_s(_as_vertex(next(explored(left[0], TopAbs_ShapeEnum.TopAbs_VERTEX))))
    raise InvalidInput(
        f"OCCT's mesher leaves out {len(left)} of its faces, the first a {kind} with a corner at ({corner.X():.6g}, {corner.Y():.6g}, "
        f"{corner.Z():.6g}) in its frame: take an angle far from {angle:.3g} or a deflection far from {deflection:.3g}, or leave the "
        "part out of the model"
    )


def _faces_of(shape: Any) -> list[Any]:
    return [_as_face(face) for face in explored(shape, TopAbs_ShapeEnum.TopAbs_FACE)]


def _left_out(shape: Any, deflection: float, angle: float) -> list[Any]:
    """Meshes a shape; the faces that have no triangles then."""
    BRepMesh_IncrementalMesh(shape, deflection, False, angle, True)
    return [face for face in _faces_of(shape) if not _has_triangles(face)]


def _has_triangles(face: Any) -> bool:
    mesh = BRep_Tool.Triangulation_s(face, TopLoc_Location())
    return mesh is not None and mesh.NbTriangles() > 0


def _divided(shape: Any) -> Any | None:
    """The shape with its closed faces in pieces of the same surfaces; None where none is divided."""
    divide = ShapeUpgrade_ShapeDivideClosed(shape)
    return divide.Result() if divide.Perform() and not divide.Status(ShapeExtend_Status.ShapeExtend_FAIL) else None


def size_of(shape: Any) -> float:
    """The diagonal of a box around a shape, which may be a little larger than it."""
    box = Bnd_Box()
    BRepBndLib.Add_s(shape, box, False)
    if box.IsVoid():
        raise InvalidInput("has no faces")
    return float(np.sqrt(box.SquareExtent()))


class _Nodes:
    """The nodes of all faces. Those of one edge are joined."""

    def __init__(self) -> None:
        self.points: list[Array] = []
        self.count = 0
        self.same: dict[Any, list[int]] = collections.defaultdict(list)

    def add(self, points: Array) -> int:
        self.points.append(points)
        self.count += len(points)
        return self.count - len(points)

    def joined(self) -> tuple[Array, Triangles, float]:
        """Vertices, the vertex of each node, and how far a node has moved at most."""
        root = np.arange(self.count)
        for group in self.same.values():
            tops = {_top(root, node) for node in group}
            root[list(tops)] = min(tops)
        root = np.array([_top(root, node) for node in range(self.count)])
        points = np.concatenate(self.points)
        kept, index = np.unique(root, return_inverse=True)
        moved = float(np.linalg.norm(points - points[root], axis=1).max())
        size = float(np.abs(points).max())
        return points[kept], index, moved if moved > _ROUNDING * size else 0.0


def _top(root: Any, node: int) -> int:
    while root[node] != node:
        node = root[node]
    return int(node)


class _Face:
    """A face with its triangles, and how far they may be from it."""

    def __init__(self, face: Any, nodes: _Nodes) -> None:
        place = TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face, place)
        move = place.Transformation()
        raw = [mesh.Node(i).Transformed(move) for i in range(1, mesh.NbNodes() + 1)]
        self.points = np.array([(p.X(), p.Y(), p.Z()) for p in raw])
        self.mesh, self.place = mesh, place
        self.deflection = float(mesh.Deflection())
        local = np.array([mesh.Triangle(i).Get() for i in range(1, mesh.NbTriangles() + 1)]) - 1
        if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
            local = local[:, ::-1]
        first = nodes.add(self.points)
        self.triangles = local + first
        self.size = float(np.abs(self.points).max())
        surface = BRepAdaptor_Surface(face)
        self.kind = KINDS.get(surface.GetType(), "free-form")
        self.bent: list[int] = []  # edges that are not straight
        chords, is_along = self._edges(face, nodes, first)
        self.is_flat = True
        self.error = self._error(surface, local, chords, is_along)

    def _edges(self, face: Any, nodes: _Nodes, first: int) -> tuple[float, bool]:
        """How far edges are from their chords at most, and whether each one follows a parameter line."""
        chords, is_along = 0.0, True
        for shape in explored(face, TopAbs_ShapeEnum.TopAbs_EDGE):
            edge = _as_edge(shape)
            polygon = BRep_Tool.PolygonOnTriangulation_s(edge, self.mesh, self.place)
            if polygon is None:
                raise InvalidInput("an edge has no chords: repair the shape")
            ids = np.array([polygon.Node(i) for i in range(1, polygon.NbNodes() + 1)]) - 1
            if BRep_Tool.Degenerated_s(edge):
                nodes.same["point", first, *map(int, ids[:1])].extend(int(i) + first for i in ids)
                continue
            key = _number_of(edge)
            for position, node in enumerate(ids):
                nodes.same[key, position].append(int(node) + first)
            off, is_line = self._chords(edge, polygon, ids)
            if not is_line:
                self.bent.append(key)
                is_along &= self._follows_a_line(face, edge, ids)
                off += BRep_Tool.Tolerance_s(edge)
            chords = max(chords, off)
        return chords, is_along

    def _chords(self, edge: Any, polygon: Any, ids: Any) -> tuple[float, bool]:
        """How far one edge is from its chords, and whether it is straight."""
        curve, kind = BRepAdaptor_Curve(edge), GeomAbs_CurveType
        if curve.GetType() == kind.GeomAbs_Line:
            return 0.0, True
        if not polygon.HasParameters():
            return self._unknown_edge(), False
        stamps = [polygon.Parameter(i) for i in range(1, len(ids) + 1)]
        true = np.array([(p.X(), p.Y(), p.Z()) for p in map(curve.Value, stamps)])
        off = float(np.linalg.norm(true - self.points[ids], axis=1).max())
        if curve.GetType() == kind.GeomAbs_Circle:
            return off + bounds.arcs(curve.Circle().Radius(), np.array(stamps)), False
        if curve.GetType() == kind.GeomAbs_Ellipse:
            return off + bounds.arcs(curve.Ellipse().MajorRadius(), np.array(stamps)), False
        if curve.GetType() == kind.GeomAbs_Parabola:
            return off + bounds.bent(np.array(stamps), np.full(len(stamps) - 1, 0.5 / curve.Parabola().Focal())), False
        if curve.GetType() == kind.GeomAbs_Hyperbola:
            shape, far = curve.Hyperbola(), np.maximum(np.abs(stamps[:-1]), np.abs(stamps[1:]))
            return off + bounds.bent(
                np.array(stamps), np.hypot(shape.MajorRadius() * np.cosh(far), shape.MinorRadius() * np.sinh(far))
            ), False
        if curve.GetType() in (kind.GeomAbs_BSplineCurve, kind.GeomAbs_BezierCurve):
            is_spline = curve.GetType() == kind.GeomAbs_BSplineCurve
            spline = curve.BSpline() if is_spline else GeomConvert.CurveToBSplineCurve_s(curve.Bezier())
            return off + max(map(bounds.poles, true[:-1], true[1:], _poles(spline, stamps))), False
        return self._unknown_edge(), False

    def _unknown_edge(self) -> float:
        self.kind = "plane with free-form edges" if self.kind.startswith("plane") else "free-form"
        return self.deflection

    def _follows_a_line(self, face: Any, edge: Any, ids: Any) -> bool:
        """Whether one parameter of the surface stays along an edge: a line of parameters, or a circle, which three points name."""
        line = BRepAdaptor_Curve2d(edge, face)
        if line.GetType() == GeomAbs_CurveType.GeomAbs_Line and self.kind != "sphere":
            way = line.Line().Direction()
            if min(abs(way.X()), abs(way.Y())) < _ROUNDING:
                return True
        if BRepAdaptor_Curve(edge).GetType() != GeomAbs_CurveType.GeomAbs_Circle or len(ids) < 3 or not self.mesh.HasUVNodes():
            return False
        return bool((np.ptp(self._parameters()[ids], axis=0) < 1e-9).any())

    def _parameters(self) -> Array:
        nodes = [self.mesh.UVNode(i) for i in range(1, self.mesh.NbNodes() + 1)]
        return np.array([(p.X(), p.Y()) for p in nodes])

    def _error(self, surface: Any, triangles: Triangles, chords: float, is_along: bool) -> float:
        if self.kind not in KINDS.values() or not self.mesh.HasUVNodes():
            self.kind = self.kind if self.kind.startswith("plane") else "free-form"
            self.is_flat = False
            return max(self.deflection, chords if np.isfinite(chords) else 0.0)
        place, numbers = _frame(surface, self.kind)
        points = (self.points - place[3]) @ place[:3].T
        if self.kind == "plane":
            off = bounds.plane(points)
            self.is_flat = off <= _ROUNDING * self.size
            return chords if self.is_flat else chords + off
        parameters = self._parameters()
        if self.kind == "sphere":
            error = bounds.sphere(points, triangles, *numbers)
        elif self.kind == "torus":
            error = bounds.torus(points, triangles, parameters, *numbers)
        else:
            error = bounds.of_revolution(points, triangles, parameters[:, 0], *numbers)
        error = max(error, chords)
        if np.isfinite(error) and (is_along or error < bounds.least_radius(self.kind, points, numbers)):
            return error
        self.kind = "free-form"  # too coarse beside its curvature for a proof
        return max(self.deflection, chords if np.isfinite(chords) else 0.0)


def _frame(surface: Any, kind: str) -> tuple[Array, tuple[float, ...]]:
    """The axes and the origin of a surface as rows (4, 3), and its numbers."""
    shape = getattr(surface, kind.capitalize())()
    axes = shape.Position()
    numbers = {
        "plane": lambda: (),
        "cylinder": lambda: (shape.Radius(), 0.0),
        "cone": lambda: (shape.RefRadius(), float(np.tan(shape.SemiAngle()))),
        "sphere": lambda: (shape.Radius(),),
        "torus": lambda: (shape.MajorRadius(), shape.MinorRadius()),
    }[kind]()
    rows = [axes.XDirection(), axes.YDirection(), axes.Direction(), axes.Location()]  # left-handed where the shape is mirrored
    place = np.array([(row.X(), row.Y(), row.Z()) for row in rows])
    return place, numbers


def _poles(curve: Any, stamps: list[float]) -> Iterator[Array]:
    """Of each part of a spline between two parameters: points in whose hull it lies, if weights are above 0, as OCCT demands."""
    for start, end in zip(stamps[:-1], stamps[1:], strict=True):
        part = GeomConvert.SplitBSplineCurve_s(curve, min(start, end), max(start, end), 1e-12)
        found = [part.Pole(i) for i in range(1, part.NbPoles() + 1)]
        yield np.array([(p.X(), p.Y(), p.Z()) for p in found])


def _number_of(edge: Any) -> Any:
    """The same for each use of one edge, in whichever direction."""
    return hash(edge.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
