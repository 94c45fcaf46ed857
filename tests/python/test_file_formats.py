"""A file means the same in every format, and assemblies keep their parts."""

import base64
import io
import json
import pathlib
import struct
import zipfile

import numpy as np
import pytest

import chasles

LOWER, UPPER = np.array([-0.0625, -0.0625, 0.0]), np.array([0.0625, 0.0625, 1.0])
CORNERS = [(x, y, z) for x in (-0.0625, 0.0625) for y in (-0.0625, 0.0625) for z in (0.0, 1.0)]
TRIANGLES = [
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
    (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
]  # fmt: skip
MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"


def words(rows) -> str:
    return " ".join(str(number) for row in rows for number in row)


def lines(rows, start: str = "") -> str:
    return "".join(start + " ".join(map(str, row)) + "\n" for row in rows)


def collada(up_axis: str) -> str:
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>{up_axis}</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="24">{words(CORNERS)}</float_array><technique_common>
<accessor source="#a" count="8" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>{words(TRIANGLES)}</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node name="post">
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def gltf(nodes: list[dict], uri: str | None) -> dict:
    return {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5121, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 36}],
        "buffers": [{"byteLength": 132} | ({"uri": uri} if uri else {})],
    }


BUFFER = np.array(CORNERS, np.float32).tobytes() + np.array(TRIANGLES, np.uint8).tobytes()


def glb(nodes: list[dict]) -> bytes:
    text = json.dumps(gltf(nodes, None)).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(BUFFER), b"BIN\0") + BUFFER
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def threemf() -> bytes:
    vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in CORNERS)
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in TRIANGLES)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("_rels/.rels", f'<Relationships><Relationship Target="/m.model" Type="{MODEL_TYPE}"/></Relationships>')
        archive.writestr(
            "m.model",
            f'<model unit="meter"><resources><object id="1" name="post"><mesh><vertices>{vertices}</vertices><triangles>'
            f'{triangles}</triangles></mesh></object></resources><build><item objectid="1"/></build></model>',
        )
    return packed.getvalue()


def facets() -> str:
    return "".join(
        "facet normal 0 0 0\nouter loop\n" + lines([CORNERS[i] for i in triangle], "vertex ") + "endloop\nendfacet\n"
        for triangle in TRIANGLES
    )


PLY = (
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 12\nproperty list uchar int vertex_indices\nend_header\n"
)
FACES = lines([(3, *triangle) for triangle in TRIANGLES])
FILES = {
    "post.obj": lines(CORNERS, "v ") + lines([[i + 1 for i in triangle] for triangle in TRIANGLES], "f "),
    "post.off": "OFF\n8 12 0\n" + lines(CORNERS) + FACES,
    "post.ply": PLY + lines(CORNERS) + FACES,
    "post.stl": "solid post\n" + facets() + "endsolidpost\n",
    "post.gltf": json.dumps(gltf([{"mesh": 0}], "data:;base64," + base64.b64encode(BUFFER).decode())),
    "post.glb": glb([{"mesh": 0}]),
    "x_up.dae": collada("X_UP"),
    "y_up.dae": collada("Y_UP"),
    "z_up.dae": collada("Z_UP"),
    "post.3mf": threemf(),
}


def write(folder, name: str):
    content = FILES[name]
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize("name", FILES)
def test_every_format_means_the_same(name, tmp_path):
    path = write(tmp_path, name)
    parts = chasles.load_parts(path)
    assert len(parts) == 1
    for body in [chasles.load(path), *parts.values()]:
        assert body.report.closed and body.report.faces == 12
        np.testing.assert_array_equal(body.vertices.min(axis=0), LOWER)
        np.testing.assert_array_equal(body.vertices.max(axis=0), UPPER)


@pytest.mark.parametrize("name", [name for name in FILES if not name.endswith(("glb", "gltf", "dae", "3mf"))])
@pytest.mark.parametrize("end", ["\r", "\r\n"])
def test_text_may_have_any_line_ends(name, end, tmp_path):
    path = write(tmp_path, name)
    body = chasles.load(path)
    path.write_bytes(path.read_bytes().replace(b"\n", end.encode()))
    np.testing.assert_array_equal(chasles.load(path).vertices, body.vertices)
    assert chasles.load(path).faces == body.faces


@pytest.mark.parametrize("name", ["post.bt", "post.ot", "color.ot"])
def test_maps_of_octomap_mean_the_same(name, tmp_path):
    path = pathlib.Path(__file__).parents[1] / "fuzz/corpus/mesh_files" / name  # OctoMap wrote them
    for body in [chasles.load(path), *chasles.load_parts(path).values()]:
        assert body.report.closed and body.report.volume == 1 / 64
        np.testing.assert_array_equal(body.vertices.min(axis=0), LOWER)
        np.testing.assert_array_equal(body.vertices.max(axis=0), UPPER)
    with pytest.raises(chasles.InvalidInput, match="is a map of cubes, not of points"):
        chasles.load_points(path, 0.1)


def test_load_merges_an_assembly_and_load_parts_keeps_its_parts(tmp_path):
    path = tmp_path / "two.glb"
    path.write_bytes(glb([{"mesh": 0, "name": "post"}, {"mesh": 0, "name": "post", "translation": [2, 0, 0]}]))
    assert chasles.load(path).report.faces == 24
    parts = chasles.load_parts(path)
    assert list(parts) == ["post", "post_2"]
    np.testing.assert_array_equal(parts["post_2"].vertices.min(axis=0), LOWER + [2, 0, 0])
    found = chasles.first_contact(parts["post"], parts["post_2"], [0, 0, 0, 1, 0, 0, 0], [4, 0, 0, 1, 0, 0, 0])
    assert found.time == pytest.approx((2 - 0.125) / 4, abs=1e-12)


def test_other_formats_are_refused_with_the_way_out(tmp_path):
    (tmp_path / "a.fbx").write_text("x")
    (tmp_path / "a.step").write_text("ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));")
    with pytest.raises(chasles.InvalidInput, match="no reader for the extension '.fbx'.*glTF, 3MF, STL or OBJ"):
        chasles.load(tmp_path / "a.fbx")
    with pytest.raises(chasles.InvalidInput, match="is a STEP file.*chasles cad"):
        chasles.load_parts(tmp_path / "a.step")
