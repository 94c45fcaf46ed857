"""Shapes of OCCT for the tests of `chasles.cad`, and what OCCT says about them."""

import numpy as np
from chasles.cad_assembly import Assembly
from chasles.cad_tree import Node, explored
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex, BRepBuilderAPI_Transform
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCone,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakeSphere,
    BRepPrimAPI_MakeTorus,
)
from OCP.BRepClass import BRepClass_FaceClassifier
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt, gp_Pnt2d, gp_Trsf
from OCP.TopAbs import TopAbs_ShapeEnum, TopAbs_State
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS

as_face = getattr(TopoDS, "Face_s", None) or TopoDS.Face
as_edge = getattr(TopoDS, "Edge_s", None) or TopoDS.Edge


def trsf(matrix):
    move = gp_Trsf()
    move.SetValues(*np.asarray(matrix, float)[:3].ravel().tolist())
    return move


def matrix(shift=(0, 0, 0), axis=(0, 0, 1), degrees=0.0):
    result, axis = np.eye(4), np.array(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    angle = np.radians(degrees)
    result[:3, :3] += np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
    result[:3, 3] = shift
    return result


def moved(shape, *place, **options):
    """The geometry itself is moved: the shape has no place of its own."""
    return BRepBuilderAPI_Transform(shape, trsf(matrix(*place, **options)), True).Shape()


def placed(shape, pose):
    return shape.Located(TopLoc_Location(trsf(pose)))


def mirrored(shape):
    """Its surfaces have left-handed frames."""
    mirror = gp_Trsf()
    mirror.SetMirror(gp_Ax2(gp_Pnt(1, 2, 3), gp_Dir(1, 2, 2)))
    return BRepBuilderAPI_Transform(shape, mirror, True).Shape()


def box(x, y, z, at=(0, 0, 0)):
    """Its least corner is at a point."""
    return BRepPrimAPI_MakeBox(gp_Pnt(*map(float, at)), float(x), float(y), float(z)).Shape()


def cylinder(radius, height, at=(0, 0, 0), axis=(0, 0, 1), degrees=0.0):
    return moved(BRepPrimAPI_MakeCylinder(radius, height).Shape(), at, axis, degrees)


def cone(low, high, height, at=(0, 0, 0)):
    return moved(BRepPrimAPI_MakeCone(low, high, height).Shape(), at)


def ball(radius, at=(0, 0, 0)):
    return moved(BRepPrimAPI_MakeSphere(radius).Shape(), at)


def torus(major, minor, at=(0, 0, 0)):
    return moved(BRepPrimAPI_MakeTorus(major, minor).Shape(), at)


def cut(shape, *tools):
    for tool in tools:
        shape = BRepAlgoAPI_Cut(shape, tool).Shape()
    return shape


def fuse(shape, *others):
    for other in others:
        shape = BRepAlgoAPI_Fuse(shape, other).Shape()
    return shape


def common(shape, other):
    return BRepAlgoAPI_Common(shape, other).Shape()


def assembly(deflection=0.01, angle=0.3, **shapes):
    """Parts by name, all where their geometry is."""
    return Assembly(
        Node("model", children=[Node(name, shape=shape) for name, shape in shapes.items()]), deflection=deflection, angle=angle
    )


def distance(first, second):
    """By OCCT."""
    return BRepExtrema_DistShapeShape(first, second).Value()


def distance_of_point(point, shape):
    return distance(BRepBuilderAPI_MakeVertex(gp_Pnt(*map(float, point))).Vertex(), shape)


def points_of_surface(shape, count, random):
    """Points of all faces and edges, by OCCT's parameters."""
    points = []
    for face in map(as_face, explored(shape, TopAbs_ShapeEnum.TopAbs_FACE)):
        surface = BRepAdaptor_Surface(face)
        ends = [surface.FirstUParameter(), surface.LastUParameter(), surface.FirstVParameter(), surface.LastVParameter()]
        for _ in range(count):
            u, v = random.uniform(ends[0], ends[1]), random.uniform(ends[2], ends[3])
            if BRepClass_FaceClassifier(face, gp_Pnt2d(u, v), 1e-9).State() != TopAbs_State.TopAbs_OUT:
                points.append(surface.Value(u, v))
    for edge in map(as_edge, explored(shape, TopAbs_ShapeEnum.TopAbs_EDGE)):
        curve = BRepAdaptor_Curve(edge)
        if curve.Is3DCurve():
            points += [curve.Value(t) for t in random.uniform(curve.FirstParameter(), curve.LastParameter(), count)]
    return np.array([(p.X(), p.Y(), p.Z()) for p in points])
