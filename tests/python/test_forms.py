"""Messages about arguments of a wrong form name the argument, what was found, and the right form."""

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES
from motion_kinds import KINDS

import chasles


class Vector:
    """A point as of a CAD kernel: three members, no sequence."""

    def __init__(self, x, y, z):
        self.x, self.y, self.z = x, y, z


class CapitalVector:
    def __init__(self, x, y, z):
        self.X, self.Y, self.Z = x, y, z


POINTS = [Vector(*point) for point in CUBE_VERTICES]
REST = [0, 0, 0, 1, 0, 0, 0]


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: chasles.Polyhedron(POINTS, CUBE_FACES), r"vertices: .*\(of Vector\).*\[\[p\.x, p\.y, p\.z\] for p in points\]"),
        (lambda: chasles.Polyhedron([CapitalVector(0, 0, 0)] * 3, [[0, 1, 2]]), r"vertices: .*\[\[p\.X, p\.Y, p\.Z\] for p in"),
        (lambda: chasles.Polyhedron(CUBE_VERTICES[:, :2], CUBE_FACES), r"vertices: the shape is \(8, 2\); .*\[\[0, 0, 0\]"),
        (lambda: chasles.Polyhedron([[0, 0, 0], [1, 0]], [[0, 1, 2]]), r"vertices: .*(rows of one length|list)"),
        (lambda: chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES[0]), r"faces: the shape is \(4,\); .*\[\[0, 1, 2\]"),
        (lambda: chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES * 0.5), r"faces: an array of float64 is not an array of whole"),
        (lambda: chasles.Motion.hinge([0, 0, 0], [0, 0, 1], 0.5), r"angle: 0\.5 is no sequence of numbers; .*\[0, 0\.5\]"),
        (lambda: chasles.Motion.slider([0, 0, 1], 0.5), r"way: 0\.5 is no sequence of numbers; .*\[0, 0\.5\]"),
        (lambda: chasles.Motion.hinge(0, [0, 0, 1], [0, 1]), r"point: the shape is \(\); a point has \(3,\), as in"),
        (lambda: chasles.Motion.hinge([0, 0, 0], "z", [0, 1]), r"direction: .*not an array of real numbers"),
        (lambda: chasles.Motion.polynomial(0.5), r"places: 0\.5 is no list of points; .*\[\[0, 0, 0\], \[1, 0, 0\]\]"),
        (lambda: chasles.Motion.polynomial([1, 2]), r"places\[0\]: the shape is \(\); a point has \(3,\)"),
        (lambda: chasles.TimedPoses.through(0.5, [REST]), r"stamps: 0\.5 is no sequence of numbers; .*\[0, 0\.5, 1\]"),
        (lambda: chasles.Trajectory([REST], None), r"trajectory: pose_at: .* is no function; one is needed, as in lambda"),
        (lambda: chasles.Trajectory(lambda time: REST, {}), r"trajectory: bounds: \{\} is no function; one is needed, as in"),
        (lambda: chasles.Motion.at_rest([0, 0, 0]), r"pose: the shape is \(3,\); a pose has \(4, 4\), or \(7,\)"),
    ],
)
def test_a_wrong_form_shows_the_right_one(call, message):
    with pytest.raises(chasles.InvalidInput, match=message):
        call()


class Unspeakable:
    def __repr__(self):
        raise RuntimeError("an object without a text")


