"""The bounds of tessellations: OCCT's own points of surfaces and edges, and its own distances, refute none."""

import os

import numpy as np
import pytest

import chasles

pytest.importorskip("OCP")
import chasles.cad  # noqa: E402
import cad_shapes as cs  # noqa: E402
from chasles import cad_bounds, cad_faces  # noqa: E402
from chasles.cad_faces import tessellate  # noqa: E402

LONG = bool(os.environ.get("CHASLES_LONG"))
TILT = dict(axis=(1, 2, 3), degrees=40)
SHAPES = {
    "cylinder": lambda: cs.cylinder(5, 20, (1, 2, 3), **TILT),
    "cone": lambda: cs.cone(5, 2, 8, (3, 1, 0)),
    "cone with its apex": lambda: cs.cone(5, 0, 8),
    "cone that widens": lambda: cs.cone(1, 6, 8),
    "sphere": lambda: cs.ball(4, (1, 1, 1)),
    "torus": lambda: cs.torus(9, 3),
    "narrow ring": lambda: cs.torus(20, 0.5),
    "bore": lambda: cs.cut(cs.box(20, 20, 10), cs.cylinder(4, 10, (10, 10, 0)), cs.cone(3, 6, 5, (4, 4, 5))),
    "cylinders that cross": lambda: cs.fuse(cs.cylinder(5, 20), cs.cylinder(3, 30, (-15, 0, 10), axis=(0, 1, 0), degrees=90)),
    "bore across a cylinder": lambda: cs.cut(cs.cylinder(5, 20), cs.cylinder(2, 30, (-15, 1, 10), axis=(0, 1, 0), degrees=90)),
    "cylinder cut askew": lambda: cs.cut(
        cs.cylinder(5, 20), cs.moved(cs.box(40, 40, 40), (-20, -20, 12), axis=(1, 0.3, 0), degrees=25)
    ),
    "sphere cut askew": lambda: cs.cut(cs.ball(5), cs.moved(cs.box(20, 20, 20), (1, -10, -10), axis=(0, 1, 1), degrees=20)),
    "cone cut askew": lambda: cs.cut(cs.cone(6, 3, 10), cs.moved(cs.box(40, 40, 40), (-20, -20, 6), axis=(1, 0, 0), degrees=20)),
    "torus with a bore": lambda: cs.cut(cs.torus(10, 3), cs.cylinder(1, 30, (10, 0, -15))),
    "placed cone": lambda: cs.placed(cs.cone(5, 2, 8), cs.matrix((1, 2, 3), (1, 2, 3), 70)),
    "mirrored bore": lambda: cs.mirrored(cs.cut(cs.box(20, 20, 10), cs.cone(3, 6, 5, (9, 9, 5)))),
    "mirrored torus with a bore": lambda: cs.mirrored(cs.cut(cs.torus(10, 3), cs.cylinder(1, 30, (10, 0, -15)))),
    "lens": lambda: cs.common(cs.ball(5, (0, 0, -3)), cs.ball(5, (0.5, 0, 3))),
}


def checked(shape, deflection, angle, seed=1, count=40):
    """How far OCCT's points are from the triangles at most, and the triangles' points from OCCT's surface; and the bound."""
    random, mesh = np.random.default_rng(seed), tessellate(shape, deflection, angle)
    surface = chasles.Polyhedron(mesh.vertices, mesh.triangles, solid="no")
    assert chasles.Polyhedron(mesh.vertices, mesh.triangles).report.solid_parts == 1
    points = cs.points_of_surface(shape, count, random)
    poses = np.column_stack([points, np.tile([1.0, 0, 0, 0], (len(points), 1))])
    table = chasles.least_distance_batch(chasles.sphere(1e-9), surface, poses, poses)
    faces = mesh.triangles[random.integers(len(mesh.triangles), size=count)]
    weights = random.dirichlet([1, 1, 1], count)
    inner = np.einsum("ij,ijk->ik", weights, mesh.vertices[faces])
    shell = next(cs.explored(shape, cs.TopAbs_ShapeEnum.TopAbs_SHELL))
    return table["distance_upper"].max() + 1e-9, max(cs.distance_of_point(p, shell) for p in inner), mesh


