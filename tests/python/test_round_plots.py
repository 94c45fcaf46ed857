"""Round bodies are drawn round by plot."""

import sys

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES

import chasles
from chasles.plot import MOST_TRIANGLES, _is_drawn_round, _polygons

L_OUTLINE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
L_FACES = [[5, 4, 3, 2, 1, 0], [6, 7, 8, 9, 10, 11], *[[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]]


def l_shape(radius):
    return chasles.Polyhedron([[x, y, z] for z in (0, 1) for x, y in L_OUTLINE], L_FACES, radius=radius)


def distances(points, boxes):
    """To the union of boxes that stand on z = 0 and are 1 high."""
    boxes = np.asarray(boxes, float)
    near = np.clip(points[:, None], np.insert(boxes[:, 0], 2, 0, axis=1), np.insert(boxes[:, 1], 2, 1, axis=1))
    return np.linalg.norm(points[:, None] - near, axis=2).min(axis=1)


def test_spheres_and_capsules_have_their_size():
    ball = np.concatenate(_polygons(chasles.sphere(0.5)))
    np.testing.assert_allclose(np.linalg.norm(ball, axis=1), 0.5)
    np.testing.assert_allclose(np.ptp(ball, axis=0), 1)
    pill = np.concatenate(_polygons(chasles.capsule(0.25, 2)))
    np.testing.assert_allclose(np.linalg.norm(pill - np.clip(pill, [0, 0, -1], [0, 0, 1]), axis=1), 0.25)
    np.testing.assert_allclose(np.ptp(pill, axis=0), [0.5, 0.5, 2.5])


@pytest.mark.parametrize("is_corner_cut", [False, True])
def test_of_a_round_body_the_surface_is_drawn(is_corner_cut):
    """Each polygon has a corner on the surface: the others are inside."""
    boxes = [([0, 0], [2, 1]), ([0, 0], [1, 2])] if is_corner_cut else [([0, 0], [1, 1])]
    body = l_shape(0.25) if is_corner_cut else chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES, radius=0.25)
    polygons = _polygons(body)
    for polygon in polygons:
        found = distances(polygon, boxes)
        assert found.max() == pytest.approx(0.25)
        assert is_corner_cut or found.min() == pytest.approx(0.25, abs=0.1)
    ends = np.concatenate(polygons)
    np.testing.assert_allclose([ends.min(axis=0), ends.max(axis=0)], [[-0.25] * 3, [*boxes[0][1][:1], boxes[-1][1][1], 1] + np.full(3, 0.25)])
    normals = [np.cross(p[2] - p[0], p[-1] - p[1]) for p in polygons]
    middle = ends.mean(axis=0)
    outwards = [n @ (p.mean(axis=0) - middle) > 0 for n, p in zip(normals, polygons, strict=True)]
    assert is_corner_cut or all(outwards)


def test_the_surface_of_a_round_cube_is_whole(cube):
    def area(p):
        return np.linalg.norm(np.cross(p[1:-1] - p[0], p[2:] - p[0]).sum(axis=0)) / 2

    radius = 0.25
    drawn = sum(area(polygon) for polygon in _polygons(cube.with_radius(radius)))
    assert drawn == pytest.approx(6 + 12 * np.pi / 2 * radius + 4 * np.pi * radius**2, rel=0.01)


def test_large_bodies_are_thinned_out():
    points = np.random.default_rng(7).uniform(-1, 1, (30_000, 3))
    tube = [(np.cos(u), np.sin(u), v) for u in np.arange(0, 6.2, 0.1) for v in np.arange(0, 1, 0.01)]
    faces = [[i, i + 1, i + 101, i + 100] for i in range(len(tube) - 101)]
    assert 1000 < len(_polygons(chasles.Polyhedron(tube, faces, triangulate=True, radius=0.2))) <= MOST_TRIANGLES
    drawn = _polygons(chasles.points(points, 0.02))
    assert MOST_TRIANGLES / 2 < len(drawn) <= MOST_TRIANGLES
    np.testing.assert_allclose(np.ptp(np.concatenate(drawn), axis=0), 2, atol=0.1)


def test_points_in_rows_are_thinned_out_without_stripes():
    rows, columns = np.meshgrid(np.arange(200.0), np.arange(200.0))
    drawn = _polygons(chasles.points(np.stack([rows.ravel(), columns.ravel(), 0 * rows.ravel()], axis=1), 0.25))
    middles = np.round([polygon[:, :2].mean(axis=0) for polygon in drawn])
    for axis in (0, 1):
        assert len(np.unique(middles[:, axis])) > 190


def test_plots_without_matplotlib_say_what_to_install(cube, monkeypatch):
    for module in ("matplotlib", "matplotlib.pyplot"):
        monkeypatch.setitem(sys.modules, module, None)
    found = chasles.first_contact(cube, cube, [3, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, 0])
    with pytest.raises(ModuleNotFoundError, match="pip install matplotlib"):
        found.plot()


def test_a_radius_that_is_not_seen_leaves_the_mesh(cube):
    assert not _is_drawn_round(cube.with_radius(1e-3)) and _is_drawn_round(cube.with_radius(0.1))
    assert _is_drawn_round(chasles.capsule(1e-3, 1))


def test_plots_have_room_for_round_bodies(cube):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    axes = chasles.first_contact(chasles.sphere(0.5), cube, [3, 0.5, 0.5, 1, 0, 0, 0], [0, 0.5, 0.5, 1, 0, 0, 0]).plot()
    assert axes.get_title() == "contact at time 0.5"
    assert axes.get_xlim()[0] <= 0 and axes.get_xlim()[1] >= 3
    assert axes.get_zlim()[0] <= 0 and axes.get_zlim()[1] >= 1
    axes.figure.canvas.draw()
    plt.close("all")
