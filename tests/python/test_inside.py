"""Bodies inside of each other, through every kind of question of the package."""

import pickle

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES

import chasles

START, GOAL = [0.4, 0.5, 0.5, 1, 0, 0, 0], [5, 0, 0, 1, 0, 0, 0]


@pytest.fixture
def speck():
    return chasles.Polyhedron(0.1 * np.array(CUBE_VERTICES), CUBE_FACES)


@pytest.fixture
def hollow():
    return chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES, solid="no")


def test_answers_name_the_body_that_is_inside(speck, cube, hollow):
    found = chasles.first_contact(speck, cube, START, GOAL)
    assert (found.verdict, found.certain, found.contacts, found.overlap) == ("contact_at_start", True, (), None)
    assert found.inside == "moving"
    assert np.allclose(found.inside_point, speck.vertices[found.inside_vertex] + START[:3])
    assert "the moving body inside of the fixed one" in repr(found)
    assert found.swapped().inside == "fixed"
    assert chasles.first_contact(cube, speck, [-0.4, -0.5, -0.5, 1, 0, 0, 0], GOAL).inside == "fixed"
    free = chasles.first_contact(speck, hollow, START, GOAL)
    assert (free.verdict, free.inside, free.inside_vertex, free.inside_point) == ("contact", None, None, None)


def test_every_question_sees_it(speck, cube, hollow):
    least = chasles.least_distance(speck, cube, START, GOAL)
    assert (least.distance_upper, least.inside) == (0, "moving")
    assert "inside" in repr(least)
    assert chasles.least_distance(speck, hollow, START, START).distance > 0.39
    path = chasles.first_contact_on_path(speck, cube, [START, START, GOAL])
    assert (path.verdict, path.segment, path.inside) == ("contact_at_start", 0, "moving")
    row = chasles.first_contact_batch(speck, cube, np.array([START]), np.array([GOAL]))[0]
    assert row["verdict"] == "contact_at_start" and row["kind"] == ""
    vertex, again = row["moving_feature"].tolist()
    assert vertex == again and row["fixed_feature"].tolist() == [-1, -1]
    assert np.allclose([row[x] for x in ("px", "py", "pz")], speck.vertices[vertex] + START[:3]) and np.isnan(row["nx"])
    scene = chasles.Scene()
    scene.add("speck", speck, START, GOAL)
    scene.add("cube", cube)
    event = scene.first_contact()
    assert (event.verdict, event.pair, event.inside) == ("contact_at_start", ("speck", "cube"), "moving")
    assert [set(pair) for pair in scene.ignore_touching_at_start()] == [{"speck", "cube"}]


def test_objects_at_rest(speck, cube):
    manager = chasles.CollisionManager()
    manager.add_object("cube", cube)
    touches, names, data = manager.in_collision_single(speck, START, return_names=True, return_data=True)
    assert touches and names == {"cube"} and len(data) == 1
    assert ((START[:3] <= data[0].point) & (data[0].point <= np.array(START[:3]) + 0.1)).all()
    with pytest.raises(AttributeError, match="inside"):
        _ = data[0].normal
    with pytest.raises(chasles.InvalidInput, match="cube: the other object is inside of it"):
        data[0].index("cube")
    assert manager.min_distance_single(speck, START) == 0


URDF = '<robot name="r"><link name="a"><collision><geometry><box size="2 2 2"/></geometry></collision></link></robot>'


def test_shapes_of_robots(speck, tmp_path):
    (tmp_path / "cube.obj").write_text(
        "".join(f"v {x} {y} {z}\n" for x, y, z in CUBE_VERTICES) + "".join(f"f {' '.join(str(i + 1) for i in face)}\n" for face in CUBE_FACES)
    )
    (tmp_path / "box.urdf").write_text(URDF)
    (tmp_path / "mesh.urdf").write_text(URDF.replace('<box size="2 2 2"/>', '<mesh filename="cube.obj"/>'))

    def inside(body):
        return chasles.first_contact(speck, body, START, START).inside

    robot = chasles.Robot.load(tmp_path / "box.urdf")
    assert (inside(robot.shape()), inside(robot.shape(solid="no"))) == ("moving", None)
    for solid, expected in (("automatic", "moving"), ("no", None)):
        robot = chasles.Robot.load(tmp_path / "mesh.urdf", solid=solid)
        shape = robot.collisions("a")[0][0]
        assert inside(shape) == inside(pickle.loads(pickle.dumps(shape))) == expected
    assert inside(chasles.Robot.load(tmp_path / "box.urdf", solid="no").collisions("a")[0][0]) == "moving"


def test_what_is_solid(cube, hollow):
    assert (cube.report.parts, cube.report.solid_parts, cube.report.unpaired_edges) == (1, 1, 0)
    assert cube.report.volume == pytest.approx(1)
    assert hollow.report.solid_parts == 0
    room = chasles.Polyhedron(CUBE_VERTICES, [face[::-1] for face in CUBE_FACES])
    for body in (room, pickle.loads(pickle.dumps(room))):
        assert (body.report.solid_parts, body.report.inward_parts) == (0, 1)
        assert body.report.volume == -cube.report.volume
    assert pickle.loads(pickle.dumps(hollow)).report.solid_parts == 0
    with pytest.raises(chasles.InvalidInput, match="mesh: solid: the surface is not closed.*4 edges"):
        chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES[:-1], solid="yes")
    for wrong in (True, None, "maybe", 1):
        with pytest.raises(chasles.InvalidInput, match="solid: .*must be 'automatic', 'yes' or 'no'"):
            chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES, solid=wrong)
