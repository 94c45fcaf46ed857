"""Bodies from arrays, files and other packages, and back."""

import gc
import os
import pickle
import sys

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, RAGGED, pose

import chasles


def test_arrays_come_back_as_they_were_given(cube):
    np.testing.assert_array_equal(cube.vertices, CUBE_VERTICES)
    assert cube.faces == [tuple(face) for face in CUBE_FACES.tolist()]
    assert cube.triangles.shape == (12, 3)
    np.testing.assert_array_equal(cube.source_faces, np.arange(6))


def test_vertices_are_a_view_that_outlives_its_body_and_cannot_be_written():
    body = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)
    vertices = body.vertices
    assert np.shares_memory(vertices, body.vertices)
    del body
    gc.collect()
    np.testing.assert_array_equal(vertices, CUBE_VERTICES)
    with pytest.raises(ValueError, match="read-only"):
        vertices[0, 0] = 7


def test_a_body_does_not_change_with_the_array_that_it_was_made_from():
    vertices = CUBE_VERTICES.copy()
    body = chasles.Polyhedron(vertices, CUBE_FACES)
    vertices[:] = np.nan
    np.testing.assert_array_equal(body.vertices, CUBE_VERTICES)


@pytest.mark.parametrize(
    "layout", ["float32", "int", "list", "fortran", "strided", "reversed", "big-endian", "unaligned"]
)
def test_any_layout_of_vertices_gives_the_same_body(layout):
    wide = np.zeros((16, 6))
    wide[::2, ::2] = CUBE_VERTICES
    raw = np.zeros(CUBE_VERTICES.nbytes + 1, np.uint8)
    unaligned = raw[1:].view(np.float64).reshape(8, 3)
    unaligned[:] = CUBE_VERTICES
    vertices = {
        "float32": CUBE_VERTICES.astype(np.float32),
        "int": CUBE_VERTICES.astype(int),
        "list": CUBE_VERTICES.tolist(),
        "fortran": np.asfortranarray(CUBE_VERTICES),
        "strided": wide[::2, ::2],
        "reversed": CUBE_VERTICES[::-1].copy()[::-1],
        "big-endian": CUBE_VERTICES.astype(">f8"),
        "unaligned": unaligned,
    }[layout]
    body = chasles.Polyhedron(vertices, CUBE_FACES)
    np.testing.assert_array_equal(body.vertices, CUBE_VERTICES)


@pytest.mark.parametrize("kind", [np.int8, np.int32, np.uint32, np.uint64, ">i4"])
def test_faces_of_any_whole_numbers(kind):
    assert chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES.astype(kind)).faces == [
        tuple(face) for face in CUBE_FACES.tolist()
    ]


def test_faces_that_are_looked_at_in_place():
    faces = CUBE_FACES.astype(np.uint32)
    for given in (faces, faces[::-1].copy()[::-1], np.asfortranarray(faces)):
        given.flags.writeable = False
        assert chasles.Polyhedron(CUBE_VERTICES, given).faces == [tuple(face) for face in CUBE_FACES.tolist()]


def test_faces_of_different_sizes():
    faces = [[0, 1, 5, 4], [0, 4, 7], (0, 7, 3), np.array([1, 2, 6, 5])]
    body = chasles.Polyhedron(CUBE_VERTICES, faces)
    assert body.faces == [(0, 1, 5, 4), (0, 4, 7), (0, 7, 3), (1, 2, 6, 5)]
    assert body.report.triangles == 6


