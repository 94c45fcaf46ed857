"""Models of Pinocchio as robots: its own kinematics and the collision of coal at many poses, and what is refused."""

import doctest
import os
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT
from test_docs import code_of

import chasles

pin = pytest.importorskip("pinocchio", minversion="4")
coal = pytest.importorskip("coal")
import chasles.pinocchio  # noqa: E402

MIMICS = """<robot name="mimics"><link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="e"/><link name="f"/>
<joint name="turn" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0.6 0.8"/></joint>
<joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="0.6 0.8 0"/><origin xyz="1 2 3" rpy="1 2 3"/>
 <limit lower="-1" upper="1.5" effort="1" velocity="1"/></joint>
<joint name="turn of slide" type="revolute"><parent link="c"/><child link="d"/><axis xyz="0.6 0 0.8"/><mimic joint="slide"
 multiplier="0.5" offset="0.1"/><origin xyz="1 2 3" rpy="1 2 3"/><limit lower="-9" upper="9" effort="1" velocity="1"/></joint>
<joint name="slide of slide" type="prismatic"><parent link="d"/><child link="e"/><axis xyz="0 0 1"/><mimic joint="slide"
 multiplier="-2" offset="0.3"/><origin xyz="1 0 0" rpy="3 2 1"/><limit lower="-9" upper="9" effort="1" velocity="1"/></joint>
<joint name="turn of turn" type="continuous"><parent link="e"/><child link="f"/><axis xyz="1 0 0"/><mimic joint="turn"
 multiplier="1" offset="0.4"/><origin xyz="0 1 0" rpy="1 1 1"/></joint></robot>"""


def unit(random):
    way = random.normal(size=3)
    return way / np.linalg.norm(way)


def joints(random):
    """One joint of each type that can be made in Python."""
    composite = pin.JointModelComposite()
    for part in (pin.JointModelRX(), pin.JointModelHelicalUnaligned(unit(random), 0.2), pin.JointModelSpherical()):
        composite.addJoint(part, pin.SE3.Random())
    plain = """RX RY RZ PX PY PZ RUBX RUBY RUBZ FreeFlyer Spherical SphericalZYX Planar Translation""".split()
    return {name: getattr(pin, f"JointModel{name}")() for name in plain} | {
        "HX": pin.JointModelHX(0.1),
        "HY": pin.JointModelHY(-0.2),
        "HZ": pin.JointModelHZ(0.3),
        "RevoluteUnaligned": pin.JointModelRevoluteUnaligned(unit(random)),
        "PrismaticUnaligned": pin.JointModelPrismaticUnaligned(unit(random)),
        "HelicalUnaligned": pin.JointModelHelicalUnaligned(unit(random), 0.4),
        "Universal": pin.JointModelUniversal(np.array([0, 0.6, 0.8]), np.array([1.0, 0, 0])),
        "Composite": composite,
    }


def hull():
    return coal.Convex.convexHull(points([[0, 0, 0], [0.4, 0, 0], [0, 0.3, 0], [0, 0, 0.5], [0.3, 0.3, 0.3]]), True, "Qt")


def points(rows):
    result = coal.StdVec_Vec3s()
    for row in rows:
        result.append(np.array(row, float))
    return result


def mesh():
    """A tetrahedron of triangles."""
    model = coal.BVHModelOBBRSS()
    model.beginModel(4, 4)
    corners = np.array([[0, 0, 0], [0.5, 0, 0], [0, 0.4, 0], [0, 0, 0.3]])
    triangles = coal.StdVec_Triangle()
    for ids in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)):
        triangles.append(coal.Triangle(*ids))
    model.addSubModel(points(corners), triangles)
    model.endModel()
    return model


def swept(shape, radius):
    shape.setSweptSphereRadius(radius)
    return shape


def shapes():
    return {
        "sphere": coal.Sphere(0.2),
        "capsule": coal.Capsule(0.1, 0.5),
        "box": coal.Box(0.2, 0.3, 0.5),
        "cylinder": coal.Cylinder(0.15, 0.4),
        "cone": coal.Cone(0.2, 0.4),
        "ellipsoid": coal.Ellipsoid(0.1, 0.2, 0.3),
        "hull": hull(),
        "mesh": mesh(),
        "round box": swept(coal.Box(0.2, 0.3, 0.1), 0.05),
        "round sphere": swept(coal.Sphere(0.1), 0.05),
    }


