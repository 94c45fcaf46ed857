"""Plants of Drake as robots: its own kinematics, distances and trajectories at many poses, and what is refused."""

import doctest
import os
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
from conftest import ROOT
from test_docs import code_of

import chasles

pytest.importorskip("pydrake")
import chasles.drake  # noqa: E402
from chasles.drake_joints import name_of_body  # noqa: E402
from drake_plants import KINDS, TOOTH, World, in_memory, random_world, trajectories  # noqa: E402
from pydrake.geometry import (  # noqa: E402
    AddContactMaterial,
    Box,
    CollisionFilterDeclaration,
    GeometryFrame,
    GeometryInstance,
    GeometrySet,
    HalfSpace,
    Mesh,
    ProximityProperties,
    Role,
    Sphere,
)
from pydrake.math import BsplineBasis, KnotVectorType, RigidTransform, RollPitchYaw  # noqa: E402
from pydrake.multibody.fem import DeformableBodyConfig  # noqa: E402
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction  # noqa: E402
from pydrake.multibody.tree import PrismaticJoint, RevoluteJoint  # noqa: E402
from pydrake.systems.framework import DiagramBuilder  # noqa: E402
from pydrake.trajectories import (  # noqa: E402
    BezierCurve,
    BsplineTrajectory,
    CompositeTrajectory,
    PathParameterizedTrajectory,
    PiecewisePolynomial,
)


def names_of(world):
    inspector = world.scene_graph.model_inspector()
    result = {}
    for geometry in inspector.GetAllGeometryIds(Role.kProximity):
        body = world.plant.GetBodyFromFrameId(inspector.GetFrameId(geometry))
        result[geometry] = f"{name_of_body(world.plant, body)}/{inspector.GetName(geometry).rpartition('::')[2]}"
    return result


def random_positions(random, world, count):
    return random.uniform(-2, 2, (count, world.plant.num_positions()))


def check_poses(world, random, count):
    robot, inspector = chasles.drake.robot(world.plant, world.scene_graph), world.scene_graph.model_inspector()
    names, states = names_of(world), random_positions(random, world, count)
    for number, (state, values) in enumerate(zip(states, chasles.drake.configurations(robot, world.plant, states), strict=True)):
        world.at(state)
        links = robot.link_poses(values)
        for body in world.bodies:
            place = world.plant.EvalBodyPoseInWorld(world.plant_context, body)
            near(links[name_of_body(world.plant, body)], place.GetAsMatrix4(), body.name())
            ids = inspector.GetGeometries(world.plant.GetBodyFrameIdOrThrow(body.index()), Role.kProximity)
            for geometry in ids if number % 10 == 0 else ():
                near(links[names[geometry]], (place @ inspector.GetPoseInFrame(geometry)).GetAsMatrix4(), names[geometry])
    return robot


def near(ours, theirs, name):
    assert np.abs(ours - theirs).max() <= 1e-12 * max(1.0, np.abs(theirs).max()), name


def test_all_joints_stand_where_drake_says():
    random = np.random.default_rng(1)
    world = random_world(random, [*KINDS, *KINDS])
    robot = check_poses(world, random, 1000)
    candidates, names = world.scene_graph.model_inspector().GetCollisionCandidates(), names_of(world)
    assert {frozenset(pair) for pair in robot.tested_pairs()} == {frozenset((names[a], names[b])) for a, b in candidates}
    assert robot.variables[:5] == [
        "model::revolute 0",
        "model::prismatic 1",
        "model::screw 2",
        "model::universal 3/qx",
        "model::universal 3/qy",
    ]
    np.testing.assert_array_equal(robot.limits[:2], [[-1, 2], [-np.inf, np.inf]])


def test_free_bodies_may_stand_still():
    random = np.random.default_rng(2)
    world = random_world(random, ["revolute", "quaternion", "planar", "quaternion"])
    q = random_positions(random, world, 1)[0]
    moving = chasles.drake.robot(world.plant, world.scene_graph)
    resting = chasles.drake.robot(world.plant, world.scene_graph, rest=q)
    assert len(moving.variables) == 18 and len(resting.variables) == 4
    one, other = (robot.link_poses(chasles.drake.configurations(robot, world.plant, q)) for robot in (moving, resting))
    assert max(np.abs(one[name] - other[name]).max() for name in resting.links if name in one) < 1e-14