NEEDS = {
    "pose_at": lambda none: chasles.Trajectory(none, KINDS),
    "bounds": lambda none: chasles.Trajectory(lambda time: REST, none),
    "inner": lambda none: KINDS["hinge"]() * none,
    "inner of a trajectory": lambda none: KINDS["trajectory"]() * none,
    "moving": lambda none: chasles.relative(none, KINDS["hinge"]()),
    "fixed": lambda none: chasles.relative(KINDS["hinge"](), none),
    "motion": lambda none: chasles.rest_of(none, 0.5),
    "point": lambda none: chasles.Motion.hinge(none, [0, 0, 1], [0, 1]),
    "direction": lambda none: chasles.Motion.slider(none, [0, 1]),
    "way": lambda none: chasles.Motion.slider([0, 0, 1], none),
    "angle": lambda none: chasles.Motion.hinge([0, 0, 0], [0, 0, 1], none),
    "pose": chasles.Motion.at_rest,
    "places": chasles.Motion.polynomial,
    "stamps": lambda none: chasles.TimedPoses.through(none, [REST, REST]),
    "poses": lambda none: chasles.TimedPoses.through([0, 1], none),
    "times": lambda none: chasles.Spline.through(none, [REST, REST]),
    "poses of a spline": chasles.Spline.b_spline,
    "centre": lambda none: KINDS["sweep"]().about(none),
    "moving_start": lambda none: chasles.ScrewMotion.relative(none, REST, REST, REST),
    "fixed_goal": lambda none: chasles.SweepMotion.relative(REST, REST, REST, none),
    "inertia": chasles.MassProperties,
}


@pytest.mark.parametrize("nothing", [None, Unspeakable()], ids=["None", "no text"])
@pytest.mark.parametrize("argument", NEEDS)
def test_what_is_needed_is_named_where_nothing_is_given(argument, nothing):
    named = "motion" if argument.split()[0] in ("inner", "moving", "fixed") else argument.split()[0]
    with pytest.raises(chasles.InvalidInput, match=rf"{named}\b.*: ") as caught:
        NEEDS[argument](nothing)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("motion", ["velocity", 0.5, [REST, REST], None, Unspeakable()])
def test_what_is_no_motion_is_named(motion, cube):
    with pytest.raises(chasles.InvalidInput, match=r"motions\[1\]: motion: .* must be a motion, such as"):
        chasles.first_contact_batch(cube, cube, motions=[KINDS["hinge"](), motion])


@pytest.mark.parametrize("ask", [chasles.first_contact_batch, chasles.least_distance_batch])
def test_batches_take_motions_of_all_kinds(ask, cube):
    motions = [make() for make in KINDS.values()]
    table = ask(cube, cube, motions=motions, threads=2)
    single = chasles.first_contact if ask is chasles.first_contact_batch else chasles.least_distance
    for row, motion, kind in zip(table, motions, KINDS, strict=True):
        found = single(cube, cube, motion=motion)
        has_contact = getattr(found, "verdict", "") != "clear"
        assert not has_contact or row["time"] == found.time, kind
        assert np.isnan(row["tau"]) == (not has_contact or kind.split()[0] not in ("screw", "sweep")), kind


def test_batches_refuse_what_contradicts_motions(cube):
    hinge = KINDS["hinge"]()
    for arguments, message in [
        ({}, "starts, goals: both are needed, or motions="),
        ({"starts": [REST]}, "starts, goals: both are needed"),
        ({"starts": [REST], "goals": [REST], "motions": [hinge]}, "motions: stand instead of starts"),
        ({"motions": [hinge], "motion": "twist"}, "motions: stand instead of starts"),
        ({"motions": hinge}, r"motions: a Motion is no list of motions; \[motion\] is one"),
        ({"motions": [hinge], "find": "every"}, "find: 'every': must be 'first', 'any' or 'first_with_all_contacts'"),
    ]:
        with pytest.raises(chasles.InvalidInput, match=message):
            chasles.first_contact_batch(cube, cube, **arguments)
    marked = chasles.first_contact_batch(cube, cube, motions=[hinge, "here"], errors="mark")
    assert list(marked["verdict"])[1] == "error" and marked["verdict"][0] != "error"
    assert len(chasles.first_contact_batch(cube, cube, motions=[])) == 0
    every = chasles.first_contact_batch(cube, cube, motions=[hinge], find="first_with_all_contacts")
    assert every["verdict"][0] == marked["verdict"][0]


SCALED = np.diag([3.0, 3, 3, 1])
MATRICES = {
    "it scales by 3": SCALED,
    "it scales by 1, 2, 1 along x, y, z": np.diag([1.0, 2, 1, 1]),
    "it mirrors": np.diag([1.0, -1, 1, 1]),
    "it scales by 2, and mirrors": np.diag([-2.0, 2, 2, 1]),
    "it shears": np.array([[1, 0.5, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]]),
    "transpose it": np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [5, 0, 0, 1.0]]),
}