def model_of(random, kinds, depth):
    """A tree of these joints, each with one geometry, on a half-space; all pairs but those of a joint and its parent."""
    pin.seed(int(random.integers(1 << 30)))
    model, geometry, ids = pin.Model(), pin.GeometryModel(), [0]
    geometry.addGeometryObject(pin.GeometryObject("ground", 0, pin.SE3.Identity(), coal.Halfspace(np.array([0, 0, 1.0]), -1.5)))
    without = "mesh" if random.random() < 0.5 else "round"  # coal has no collision of both
    parts = [(part, shape) for part, shape in shapes().items() if without not in part]
    parts = [parts[k] for k in random.permutation(len(parts))]
    for number, (name, joint) in enumerate(kinds):
        parent = int(random.choice(ids[-depth:]))
        place = pin.SE3(pin.SE3.Random().rotation, random.uniform(-0.8, 0.8, 3))
        ids.append(model.addJoint(parent, joint, place, name))
        part, shape = parts[number % len(parts)]
        place = pin.SE3(pin.SE3.Random().rotation, random.uniform(-0.2, 0.2, 3))
        geometry.addGeometryObject(pin.GeometryObject(f"{part} of {name}", ids[-1], place, shape))
    for a, one in enumerate(geometry.geometryObjects):
        for b, other in list(enumerate(geometry.geometryObjects))[a + 1 :]:
            if one.parentJoint != model.parents[other.parentJoint] or one.parentJoint == 0:
                geometry.addCollisionPair(pin.CollisionPair(a, b))
    return model, geometry


def random_state(random, model):
    return pin.randomConfiguration(model, np.full(model.nq, -2.0), np.full(model.nq, 2.0))


def check_poses(model, geometry, count, seed):
    robot, random = chasles.pinocchio.robot(model, geometry), np.random.default_rng(seed)
    pin.seed(seed)
    states, data, places = [random_state(random, model) for _ in range(count)], model.createData(), geometry.createData()
    for state, values in zip(states, chasles.pinocchio.configurations(model, np.array(states)), strict=True):
        pin.updateGeometryPlacements(model, data, geometry, places, state)
        links = robot.link_poses(values)
        theirs = dict(zip(model.names, data.oMi, strict=True))
        theirs |= {item.name: place for item, place in zip(geometry.geometryObjects, places.oMg, strict=True)}
        for name, place in theirs.items():
            place = place.homogeneous
            assert np.abs(links[name] - place).max() <= 1e-12 * max(1.0, np.abs(place).max()), name
    return robot


def test_all_joints_stand_where_pinocchio_says():
    random = np.random.default_rng(1)
    model, geometry = model_of(random, joints(random).items(), 3)
    robot = check_poses(model, geometry, 1000, 2)
    assert len(robot.tested_pairs()) == len(geometry.collisionPairs)
    continuous = [name for name, turns in zip(robot.variables, robot.continuous) if turns]
    assert continuous == ["RUBX", "RUBY", "RUBZ", "Planar/theta"]
    assert "Composite/2/turn" in robot.variables and "HX" in robot.variables


def test_mimic_joints_and_limits():
    model, geometry = pin.buildModelFromXML(MIMICS, mimic=True), pin.GeometryModel()
    for joint in range(1, model.njoints):
        geometry.addGeometryObject(pin.GeometryObject(f"g{joint}", joint, pin.SE3.Random(), coal.Box(0.1, 0.2, 0.3)))
    geometry.addAllCollisionPairs()
    robot = check_poses(model, geometry, 300, 3)
    assert robot.variables == ["turn", "slide"]
    np.testing.assert_array_equal(robot.limits, [[-np.inf, np.inf], [-1, 1.5]])


#: Between two configurations these move in Pinocchio as in Chasles; free flyers and planar joints do not.
EVEN = [name for name in joints(np.random.default_rng(0)) if name not in ("FreeFlyer", "Planar")]


def test_straight_edges_are_those_of_pinocchio():
    random = np.random.default_rng(4)
    kinds = joints(random)
    model, geometry = model_of(random, [(name, kinds[name]) for name in EVEN], 3)
    robot, data, seen = chasles.pinocchio.robot(model, geometry), model.createData(), 0
    for _ in range(40):
        start, goal = random_state(random, model), random_state(random, model)
        path = chasles.JointPath.straight(robot, chasles.pinocchio.configurations(model, [start, goal]))
        for time in np.linspace(0, 1, 26):
            links = robot.link_poses(path.at(time))
            pin.forwardKinematics(model, data, pin.interpolate(model, start, goal, time))
            for name, place in zip(model.names, data.oMi, strict=True):
                assert np.abs(links[name] - place.homogeneous).max() < 1e-10, name
            seen += 1
    assert seen == 1040


