"""Bodies with a radius: round ones, and parts that touch by design."""

import math
import pickle

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES

import chasles


def at(x, y=0, z=0):
    return [x, y, z, 1, 0, 0, 0]


def test_round_bodies_meet_at_the_sum_of_their_radii():
    ball, pill = chasles.sphere(0.5), chasles.capsule(0.25, 2)
    cloud = chasles.points([[0, 0, 0], [0, 0, 5]], 0.25)
    for other in (pill, cloud):
        found = chasles.first_contact(ball, other, at(4.75, 0, 0), at(0.75, 0, 0))
        assert found.verdict == "contact"
        assert found.time == pytest.approx(1, abs=1e-11)
        assert np.allclose(found.contacts[0].point, [0.25, 0, 0])
        assert found.contacts[0].gap == pytest.approx(0, abs=1e-9)
    assert chasles.first_contact(ball, pill, at(4.75, 0, 0), at(0.7500001, 0, 0)).verdict == "clear"
    assert chasles.least_distance(ball, pill, at(4, 0, 0), at(3, 0, 0)).distance_upper == pytest.approx(2.25, rel=1e-6)


def test_every_way_to_a_body_takes_a_radius(tmp_path, cube):
    file = tmp_path / "cube.off"
    lines = ["OFF", "8 6 0", *(" ".join(map(str, v)) for v in CUBE_VERTICES)]
    file.write_text("\n".join([*lines, *(f"{len(f)} " + " ".join(map(str, f)) for f in CUBE_FACES)]))
    bodies = [
        chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES, radius=0.5),
        chasles.load(file, radius=0.5),
        *chasles.load_parts(file, radius=0.5).values(),
        cube.with_radius(0.5),
    ]
    for body in bodies:
        assert body.radius == body.report.radius == 0.5
        copy = pickle.loads(pickle.dumps(body))
        assert copy.radius == 0.5
        assert chasles.first_contact(copy, cube, at(4, 0, 0), at(0, 0, 0)).time == pytest.approx(0.625, abs=1e-11)


def test_parts_that_touch_by_design_may_slide(cube):
    block = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES, radius=-1e-6)
    assert (block.radius, block.report.moved_inwards) == (0, 1e-6)
    for body in (block, pickle.loads(pickle.dumps(block)), cube.with_radius(-1e-6)):
        assert np.array_equal(body.vertices, block.vertices)
        assert chasles.first_contact(body, cube, at(1, 0, 0), at(1, 0.5, 0)).verdict == "clear"
        assert chasles.first_contact(body, cube, at(1, 0, 0), at(0.5, 0, 0)).time == pytest.approx(2e-6, rel=1e-6)


def test_scenes_and_robots(tmp_path):
    scene = chasles.Scene()
    scene.add("ball", chasles.sphere(1), at(0))
    scene.add("other", chasles.sphere(1), at(4), goal=at(0))
    assert scene.first_contact().time == pytest.approx(0.5, abs=1e-11)
    urdf = tmp_path / "box.urdf"
    shape = "<collision><geometry><box size='2 2 2'/></geometry></collision>"
    urdf.write_text(f"<robot name='r'><link name='a'>{shape}</link></robot>")
    robot = chasles.Robot.load(urdf, radius=0.25)
    assert robot.collisions("a")[0][0].radius == 0.25
    assert chasles.Robot.load(urdf).shape(radius=0.5).radius == 0.5


def test_refusals(cube):
    for make, message in [
        (lambda: chasles.sphere(-1), "sphere: radius: must be positive"),
        (lambda: chasles.capsule(1, math.nan), "capsule: length: must be positive"),
        (lambda: chasles.points([[1, 2]], 1), "points: the shape is (1, 2)"),
        (lambda: chasles.points(np.empty((0, 3)), 1), "points: needs at least one point"),
        (lambda: cube.with_radius(-0.7), "turns face"),
        (lambda: cube.with_radius(math.inf), "mesh: radius: inf must be in"),
        (lambda: chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES[1:], radius=-0.1), "not closed"),
    ]:
        with pytest.raises(chasles.InvalidInput, match=message.replace("(", r"\(").replace(")", r"\)")):
            make()
