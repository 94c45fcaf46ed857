"""A body that is made again from another one is the same body, in every way in which it can be made again."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, pose

import chasles

GAP_VERTICES = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 0, 0]], float)
GAP_FACES = [[0, 2, 1], [0, 4, 3], [4, 1, 3], [0, 1, 4], [0, 3, 2], [1, 2, 3]]  # [0, 1, 4] has no area
BENT = CUBE_VERTICES.copy()
BENT[6] += [0.1, 0.05, -0.1]
NEAR = CUBE_VERTICES.copy()
NEAR[6] += [1e-6, 5e-7, -1e-6]
SEGMENTS = np.array([*GAP_VERTICES, [5, 5, 5], [6, 5, 5]], float)

BODIES = {
    "gap": lambda: chasles.Polyhedron(GAP_VERTICES, GAP_FACES, solid="yes"),
    "round gap": lambda: chasles.Polyhedron(GAP_VERTICES, GAP_FACES, radius=1e-3),
    "surface with a gap": lambda: chasles.Polyhedron(GAP_VERTICES, GAP_FACES, solid="no"),
    "gap and segment": lambda: chasles.Polyhedron(SEGMENTS, [[5, 6, 6], *GAP_FACES]),
    "nearly planar": lambda: chasles.Polyhedron(NEAR, CUBE_FACES),
    "cut": lambda: chasles.Polyhedron(BENT, CUBE_FACES, triangulate=True),
    "cut and round": lambda: chasles.Polyhedron(BENT, CUBE_FACES, triangulate=True, radius=0.01),
    "moved": lambda: chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES, radius=-1e-3),
    "cut and moved": lambda: chasles.Polyhedron(BENT, CUBE_FACES, triangulate=True, radius=-1e-3),
}


def with_solid(body):
    return "automatic" if body.report.solid_parts else "no"


def from_arrays(body):
    return chasles.Polyhedron(body.vertices, body.faces, solid=with_solid(body), radius=body.radius)


def in_scene(body):
    scene = chasles.Scene()
    scene.add("body", body)
    return pickle.loads(pickle.dumps(scene)).__getstate__()[0][0][1]


def in_robot(body):
    robot = chasles.Robot(links=[{"name": "a", "collisions": [body]}])
    return pickle.loads(pickle.dumps(robot)).collisions("a")[0][0]


WITH_IDS = {
    "with_radius": lambda body: body.with_radius(body.radius),
    "with_radius twice": lambda body: body.with_radius(0.25).with_radius(body.radius),
    "pickle": lambda body: pickle.loads(pickle.dumps(body)),
    "pickle twice": lambda body: pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(body)))),
    "pickle with_radius": lambda body: pickle.loads(pickle.dumps(body.with_radius(body.radius))),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "scene": in_scene,
    "robot": in_robot,
}
WITHOUT_IDS = {"arrays": from_arrays, "arrays twice": lambda body: from_arrays(from_arrays(body))}


def seen_of(body):
    report = body.report
    counts = (report.solid_parts, report.inward_parts, report.closed, report.faces, report.segments)
    return counts, report.volume, report.radius, body.vertices.tobytes(), body.faces


def answers_of(body):
    random = np.random.default_rng(5)
    speck = chasles.Polyhedron(0.01 * CUBE_VERTICES, CUBE_FACES)
    poses = [(random.normal(size=7), np.r_[random.uniform(-0.5, 0.5, 3), random.normal(size=4)]) for _ in range(30)]
    poses.append((pose(0.3, 0.3, 0.3), pose(0.31, 0.3, 0.3)))  # inside of the solid ones
    found = [chasles.first_contact(speck, body, *places) for places in poses]
    assert sum(answer.verdict != "clear" for answer in found) > 3
    least = chasles.least_distance(speck, body, pose(3, 0, 0), pose(2.5, 0, 0))
    return [(a.verdict, a.time, a.time_upper, a.inside) for a in found], (least.distance, least.distance_upper)


@pytest.mark.parametrize("name", BODIES)
def test_it_is_the_same_body(name):
    body = BODIES[name]()
    assert body.report.solid_parts == (name != "surface with a gap")
    expected = answers_of(body)
    assert expected[0][-1][0] == ("clear" if name == "surface with a gap" else "contact_at_start")
    for way, make in (WITH_IDS | WITHOUT_IDS).items():
        again = make(body)
        assert seen_of(again) == seen_of(body), way
        assert answers_of(again) == expected, way
        if way in WITH_IDS:
            assert again.source_faces.tolist() == body.source_faces.tolist(), way
            assert again.report.moved_inwards == body.report.moved_inwards, way


def test_profiles_are_as_fine_after_pickle():
    body = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES, radius=-1e-6)
    plain = chasles.Polyhedron(body.vertices, body.faces)  # with no overlap that is allowed
    seen = [
        chasles.profile(shape, shape, pose(1 + 1e-5, 0, 0), pose(1, 0, 0)).lower.tolist()
        for shape in (body, pickle.loads(pickle.dumps(body)), plain)
    ]
    assert seen[0] == seen[1] != seen[2]


def test_scaled_arrays_stay_solid():
    body = BODIES["gap"]()
    for scale in (2, 0.1, 1 / 3):
        assert chasles.Polyhedron(scale * body.vertices, body.faces).report.solid_parts == 1
    assert len(body.faces) == len(body.source_faces) == body.report.faces + 1
    assert body.faces[-1] == (0, 1, 4) and body.source_faces[-1] == 3


def test_a_robot_as_one_body_keeps_the_inside():
    turned = [0.3, 0.1, 0.7, *np.array([0.8, 0.1, 0.5, 0.3])]
    robot = chasles.Robot(links=[{"name": "a", "collisions": [{"shape": BODIES["gap"](), "origin": turned}]}])
    for radius in (0.0, 1e-3):
        assert robot.shape(radius=radius).report.solid_parts == 1


def test_other_processes_have_the_same_body():
    bodies = [make() for make in BODIES.values()]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(seen_of, bodies) == [seen_of(body) for body in bodies]


def test_wrong_states_are_refused():
    good = (GAP_VERTICES, GAP_FACES, 0, "yes", 0.0, None, 0.0)
    chasles.Polyhedron.__new__(chasles.Polyhedron).__setstate__(good)
    for state in ((), good[:-1], (*good[:2], "0", *good[3:]), (*good[:5], [1, 2], 0.0), (*good[:4], None, None, 0.0)):
        with pytest.raises(chasles.InvalidInput, match=r"^state: is not that of|^mesh: 2 ids of faces for 6 outlines"):
            chasles.Polyhedron.__new__(chasles.Polyhedron).__setstate__(state)