def test_coal_contradicts_nothing():
    """Its collision at dense samples of a motion finds nothing that Chasles lacks, and nothing before the bracket."""
    random, seen, met, clear = np.random.default_rng(5), 0, 0, 0
    for _ in range(60 if os.environ.get("CHASLES_LONG") else 12):
        kinds = joints(random)
        chosen = list(random.choice(EVEN, 6, replace=False))
        model, geometry = model_of(random, [(name, kinds[name]) for name in chosen], 2)
        checker = chasles.RobotChecker(chasles.pinocchio.robot(model, geometry, deviation=0.001))
        data, places = model.createData(), geometry.createData()
        for _ in range(8):
            start, goal = random_state(random, model), random_state(random, model)
            goal = pin.interpolate(model, start, goal, 0.3)
            found = checker.first_contact(*chasles.pinocchio.configurations(model, [start, goal]))
            first = 1.0 if found.verdict == "clear" else found.time
            met, clear = met + (found.verdict == "contact"), clear + (found.verdict == "clear")
            for time in np.linspace(0, 1, 51):
                pin.updateGeometryPlacements(model, data, geometry, places, pin.interpolate(model, start, goal, time))
                if time < first - 1e-9 or found.verdict == "clear":
                    assert not pin.computeCollisions(geometry, places, True), (time, found)
                    seen += 1
            if found.verdict == "contact":
                pin.updateGeometryPlacements(model, data, geometry, places, pin.interpolate(model, start, goal, found.time))
                a, b = (geometry.getGeometryId(name) for name in found.pair)
                near = pin.computeDistance(geometry, places, geometry.findCollisionPair(pin.CollisionPair(min(a, b), max(a, b))))
                assert near.min_distance < 2 * 0.001 * 0.3 + 1e-6, found
    assert seen > 1000 and met > 10 and clear > 10, (seen, met, clear)


def test_polyhedra_of_curved_shapes_enclose_them():
    random = np.random.default_rng(6)
    for name in ("cylinder", "cone", "ellipsoid"):
        shape = shapes()[name]
        for deviation in (0.02, 0.004):
            body, off = chasles.pinocchio._body_of(shape, deviation, 1.0)
            vertices = np.array(body.vertices)
            for _ in range(200):  # how far both reach in a direction
                way = unit(random)
                if name == "ellipsoid":
                    theirs = np.linalg.norm(np.asarray(shape.radii) * way)
                else:
                    ring = shape.radius * np.hypot(*way[:2])
                    ends = (shape.halfLength * way[2], -shape.halfLength * way[2] + ring)
                    theirs = max(ends) if name == "cone" else ring + shape.halfLength * abs(way[2])
                assert theirs <= (vertices @ way).max() + 1e-15 and (vertices @ way).max() <= theirs + off * (1 + 1e-9), (
                    name,
                    way,
                )


def two(shape=None, joint=None, pairs=True):
    model, geometry = pin.Model(), pin.GeometryModel()
    number = model.addJoint(0, joint or pin.JointModelPX(), pin.SE3.Identity(), "slide")
    geometry.addGeometryObject(pin.GeometryObject("wall", 0, pin.SE3(np.eye(3), np.array([2.0, 0, 0])), coal.Box(1, 1, 1)))
    geometry.addGeometryObject(pin.GeometryObject("part", number, pin.SE3.Identity(), shape or coal.Box(1, 1, 1)))
    if pairs:
        geometry.addAllCollisionPairs()
    return model, geometry


REFUSED = [
    (lambda: two(pairs=False), {}, "geometry_model: has no collision pairs"),
    (
        lambda: two(coal.Plane(np.array([0, 0, 1.0]), 0)),
        {},
        "geometry 'part': a Plane has no polyhedron; leave_out leaves it out",
    ),
    (lambda: two(joint=pin.JointModelEllipsoid()), {}, "joint 'slide': a joint of the type Ellipsoid has no counterpart"),
    (lambda: (pin.Model(), two()[1]), {}, "geometry 'part': joint 1 is not in the model, which has 1"),
    (two, {"deviation": 0}, "deviation: must be in"),
    (two, {"plane_size": 0}, "plane_size: must be above 0"),
    (two, {"leave_out": "wall"}, "leave_out: 'wall' is one text"),
    (two, {"leave_out": ["wal"]}, "leave_out: 'wal': there is no such geometry object"),
]


@pytest.mark.parametrize("models, options, why", REFUSED, ids=[why for *_, why in REFUSED])
def test_what_is_refused(models, options, why):
    with pytest.raises(chasles.InvalidInput) as error:
        chasles.pinocchio.robot(*models(), **options)
    assert str(error.value).startswith(why) and "\n" not in str(error.value)