@pytest.mark.parametrize("name", SHAPES)
def test_no_point_is_farther_than_the_bound(name):
    shape, found = SHAPES[name](), []
    for deflection, angle in [(0.02, 0.3), (0.3, 0.8)] + ([(0.001, 0.1), (0.1, 0.2), (1.0, 1.0)] if LONG else []):
        shape = SHAPES[name]()
        out, back, mesh = checked(shape, deflection, angle, count=400 if LONG else 40)
        assert not any("free-form" in kind for kind in mesh.kinds), mesh.kinds
        assert out <= mesh.bound + 1e-8 and back <= mesh.bound + 1e-8, (out, back, mesh.bound)
        found.append(mesh.bound / max(out, back))
    assert min(found) < 4, found  # and none is far above what is found


def test_planes_with_straight_edges_are_exact():
    mesh = tessellate(
        cs.cut(cs.moved(cs.box(3, 4, 5), (1, 2, 3), **TILT), cs.moved(cs.box(1, 1, 9), (2, 3, 0), **TILT)), 0.1, 0.3
    )
    assert mesh.bound == 0 and len(mesh.curved) == 0 and set(mesh.kinds) == {"plane"}


def test_planes_beside_curved_faces_stay_exact():
    mesh = tessellate(cs.cut(cs.box(20, 20, 10), cs.cylinder(4, 10, (10, 10, 0))), 0.05, 0.3)
    flat = np.setdiff1d(np.arange(len(mesh.triangles)), mesh.curved)
    assert len(flat) > 10 and len(mesh.curved) > 0 and 0 < mesh.bound < 0.1
    heights = mesh.vertices[mesh.triangles[flat]]
    is_in = (np.abs(heights) < 1e-12).all(axis=1) | (np.abs(heights - [20, 20, 10]) < 1e-12).all(axis=1)
    assert is_in.any(axis=1).all()  # each is in one of the six planes of the box


class Forgetful:
    """OCCT's mesher, which leaves out all cones at its first calls: no small shape is known at which it does so by itself."""

    def __init__(self, monkeypatch, calls):
        self.mesher, self.calls, self.asked = cad_faces.BRepMesh_IncrementalMesh, calls, []
        monkeypatch.setattr(cad_faces, "BRepMesh_IncrementalMesh", self)

    def __call__(self, shape, deflection, relative, angle, parallel):
        self.asked.append((len(cad_faces._faces_of(shape)), deflection, angle))
        is_forgetful = len(self.asked) <= self.calls
        for face in cad_faces._faces_of(shape) if is_forgetful else [shape]:
            kind = cad_faces.BRepAdaptor_Surface(face).GetType() if is_forgetful else None
            if kind != cad_faces.GeomAbs_SurfaceType.GeomAbs_Cone:
                self.mesher(face, deflection, relative, angle, parallel)


@pytest.mark.parametrize("name", ["bore", "cone with its apex", "cone cut askew", "mirrored bore"])
def test_faces_that_the_mesher_leaves_out_are_meshed_otherwise(name, monkeypatch):
    """The bound holds for the shape as given, whichever way the triangles come."""
    plain = SHAPES[name]()
    count = len(cad_faces._faces_of(plain))
    for calls in range(1, 10):
        with monkeypatch.context() as patch:
            mesher = Forgetful(patch, calls)
            out, back, mesh = checked(SHAPES[name](), 0.05, 0.3, count=100 if LONG else 10)
        assert out <= mesh.bound + 1e-8 and back <= mesh.bound + 1e-8, (calls, out, back, mesh.bound)
        assert len(mesher.asked) == calls + 1 and max(asked[1] for asked in mesher.asked) == 0.05
        assert (mesher.asked[-1][0] > count) == (calls == 1 or calls > 5)  # pieces of closed faces
        assert sum(mesh.kinds.values()) == mesher.asked[-1][0]
        assert calls > 1 or (mesh.bound < 0.08 and "free-form" not in mesh.kinds)  # the cut keeps the proof