def takers(cube):
    """Everything that takes a matrix."""
    eye = np.eye(4)
    scene = chasles.Scene()
    scene.add("a", cube)
    manager = chasles.CollisionManager()
    manager.add_object("a", cube)
    far = np.eye(4)
    far[0, 3] = 9
    scene.add("b", cube, far)
    hand = chasles.DraggedBody(scene, "b")
    return {
        "first_contact, start": lambda m: chasles.first_contact(cube, cube, m, eye),
        "first_contact, goal": lambda m: chasles.first_contact(cube, cube, eye, m),
        "first_contact, fixed": lambda m: chasles.first_contact(cube, cube, eye, eye, fixed_start=m, fixed_goal=eye),
        "least_distance": lambda m: chasles.least_distance(cube, cube, m, eye),
        "path": lambda m: chasles.first_contact_on_path(cube, cube, [eye, m]),
        "batch": lambda m: chasles.first_contact_batch(cube, cube, [m], [eye]),
        "least batch": lambda m: chasles.least_distance_batch(cube, cube, [eye], [m]),
        "path batch": lambda m: chasles.path_is_clear_batch(cube, cube, [[eye, m]]),
        "at_rest": chasles.Motion.at_rest,
        "screw": lambda m: chasles.ScrewMotion.between(eye, m),
        "sweep": lambda m: chasles.SweepMotion.between(m, eye),
        "velocity": lambda m: chasles.ConstantVelocity.between(m, eye),
        "twist": lambda m: chasles.ConstantTwist.between(m, eye),
        "timed poses": lambda m: chasles.TimedPoses.through([0, 1], [eye, m]),
        "spline": lambda m: chasles.Spline.b_spline([eye, eye, eye, m]),
        "trajectory": lambda m: chasles.Trajectory(
            lambda time: m, lambda start, end: {"turn_rate": 0, "speed": 0}
        ).pose_at(0.5),
        "scene.add": lambda m: chasles.Scene().add("c", cube, m),
        "scene.move": lambda m: scene.move("a", m),
        "scene.move_all": lambda m: scene.move_all([eye, m], [eye, eye]),
        "drag": hand.update,
        "manager.add_object": lambda m: manager.add_object("c", cube, m),
        "manager.set_transform": lambda m: manager.set_transform("a", m),
        "manager.single": lambda m: manager.min_distance_single(cube, m),
        "manager.first_contact": lambda m: manager.first_contact({"a": m}),
    }


@pytest.mark.parametrize("message", MATRICES)
def test_a_matrix_that_does_more_than_a_pose_is_refused_everywhere(message, cube):
    for name, take in takers(cube).items():
        with pytest.raises(chasles.InvalidInput) as caught:
            take(MATRICES[message])
        assert message in str(caught.value), (name, caught.value)


def box_of(body):
    return body.vertices.min(axis=0), body.vertices.max(axis=0)


def test_parts_of_a_scene_of_trimesh_keep_scale_mirror_and_shear():
    """The corners of a part are those that trimesh itself makes of the whole scene."""
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.Scene()
    box = trimesh.creation.box((1, 2, 3))
    turned = trimesh.transformations.rotation_matrix(0.7, [1, 2, 3], [4, 5, 6])
    for i, matrix in enumerate([np.eye(4), turned, SCALED, *MATRICES.values()][:-1]):
        scene.add_geometry(box, node_name=f"part {i}", transform=turned @ matrix if i > 2 else matrix)
    parent = np.diag([1.0, 1, 2, 1])
    parent[:3, 3] = 7, 8, 9
    scene.graph.update("group", matrix=parent)
    scene.add_geometry(box, node_name="child", parent_node_name="group", transform=turned)
    parts = chasles.parts_from_trimesh(scene)
    expected = {node: box.copy().apply_transform(scene.graph[node][0]) for node in scene.graph.nodes_geometry}
    assert set(parts) == set(expected) and len(parts) == 9
    for name, mesh in expected.items():
        body = parts[name]
        np.testing.assert_allclose(body.vertices, mesh.vertices, atol=1e-12)
        corners = body.vertices[np.array(body.faces)]
        volume = np.linalg.det(corners).sum() / 6  # positive where the faces turn outwards
        assert volume == pytest.approx(mesh.volume) and volume > 0, name