def test_a_trajectory_moves_no_body_that_rests():
    random = np.random.default_rng(8)
    world = random_world(random, ["revolute", "quaternion"])
    start = random_positions(random, world, 1)[0]
    goal = start.copy()
    robot, joint = robot_of(world, rest=start), world.plant.GetJointByName("revolute 0").position_start()
    goal[joint] += 1
    line = PiecewisePolynomial.FirstOrderHold([0, 1], np.array([start, goal]).T)
    np.testing.assert_allclose(chasles.drake.joint_path(line, robot, world.plant).at(0.5), (start + goal)[joint] / 2)
    for change in (0.1, np.nan):
        goal[joint - 1] += change
        with pytest.raises(chasles.InvalidInput, match="^trajectory: moves a free body that rests in the robot"):
            chasles.drake.joint_path(PiecewisePolynomial.FirstOrderHold([0, 1], np.array([start, goal]).T), robot, world.plant)


def test_trajectories_are_the_polynomials_that_they_are():
    """At 1,000 times each: Drake's own values, to rounding."""
    random = np.random.default_rng(3)
    world = random_world(random, ["revolute", "universal", "prismatic", "planar", "ball", "screw", "rpy"])
    robot, kinds = chasles.drake.robot(world.plant, world.scene_graph), 0
    for trajectory in trajectories(random, world.plant.num_positions()):
        path = chasles.drake.joint_path(trajectory, robot, world.plant)
        assert (path.times[0], path.times[-1]) == (trajectory.start_time(), trajectory.end_time())
        times = np.linspace(path.times[0], path.times[-1], 1000)
        theirs = chasles.drake.configurations(robot, world.plant, [trajectory.value(time).ravel() for time in times])
        assert np.abs([path.at(time) for time in times] - theirs).max() < 1e-14, type(trajectory)
        kinds += 1
    assert kinds == 8


def test_ways_through_zero():
    """Roundings beside 0 are no jumps, and jumps are."""
    random = np.random.default_rng(9)
    world = random_world(random, ["revolute", "revolute", "prismatic"])
    robot = robot_of(world)
    for _ in range(50):
        times, values = np.cumsum(random.uniform(0.1, 1, 5)), random.uniform(-1, 1, (3, 5))
        values[:, 2] = 0
        for kind in (PiecewisePolynomial.CubicShapePreserving, PiecewisePolynomial.FirstOrderHold):
            path = chasles.drake.joint_path(kind(times, values), robot, world.plant)
            assert np.abs(path.at(times[2])).max() < 1e-15
    for jump in (1e-12, 1e-3):
        pieces = [BezierCurve(0, 1, np.array([[1, 0.0]] * 3)), BezierCurve(1, 2, np.array([[jump, 1.0]] * 3))]
        with pytest.raises(chasles.InvalidInput, match="^path: segment 1: does not begin where the one before ends$"):
            chasles.drake.joint_path(CompositeTrajectory(pieces), robot, world.plant)


def test_coefficients_of_splines_are_rounded_once():
    """Each one is that of the polynomial through values by de Boor's algorithm in rational numbers, rounded."""
    from chasles.drake_polynomials import polynomials_of

    random, seen = np.random.default_rng(4), 0
    for trajectory in trajectories(random, 2):
        if not hasattr(trajectory, "basis"):
            continue
        breaks, coefficients = polynomials_of(trajectory)
        knots, points = trajectory.basis().knots(), [np.ravel(point).tolist() for point in trajectory.control_points()]
        for s, begin in enumerate(breaks[:-1].tolist()):
            duration = Fraction(breaks[s + 1]) - Fraction(begin)
            times = [duration * k / len(coefficients) for k in range(len(coefficients))]
            for column in range(2):
                values = [de_boor(knots, [point[column] for point in points], Fraction(begin) + time) for time in times]
                exact = [float(number) for number in interpolation(times, values)]
                assert exact[::-1] == coefficients[:, s, column].tolist()
                seen += len(exact)
    assert seen > 100


def interpolation(times, values):
    """The coefficients of the polynomial with these values, the constant first: by Newton's divided differences."""
    differences = list(values)
    for order in range(1, len(times)):
        for i in range(len(times) - 1, order - 1, -1):
            differences[i] = (differences[i] - differences[i - 1]) / (times[i] - times[i - order])
    result = [Fraction(0)] * len(times)
    for time, difference in zip(times[::-1], differences[::-1], strict=True):
        result = [a - time * b for a, b in zip([Fraction(0), *result[:-1]], result, strict=True)]
        result[0] += difference
    return result