@pytest.mark.parametrize(
    ("vertices", "faces", "why"),
    [
        (CUBE_VERTICES[:, :2], CUBE_FACES, r"vertices: the shape is \(8, 2\)"),
        (CUBE_VERTICES.ravel(), CUBE_FACES, r"vertices: the shape is \(24,\)"),
        (CUBE_VERTICES * np.nan, CUBE_FACES, "NaN|finite"),
        (CUBE_VERTICES + 1j, CUBE_FACES, "complex128 is not an array of real numbers"),
        (CUBE_VERTICES.astype(str), CUBE_FACES, "not an array of real numbers"),
        ([[0, 0, 0], [1, 0]], CUBE_FACES, RAGGED),
        (CUBE_VERTICES, CUBE_FACES.astype(float), "not an array of whole numbers"),
        (CUBE_VERTICES, CUBE_FACES - 1, "there is no vertex -1"),
        (CUBE_VERTICES, CUBE_FACES + 2**40, "there is no vertex"),
        (CUBE_VERTICES, CUBE_FACES + 1, "face"),
        (CUBE_VERTICES, CUBE_FACES[:, :2], "face"),
        (CUBE_VERTICES, CUBE_FACES.ravel(), r"faces: the shape is \(24,\)"),
        (CUBE_VERTICES, [], "faces"),
        (CUBE_VERTICES, [[0, 1, 2], [0, 1, 2.5, 3]], r"faces\[1\].*whole"),
        (CUBE_VERTICES, [[0, 1, 2], [[0], [1], [2], [3]]], r"faces\[1\].*shape"),
        (CUBE_VERTICES, 5, "faces"),
        (CUBE_VERTICES, None, "faces"),
        (np.empty((0, 3)), CUBE_FACES, "face"),
    ],
)
def test_what_is_no_body_is_refused_by_name(vertices, faces, why):
    with pytest.raises(chasles.InvalidInput, match=why):
        chasles.Polyhedron(vertices, faces)


def test_files(tmp_path, cube):
    file = tmp_path / "cube.obj"
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in CUBE_VERTICES.tolist()]
    file.write_text("\n".join(lines + ["f " + " ".join(str(i + 1) for i in face) for face in CUBE_FACES]) + "\n")
    for name in (file, str(file)):
        np.testing.assert_array_equal(chasles.load(name).vertices, cube.vertices)
    with pytest.raises(chasles.InvalidInput, match="nothing.obj"):
        chasles.load(tmp_path / "nothing.obj")


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names of files are text there")
def test_a_file_whose_name_is_no_text(tmp_path):
    with pytest.raises(chasles.InvalidInput, match=r"\\x80.obj: no such file"):
        chasles.load(os.fsencode(tmp_path) + b"/\x80.obj")


def test_trimesh(cube):
    trimesh = pytest.importorskip("trimesh")
    body = chasles.from_trimesh(trimesh.creation.box(extents=(1, 1, 1)))
    assert body.report.closed and body.report.faces == 12
    with pytest.raises(chasles.InvalidInput, match="str has no vertices"):
        chasles.from_trimesh("box")


def test_pickle_keeps_every_id(cube):
    again = pickle.loads(pickle.dumps(cube))
    np.testing.assert_array_equal(again.vertices, cube.vertices)
    assert again.faces == cube.faces


def test_pickle_keeps_the_ids_of_the_input_where_faces_were_dropped():
    faces = [[0, 1, 0], *CUBE_FACES.tolist()]
    body = chasles.Polyhedron(CUBE_VERTICES, faces)
    assert body.report.dropped_faces == 1
    again = pickle.loads(pickle.dumps(body))
    np.testing.assert_array_equal(again.source_faces, np.arange(1, 7))
    np.testing.assert_array_equal(again.source_faces, body.source_faces)


def test_pickle_keeps_the_ids_of_a_file_whose_faces_were_cut(tmp_path):
    file = tmp_path / "bent.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0.3\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\n")
    body = chasles.load(file, triangulate=True)
    np.testing.assert_array_equal(body.source_faces, [0, 0, 1])
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(body)).source_faces, [0, 0, 1])


def test_report_and_repr(cube):
    assert cube.report.closed and cube.report.edges == 12 and cube.report.polygons == 6
    assert repr(cube) == "<chasles.Polyhedron: 8 vertices, 6 faces, closed>"
    assert repr(cube.report) == "MeshReport(vertices=8, faces=6, edges=12, closed=True)"


def test_bodies_stay_as_long_as_an_answer_needs_them():
    found = chasles.first_contact(
        chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES),
        chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES),
        pose(3, 0, 0),
        pose(0, 0, 0),
    )
    gc.collect()
    np.testing.assert_array_equal(found.moving.vertices, CUBE_VERTICES)
    assert chasles.first_contact(found.moving, found.fixed, motion=found.motion).time == found.time
