"""Writes one mesh in each format that is read."""

import base64
import io
import json
import struct
import zipfile
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Mesh:
    vertices: list[tuple[float, float, float]]
    triangles: list[tuple[int, int, int]]


def cube() -> Mesh:
    """The unit cube: corner i has x by bit 2, y by bit 1, z by bit 0."""
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [half for a, b, c, d in sides for half in ((a, b, c), (a, c, d))]
    return Mesh([(i >> 2 & 1, i >> 1 & 1, i & 1) for i in range(8)], triangles)


def sheet(n: int) -> Mesh:
    """The unit square in the plane z = 0, of 2 n n triangles."""
    triangles = []
    for a in (i * (n + 1) + j for i in range(n) for j in range(n)):
        triangles += [(a, a + n + 1, a + n + 2), (a, a + n + 2, a + 1)]
    return Mesh([(i / n, j / n, 0.0) for i in range(n + 1) for j in range(n + 1)], triangles)


def numbers(rows: list[tuple], head: str = "", shift: int = 0, end: str = "\n") -> str:
    return "".join(head + " ".join(str(number + shift) for number in row) + end for row in rows)


def obj(mesh: Mesh) -> bytes:
    return ("# a mesh\no part\n" + numbers(mesh.vertices, "v ") + numbers(mesh.triangles, "f ", 1)).encode()


def off(mesh: Mesh) -> bytes:
    head = f"OFF\n{len(mesh.vertices)} {len(mesh.triangles)} 0\n"
    return (head + numbers(mesh.vertices) + numbers(mesh.triangles, "3 ")).encode()


def ply_header(mesh: Mesh, form: str) -> str:
    head = f"ply\nformat {form} 1.0\ncomment a mesh\nelement vertex {len(mesh.vertices)}\n"
    head += "".join(f"property double {axis}\n" for axis in "xyz")
    return head + f"element face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"


def ply(mesh: Mesh) -> bytes:
    return (ply_header(mesh, "ascii") + numbers(mesh.vertices) + numbers(mesh.triangles, "3 ")).encode()


def binary_ply(mesh: Mesh) -> bytes:
    vertices = b"".join(struct.pack("<3d", *vertex) for vertex in mesh.vertices)
    return ply_header(mesh, "binary_little_endian").encode() + vertices + b"".join(
        struct.pack("<B3i", 3, *triangle) for triangle in mesh.triangles
    )


def stl(mesh: Mesh) -> bytes:
    text = "solid part\n"
    for triangle in mesh.triangles:
        corners = numbers([mesh.vertices[i] for i in triangle], "vertex ")
        text += f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n"
    return (text + "endsolid part\n").encode()


def binary_stl(mesh: Mesh) -> bytes:
    facets = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for i in triangle for x in mesh.vertices[i]), 0) for triangle in mesh.triangles
    )
    return b"a mesh".ljust(80) + struct.pack("<I", len(mesh.triangles)) + facets


def gltf_json(mesh: Mesh, uri: str = "") -> dict:
    vertices, corners = len(mesh.vertices), 3 * len(mesh.triangles)
    buffer = {"byteLength": 12 * vertices + 4 * corners, **({"uri": uri} if uri else {})}
    views = [
        {"buffer": 0, "byteOffset": 0, "byteLength": 12 * vertices},
        {"buffer": 0, "byteOffset": 12 * vertices, "byteLength": 4 * corners},
    ]
    accessors = [
        {"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5125, "count": corners, "type": "SCALAR"},
    ]
    nodes = [{"name": "whole", "children": [1], "translation": [0, 0, 0]}, {"name": "part", "mesh": 0}]
    parts = [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}]}]
    head = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}]}
    return {**head, "nodes": nodes, "meshes": parts, "accessors": accessors, "bufferViews": views, "buffers": [buffer]}


def gltf_buffer(mesh: Mesh) -> bytes:
    vertices = b"".join(struct.pack("<3f", *vertex) for vertex in mesh.vertices)
    return vertices + b"".join(struct.pack("<3I", *triangle) for triangle in mesh.triangles)


def gltf(mesh: Mesh) -> bytes:
    """With its buffer inside."""
    uri = "data:application/octet-stream;base64," + base64.b64encode(gltf_buffer(mesh)).decode()
    return json.dumps(gltf_json(mesh, uri)).encode()


def glb_of(text: bytes, buffer: bytes) -> bytes:
    text += b" " * (-len(text) % 4)
    buffer += bytes(-len(buffer) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def glb(mesh: Mesh) -> bytes:
    return glb_of(json.dumps(gltf_json(mesh)).encode(), gltf_buffer(mesh))


def dae(mesh: Mesh) -> bytes:
    places, corners = numbers(mesh.vertices, end=" "), numbers(mesh.triangles, end=" ")
    axes = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="{3 * len(mesh.vertices)}">{places}</float_array>
<technique_common><accessor source="#a" count="{len(mesh.vertices)}" stride="3">{axes}</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{len(mesh.triangles)}"><input semantic="VERTEX" source="#v" offset="0"/><p>{corners}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node name="part"><translate>0 0 0</translate><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
""".encode()


RELATIONS = """<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model"
Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>"""


def zip_of(parts: dict[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", method) as archive:
        for name, part in parts.items():
            archive.writestr(zipfile.ZipInfo(name), part, method)
    return buffer.getvalue()


def threemf(mesh: Mesh) -> bytes:
    vertices = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*vertex) for vertex in mesh.vertices)
    triangles = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*triangle) for triangle in mesh.triangles)
    model = f"""<model unit="meter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>
<object id="1" name="part"><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object>
<object id="2"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 0"/></components></object></resources>
<build><item objectid="2"/></build></model>"""
    return zip_of({"_rels/.rels": RELATIONS.encode(), "3D/3dmodel.model": model.encode()})


WRITERS: dict[str, list[Callable[[Mesh], bytes]]] = {
    "obj": [obj],
    "off": [off],
    "ply": [ply, binary_ply],
    "stl": [stl, binary_stl],
    "gltf": [gltf],
    "glb": [glb],
    "dae": [dae],
    "3mf": [threemf],
    "bt": [],  # those of the corpus only, as OctoMap wrote them
    "ot": [],
}