def de_boor(knots, points, time):
    degree, t = len(knots) - len(points) - 1, Fraction(time)
    k = max(i for i in range(degree, len(points)) if knots[i] <= time)
    d = [Fraction(points[i]) for i in range(k - degree, k + 1)]
    for r in range(1, degree + 1):
        for j in range(degree, r - 1, -1):
            left, right = Fraction(knots[j + k - degree]), Fraction(knots[j + 1 + k - r])
            share = (t - left) / (right - left)
            d[j] = (1 - share) * d[j - 1] + share * d[j]
    return d[degree]


def test_drake_contradicts_nothing():
    """Its signed distances at dense samples of a trajectory are above 0 where Chasles says clear, and 0 where it says contact."""
    random, seen, met, clear = np.random.default_rng(5), 0, 0, 0
    for number in range(60 if os.environ.get("CHASLES_LONG") else 8):
        kinds = random.choice([kind for kind in KINDS if kind not in ("quaternion", "weld")], 3, replace=False)
        world = random_world(random, ["weld", *kinds], with_ground=number % 3 == 0)
        robot = chasles.drake.robot(world.plant, world.scene_graph, deviation=0.001)
        names = names_of(world)
        checker = chasles.RobotChecker(robot)
        for trajectory in trajectories(random, world.plant.num_positions()):
            path = chasles.drake.joint_path(trajectory, robot, world.plant)
            found = checker.first_contact_on_path(path)
            until = path.times[-1] if found.verdict == "clear" else found.time
            met, clear = met + (found.verdict == "contact"), clear + (found.verdict == "clear")
            for time in np.linspace(path.times[0], until - 1e-9, 25):
                world.at(trajectory.value(time).ravel())
                query = world.plant.get_geometry_query_input_port().Eval(world.plant_context)
                if found.verdict != "contact_at_start":
                    deep = [p for p in query.ComputePointPairPenetration() if p.depth > 1e-6]
                    assert not deep, (time, found, [(names[p.id_A], names[p.id_B], p.depth) for p in deep])
                    seen += 1
            if found.verdict == "contact":
                world.at(trajectory.value(found.time).ravel())
                query = world.plant.get_geometry_query_input_port().Eval(world.plant_context)
                ids = [next(g for g, name in names.items() if name == link) for link in found.pair]
                try:
                    distance = query.ComputeSignedDistancePairClosestPoints(*ids).distance
                except RuntimeError:  # Drake has none for some half-spaces
                    continue
                assert abs(distance) < 2 * 0.001 * 0.3 + 1e-5, (found, distance)
    assert seen > 1000 and met > 20 and clear > 5, (seen, met, clear)


def slider(shape=None):
    """A box that slides along x to another one."""
    world = World()
    body = world.body("part", shape or Box(1, 1, 1))
    wall = world.body("wall", Box(1, 1, 1))
    world.plant.AddJoint(PrismaticJoint("slide", world.plant.world_frame(), body.body_frame(), [1, 0, 0]))
    world.plant.WeldFrames(world.plant.world_frame(), wall.body_frame(), RigidTransform([2.0, 0, 0]))
    return world


def robot_of(world, **options):
    return chasles.drake.robot(world.plant, world.scene_graph, **options)


def test_a_half_space_in_a_closed_form():
    """A ball that falls on a slope, from 1 to -1."""
    world = World()
    ball = world.body("ball", Sphere(0.1))
    world.shape(world.plant.world_body(), HalfSpace(), "slope", RigidTransform(RollPitchYaw(0.3, 0, 1), [0, 0, 0]))
    world.plant.AddJoint(PrismaticJoint("fall", world.plant.world_frame(), ball.body_frame(), [0, 0, 1]))
    found = robot_of(world.finish(), plane_size=5).first_contact([1], [-1])
    assert found.pair == ("model::ball/shape", "world/slope") and abs(found.time - (1 - 0.1 / np.cos(0.3)) / 2) < 1e-9