def test_a_face_that_no_way_meshes_is_named(monkeypatch):
    Forgetful(monkeypatch, 99)
    with pytest.raises(chasles.InvalidInput) as refused:
        cs.assembly(screw=cs.cone(5, 2, 8, (1, 0, 0)), deflection=0.05)
    text = str(refused.value)
    assert text.startswith("part 'screw': OCCT's mesher leaves out 1 of its faces, the first a cone with a corner at (")
    corner = np.array(text.split("corner at (")[1].split(")")[0].split(","), float)
    assert corner == pytest.approx([3, 0, 8], abs=1e-9) or corner == pytest.approx([6, 0, 0], abs=1e-9)
    assert text.endswith("take an angle far from 0.3 or a deflection far from 0.05, or leave the part out of the model")


def test_free_form_faces_are_said_to_be_such():
    from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

    part = chasles.cad_assembly.Part(
        "x", np.eye(4), None, None, 0.1, tessellate(BRepBuilderAPI_NurbsConvert(cs.cylinder(5, 9)).Shape(), 0.05, 0.3).kinds, None
    )
    assert not part.is_proven and part.kinds["free-form"] >= 1


def test_the_sagitta_of_a_cylinder_is_the_bound():
    u = np.array([0.0, 0.2, 0.2])
    points = np.column_stack([5 * np.cos(u), 5 * np.sin(u), [0, 0, 9]])
    bound = cad_bounds.of_revolution(points, np.array([[0, 1, 2]]), u, 5.0, 0.0)
    assert bound == pytest.approx(5 * (1 - np.cos(0.1)), rel=1e-12)


def test_triangles_about_an_axis_have_no_bound():
    u = np.array([0.0, 2.2, 4.4])
    points = np.column_stack([np.cos(u), np.sin(u), [0, 0, 0]])
    assert cad_bounds.of_revolution(points, np.array([[0, 1, 2]]), u, 1.0, 0.0) == np.inf
    assert cad_bounds.arcs(1.0, np.array([0.0, 4.0])) == np.inf


def test_edges_count(monkeypatch):
    """A face whose edges are farther from their chords than its triangles from the surface."""
    edges = cad_faces._Face._edges
    monkeypatch.setattr(cad_faces._Face, "_edges", lambda face, *given: (0.7, edges(face, *given)[1]))
    assert tessellate(cs.ball(4), 0.02, 0.3).bound >= 0.7


@pytest.mark.parametrize("seed", range(3))
def test_pointed_cones_keep_their_proof(seed):
    """The radius at the apex is 0 up to rounding, at either side of it. The bound holds, as for other cones."""
    random = np.random.default_rng(seed)
    for number in range(40 if LONG else 12):
        radius, height = random.uniform(1, 10), random.uniform(1, 20)
        for shape in (
            cs.cone(radius, 0, height),
            cs.cone(0, radius, height),
            cs.cut(cs.box(30, 30, height, (-15, -15, 0)), cs.cone(radius, 0, height)),
        ):
            kinds = tessellate(cs.moved(shape, random.normal(size=3), random.normal(size=3), 50), 0.05, 0.3).kinds
            assert not any("free-form" in kind for kind in kinds), (radius, height, kinds)
        if number == 0:
            out, back, mesh = checked(cs.cone(radius, 0, height), 0.05, 0.3, seed)
            assert max(out, back) <= mesh.bound + 1e-8 <= 4 * max(out, back) + 1e-8


def test_an_apex_beyond_its_cone_counts():
    """A triangle to a point that is beyond the apex by rounding has the bound of the one to the apex, and by far more has none."""
    u = np.array([0.0, 0.2, 0.0])
    for side in (1.0, -1.0):
        points = np.column_stack([side * np.array([5, 5, 0]) * np.cos(u), side * np.array([5, 5, 0]) * np.sin(u), [-5, -5, 0]])
        bounds = [
            cad_bounds.of_revolution(points, np.array([[0, 1, 2]]), u, side * radius, side * slope)
            for radius, slope in ((0.0, -1.0), (-1e-12, -(1 - 2e-13)), (-1e-3, -(1 - 2e-4)))
        ]
        assert bounds[0] == pytest.approx(5 * (1 - np.cos(0.1)), rel=1e-9)
        assert bounds[1] == pytest.approx(bounds[0], abs=5e-12) and bounds[2] == np.inf