def test_what_is_no_angle_and_no_turn():
    """Cosine and sine of any length are an angle, but not without a length, as with quaternions."""
    model = pin.Model()
    for name, joint in (("turn", pin.JointModelRUBZ()), ("plane", pin.JointModelPlanar()), ("ball", pin.JointModelSpherical())):
        model.addJoint(0, joint, pin.SE3.Identity(), name)
    good, infinite = pin.neutral(model), float("inf")
    for place, values, why in (
        (0, [0, 0], "turn: the cosine and the sine are both 0, which is no angle"),
        (0, [infinite, 0], "turn: the cosine or the sine is not finite"),
        (0, [1, -infinite], "turn: the cosine or the sine is not finite"),
        (4, [0, 0], "plane/theta: the cosine and the sine are both 0, which is no angle"),
        (6, [0, 0, 0, 0], "ball/rot_x: the quaternion is zero"),
    ):
        bad = good.copy()
        bad[place : place + len(values)] = values
        for q, number in ((bad, ""), ([good, bad], "configuration 1: ")):
            with pytest.raises(chasles.InvalidInput) as error:
                chasles.pinocchio.configurations(model, q)
            assert str(error.value) == f"q: {number}{why}"
    lost = np.full(model.nq, np.nan)
    assert np.isnan(chasles.pinocchio.configurations(model, lost)).sum() == 4 + 4  # all but the place of the ball
    np.testing.assert_allclose(chasles.pinocchio.configurations(model, 1e-200 * good + 1e200 * good)[:1], 0)


def test_wrong_types_and_shapes():
    model, geometry = two()
    with pytest.raises(TypeError, match="^model: a str is not a pinocchio.Model$"):
        chasles.pinocchio.robot("robot.urdf", geometry)
    with pytest.raises(TypeError, match="^geometry_model: a Model is not a pinocchio.GeometryModel$"):
        chasles.pinocchio.robot(model, model)
    with pytest.raises(chasles.InvalidInput, match=r"^q: the shape is \(2,\); \(1,\) or \(n, 1\) is needed$"):
        chasles.pinocchio.configurations(model, [0, 0])


def test_a_half_space_in_a_closed_form():
    """A ball that falls on a slope, from 1 to -1."""
    model, geometry = pin.Model(), pin.GeometryModel()
    fall = model.addJoint(0, pin.JointModelPZ(), pin.SE3.Identity(), "fall")
    slope = coal.Halfspace(np.array([0, np.sin(0.3), np.cos(0.3)]), 0.2)
    for name, joint, shape in (("slope", 0, slope), ("ball", fall, coal.Sphere(0.1))):
        geometry.addGeometryObject(pin.GeometryObject(name, joint, pin.SE3.Identity(), shape))
    geometry.addAllCollisionPairs()
    found = chasles.pinocchio.robot(model, geometry, plane_size=5).first_contact([1], [-1])
    assert set(found.pair) == {"ball", "slope"} and abs(found.time - (1 - 0.3 / np.cos(0.3)) / 2) < 1e-9


def test_pairs_that_are_left_out():
    model, geometry = two()
    robot = chasles.pinocchio.robot(model, geometry)
    assert robot.tested_pairs() == [("wall", "part")]
    assert abs(robot.first_contact([0], [2]).time - 0.5) < 1e-9
    geometry.geometryObjects[0].disableCollision = True
    assert chasles.pinocchio.robot(model, geometry).tested_pairs() == []
    model, geometry = two(coal.Plane(np.array([0, 0, 1.0]), 0))
    assert chasles.pinocchio.robot(model, geometry, leave_out=["part"]).tested_pairs() == []
    random = np.random.default_rng(7)
    model, geometry = model_of(random, joints(random).items(), 3)
    robot, count = chasles.pinocchio.robot(model, geometry), geometry.ngeoms
    untested = robot.first_contact(robot.neutral(), robot.neutral()).untested
    assert untested.tested == len(geometry.collisionPairs)
    assert untested.reasons["disabled"] == count * (count - 1) // 2 - untested.tested  # the others have no shapes


def test_meshes_of_urdf_files_have_their_scale(tmp_path):
    (tmp_path / "tooth.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    mesh = '<collision><geometry><mesh filename="tooth.obj" scale="2 3 0.5"/></geometry></collision>'
    joint = '<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/></joint>'
    (tmp_path / "robot.urdf").write_text(
        f'<robot name="r"><link name="a">{mesh}</link><link name="b">{mesh}</link>{joint}</robot>'
    )
    model = pin.buildModelFromUrdf(str(tmp_path / "robot.urdf"))
    geometry = pin.buildGeomFromUrdf(model, str(tmp_path / "robot.urdf"), pin.COLLISION, package_dirs=str(tmp_path))
    geometry.addAllCollisionPairs()
    ((body, _, _),) = chasles.pinocchio.robot(model, geometry).collisions("b_0")
    assert body.vertices.max(axis=0).tolist() == [2, 3, 0.5] and body.report.solid_parts == 1


def test_chasles_alone_does_not_import_pinocchio():
    code = "import sys, chasles; assert not {'pinocchio', 'coal'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_page_of_the_guide_tells_the_truth():
    example = doctest.DocTestParser().get_doctest(code_of(ROOT / "docs/pinocchio.md"), {}, "pinocchio.md", "pinocchio.md", 0)
    assert len(example.examples) > 8
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures, "".join(failures)