def test_filters_of_a_context():
    world = slider().finish()
    robot = robot_of(world)
    assert robot.tested_pairs() == [("model::part/shape", "model::wall/shape")]
    assert abs(robot.first_contact([0], [2]).time - 0.5) < 1e-9
    context = world.scene_graph.GetMyMutableContextFromRoot(world.context)
    ids = GeometrySet(list(names_of(world)))
    world.scene_graph.collision_filter_manager(context).Apply(CollisionFilterDeclaration().ExcludeWithin(ids))
    inspector = world.plant.get_geometry_query_input_port().Eval(world.plant_context).inspector()
    assert chasles.drake.robot(world.plant, inspector).tested_pairs() == []
    assert robot_of(world, leave_out=["model::wall/shape"]).tested_pairs() == []


def test_meshes_are_hulls_or_faces(tmp_path):
    (tmp_path / "tooth.obj").write_text(TOOTH)
    shape = Mesh(str(tmp_path / "tooth.obj"), np.array([2.0, 1.0, 1.0]))
    world = slider(shape).finish()
    hull, mesh = (robot_of(world, meshes=kind).collisions("model::part/shape")[0][0] for kind in ("hull", "mesh"))
    assert len(hull.vertices) == 4 and len(mesh.vertices) == 5 and mesh.vertices.max(axis=0).tolist() == [0.8, 0.3, 0.5]
    assert abs(hull.report.volume - 0.8 * 0.3 * 0.5 / 6) < 1e-12
    with pytest.raises(chasles.InvalidInput, match="^geometry 'model::part/shape': only meshes of OBJ files can be read"):
        robot_of(slider(Mesh(in_memory(), 1.0)).finish(), meshes="mesh")


def test_a_trajectory_of_one_instance():
    world = slider()
    other = world.plant.AddModelInstance("other")
    ball = world.plant.AddRigidBody("ball", other)
    world.shape(ball, Sphere(0.1), "ball")
    world.plant.AddJoint(RevoluteJoint("turn", world.plant.world_frame(), ball.body_frame(), [0, 0, 1]))
    world.finish()
    robot, line = robot_of(world), PiecewisePolynomial.FirstOrderHold([0, 1], [[0, 2]])
    path = chasles.drake.joint_path(line, robot, world.plant, model_instance=world.instance, rest=[7, 0.25])
    order = [robot.variables.index(name) for name in ("model::slide", "other::turn")]
    np.testing.assert_array_equal(path.at(0.5)[order], [1, 0.25])
    default = chasles.drake.joint_path(line, robot, world.plant, model_instance=world.instance)
    np.testing.assert_array_equal(default.at(0.5)[order], [1, 0])


REFUSED = [
    ({"meshes": "convex"}, "meshes: must be 'hull' or 'mesh', not 'convex'"),
    ({"deviation": 0}, "deviation: must be in"),
    ({"plane_size": 0}, "plane_size: must be above 0"),
    ({"rest": [1, 2]}, "rest: 1 finite positions are needed, and the shape is (2,)"),
    ({"leave_out": "model::wall/shape"}, "leave_out: 'model::wall/shape' is one text"),
    ({"leave_out": ["wall"]}, "leave_out: 'wall': there is no such geometry"),
]


@pytest.mark.parametrize("options, why", REFUSED, ids=[why for _, why in REFUSED])
def test_what_is_refused(options, why):
    with pytest.raises(chasles.InvalidInput) as error:
        robot_of(slider().finish(), **options)
    assert str(error.value).startswith(why) and "\n" not in str(error.value)


def test_trajectories_that_are_refused():
    world, other = slider().finish(), random_world(np.random.default_rng(6), ["revolute", "planar"])
    robot, plant = robot_of(world), world.plant
    line = PiecewisePolynomial.FirstOrderHold([0, 1], [[0, 2]])
    cases = [
        (PathParameterizedTrajectory(line, line), "trajectory: a PathParameterizedTrajectory is no .*give its path\\(\\)$"),
        (PiecewisePolynomial.FirstOrderHold([0, 1], [[0, 2], [0, 1]]), "trajectory: has 2 rows, and 1 positions are needed$"),
        (PiecewisePolynomial.ZeroOrderHold([0, 1, 2], [[0, 2, 2]]), "path: segment 1: does not begin where the one before ends$"),
        (PiecewisePolynomial(), "trajectory: is empty$"),
        ("line", "trajectory: a str is no piecewise polynomial"),
    ]
    for bad in (np.nan, np.inf, -np.inf):
        what = f"trajectory: control points: the entry \\[.*\\] is {bad}; finite numbers are needed$"
        cases += [
            (BezierCurve(0, 1, np.array([[0, bad, 1]])), what),
            (BsplineTrajectory(BsplineBasis(1, 2, KnotVectorType.kUniform, 0.0, 1.0), [[[0]], [[bad]]]), what),
            (CompositeTrajectory([BezierCurve(0, 1, np.array([[0, bad]]))]), what),
            (PiecewisePolynomial.FirstOrderHold([0, 1], [[0, bad]]), "path: segment 0: a coefficient is not a finite number$"),
        ]
    cases.append((BezierCurve(0, 1e-300, np.array([[0, 1e300]])), "trajectory: from 0.0 to 1e-300 s: is too large or too fast"))
    for trajectory, why in cases:
        with pytest.raises(chasles.InvalidInput, match=f"^{why}"):
            chasles.drake.joint_path(trajectory, robot, plant)
    with pytest.raises(chasles.InvalidInput, match="^robot: was not made of this plant"):
        chasles.drake.joint_path(line, robot, other.plant)
    free = random_world(np.random.default_rng(7), ["quaternion"])
    with pytest.raises(chasles.InvalidInput, match="^robot: 'model::quaternion 0' is free and has a quaternion.*`rest`"):
        chasles.drake.joint_path(line, robot_of(free), free.plant)