def test_nodes_of_trimesh_keep_their_names_and_none_is_lost():
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.Scene()
    nodes = {1: (2, 1, 1), "1": (1, 1, 1), "1_2": (3, 1, 1)}  # a number and a text that reads alike
    for node, size in nodes.items():
        scene.add_geometry(trimesh.creation.box(size), node_name=node)
    parts = chasles.parts_from_trimesh(scene)
    lengths = {name: np.ptp(body.vertices[:, 0]) for name, body in parts.items()}
    assert lengths == {"1": 1, "1_2": 3, "1_3": 2}


def test_scenes_of_trimesh_are_not_lost_in_silence(cube):
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.Scene([trimesh.creation.box((1, 1, 1))])
    with pytest.raises(chasles.InvalidInput, match="a Scene has no vertices and faces; parts_from_trimesh"):
        chasles.from_trimesh(scene)
    with pytest.raises(chasles.InvalidInput, match="scene: a Trimesh is no trimesh.Scene; from_trimesh"):
        chasles.parts_from_trimesh(trimesh.creation.box((1, 1, 1)))
    scene.add_geometry(trimesh.PointCloud([[0, 0, 0]]), node_name="cloud")
    with pytest.raises(chasles.InvalidInput, match="cloud: a PointCloud has no faces; delete it from the scene"):
        chasles.parts_from_trimesh(scene)


@pytest.mark.parametrize("value, text", [(3, "an int has no"), (None, "a NoneType has no"), ([], "a list has no")])
def test_messages_have_the_right_article(value, text):
    with pytest.raises(chasles.InvalidInput, match=f"mesh: {text} vertices and faces"):
        chasles.from_trimesh(value)


def test_meshes_of_trimesh_in_the_place_of_a_polyhedron_name_the_way_out(cube):
    trimesh = pytest.importorskip("trimesh")
    box = trimesh.creation.box((1, 1, 1))
    needed = r"must be a chasles\.Polyhedron, not a"
    with pytest.raises(TypeError, match=rf"moving: {needed} .*Trimesh; chasles\.from_trimesh"):
        chasles.first_contact(box, cube, [3, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, 0])
    with pytest.raises(TypeError, match=rf"shape: {needed} .*Scene; chasles\.parts_from_trimesh"):
        chasles.Scene().add("a", trimesh.Scene([box]))


@pytest.mark.parametrize("scales", [(0, 1, 1), (0, 0, 0), (1, 1, 0)])
def test_flat_parts_of_trimesh_are_refused(scales):
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box((1, 1, 1)), node_name="flat", transform=np.diag([*scales, 1.0]))
    with pytest.raises(chasles.InvalidInput, match=r"flat: its transform flattens the mesh \(a scale of 0\)"):
        chasles.parts_from_trimesh(scene)


def test_mirrors_of_any_scale_turn_outwards():
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.Scene()
    box = trimesh.creation.box((1, 1, 1))
    box.vertices *= 1e120
    scene.add_geometry(box, node_name="small", transform=np.diag([-1e-120, 1e-120, 1e-120, 1]))
    body = chasles.parts_from_trimesh(scene)["small"]
    assert np.linalg.det(body.vertices[np.array(body.faces)]).sum() > 0  # the determinant of the scale rounds to 0


def test_messages_name_a_pose_once():
    with pytest.raises(chasles.InvalidInput, match="^pose: matrix: "):
        chasles.Motion.at_rest(SCALED)
    with pytest.raises(chasles.InvalidInput, match="^start: pose: matrix: "):
        chasles.ScrewMotion.between(SCALED, np.eye(4))