def test_plants_that_are_refused():
    unfinished = World()
    with pytest.raises(chasles.InvalidInput, match="^plant: is not finalized"):
        robot_of(unfinished)
    with pytest.raises(TypeError, match="^plant: a str is not a pydrake.multibody.plant.MultibodyPlant$"):
        chasles.drake.robot("plant", slider().finish().scene_graph)
    with pytest.raises(TypeError, match="^scene_graph: a MultibodyPlant is no SceneGraph"):
        chasles.drake.robot(slider().finish().plant, slider().finish().plant)
    upside_down = World()
    body = upside_down.body("part", Box(1, 1, 1))
    upside_down.plant.AddJoint(RevoluteJoint("turn", body.body_frame(), upside_down.plant.world_frame(), [0, 0, 1]))
    with pytest.raises(chasles.InvalidInput, match="^joint 'turn': 'world' is the world or .*: swap its parent and its child$"):
        robot_of(upside_down.finish())


def test_geometries_that_are_refused_by_name():
    """What deforms, and what is on a frame of another source. Other geometries of the world are taken."""
    world = World()
    world.body("part", Box(1, 1, 1))
    source = world.scene_graph.RegisterSource("other")
    loose = world.scene_graph.RegisterFrame(source, GeometryFrame("loose"))
    for frame, name in ((loose, "ball"), (None, "stone")):
        instance = GeometryInstance(RigidTransform([0, 0, 5.0]), Sphere(0.2), name)
        instance.set_proximity_properties(ProximityProperties())
        if frame is None:
            world.scene_graph.RegisterAnchoredGeometry(source, instance)
        else:
            world.scene_graph.RegisterGeometry(source, frame, instance)
    world.finish()
    with pytest.raises(
        chasles.InvalidInput, match="^geometry 'ball': is on a frame that is none of the plant; name it in leave_out$"
    ):
        robot_of(world)
    assert robot_of(world, leave_out=["ball"]).tested_pairs() == [("model::part/shape", "world/stone")]


def test_what_deforms_is_refused_by_name():
    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlantSceneGraph(builder, 0.01)
    instance, properties = GeometryInstance(RigidTransform(), Sphere(0.1), "jelly"), ProximityProperties()
    AddContactMaterial(dissipation=None, point_stiffness=None, friction=CoulombFriction(1, 1), properties=properties)
    instance.set_proximity_properties(properties)
    plant.mutable_deformable_model().RegisterDeformableBody(instance, DeformableBodyConfig(), 0.1)
    plant.Finalize()
    with pytest.raises(chasles.InvalidInput, match="^geometry 'jelly': deforms; name it in leave_out$"):
        chasles.drake.robot(plant, scene_graph)
    assert chasles.drake.robot(plant, scene_graph, leave_out=["jelly"]).tested_pairs() == []


def test_chasles_alone_does_not_import_drake():
    subprocess.run([sys.executable, "-c", "import sys, chasles; assert 'pydrake' not in sys.modules"], check=True)


def test_the_page_of_the_guide_tells_the_truth():
    example = doctest.DocTestParser().get_doctest(code_of(ROOT / "docs/drake.md"), {}, "drake.md", "drake.md", 0)
    assert len(example.examples) > 8
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures, "".join(failures)
