// One post, 0.125 wide and 1 high along z, in each format that is read.
#pragma once

#include "tests/io/file_bytes.h"
#include "tests/io/octomap_file.h"

#include <fmt/format.h>
#include <string>
#include <vector>

namespace chasles::tests {

struct PostFile {
    std::string name;
    std::string content;
};

/// Corner i: x by bit 2, y by bit 1, z by bit 0.
inline std::array<double, 3> post_corner(int i) {
    return {(i & 4) ? 0.0625 : -0.0625, (i & 2) ? 0.0625 : -0.0625, (i & 1) ? 1.0 : 0.0};
}

inline const std::vector<std::array<int, 3>>& post_triangles() {
    static const std::vector<std::array<int, 3>> triangles{{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5},
                                                           {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6},
                                                           {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    return triangles;
}

/// The corners and the triangles as text.
struct PostText {
    std::string obj, corners, faces, facets, float_array, indices, xml_vertices, xml_triangles;
    PostText() {
        for (int i = 0; i < 8; ++i) {
            const auto [x, y, z] = post_corner(i);
            corners += fmt::format("{} {} {}\n", x, y, z);
            obj += fmt::format("v {} {} {}\n", x, y, z);
            float_array += fmt::format("{} {} {} ", x, y, z);
            xml_vertices += fmt::format(R"(<vertex x="{}" y="{}" z="{}"/>)", x, y, z);
        }
        for (const auto& [a, b, c] : post_triangles()) {
            faces += fmt::format("3 {} {} {}\n", a, b, c);
            obj += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
            indices += fmt::format("{} {} {} ", a, b, c);
            xml_triangles += fmt::format(R"(<triangle v1="{}" v2="{}" v3="{}"/>)", a, b, c);
            facets += "facet normal 0 0 0\nouter loop\n";
            for (const int i : {a, b, c})
                facets += fmt::format("vertex {} {} {}\n", post_corner(i)[0], post_corner(i)[1], post_corner(i)[2]);
            facets += "endloop\nendfacet\n";
        }
    }
};

inline std::string post_binary_ply() {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
                        "property float z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < 8; ++i)
        for (const double x : post_corner(i))
            bytes += bytes_of(float(x));
    for (const auto& triangle : post_triangles()) {
        bytes += char(3);
        for (const int corner : triangle)
            bytes += bytes_of(corner);
    }
    return bytes;
}

inline std::string post_binary_stl() {
    std::string bytes = std::string(80, ' ') + bytes_of(std::uint32_t{12});
    for (const auto& triangle : post_triangles()) {
        bytes += std::string(12, '\0');
        for (const int corner : triangle)
            for (const double x : post_corner(corner))
                bytes += bytes_of(float(x));
        bytes += std::string(2, '\0');
    }
    return bytes;
}

/// The JSON of the post, and the bytes of its one buffer: positions, then indices.
inline std::string post_gltf_json(const std::string& buffer) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "post", "mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "buffers": [{"byteLength": 168)" +
           buffer + "}]}";
}

inline std::string post_buffer() {
    std::string bytes;
    for (int i = 0; i < 8; ++i)
        for (const double x : post_corner(i))
            bytes += bytes_of(float(x));
    for (const auto& triangle : post_triangles())
        for (const int corner : triangle)
            bytes += bytes_of(std::uint16_t(corner));
    return bytes;
}

inline std::string post_collada(const std::string& up_axis) {
    const PostText text;
    return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>)" +
           up_axis + R"(</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="24">)" +
           text.float_array + R"(</float_array><technique_common><accessor source="#a" count="8" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
           text.indices + R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node name="post"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

inline std::string post_3mf(const std::string& unit = "meter") {
    const PostText text;
    return threemf("<model unit=\"" + unit +
                   R"(" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>
<object id="1" name="post"><mesh><vertices>)" +
                   text.xml_vertices + "</vertices><triangles>" + text.xml_triangles +
                   R"(</triangles></mesh></object></resources><build><item objectid="1"/></build></model>)");
}

inline OctomapWriter post_octomap() {
    std::set<OctomapCell> cells;
    for (int x = -1; x < 1; ++x)
        for (int y = -1; y < 1; ++y)
            for (int z = 0; z < 16; ++z)
                cells.insert({x, y, z});
    return {std::move(cells), true};
}

inline std::vector<PostFile> post_files() {
    const PostText text;
    return {
        {"post.obj", text.obj},
        {"post.off", "OFF\n8 12 0\n" + text.corners + text.faces},
        {"ascii.ply", "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 12\nproperty list uchar int vertex_indices\nend_header\n" +
                          text.corners + text.faces},
        {"binary.ply", post_binary_ply()},
        {"ascii.stl", "solid post\n" + text.facets + "endsolid post\n"},
        {"binary.stl", post_binary_stl()},
        {"post.gltf",
         post_gltf_json(R"(, "uri": "data:application/octet-stream;base64,)" + base64(post_buffer()) + "\"")},
        {"post.glb", glb(post_gltf_json(""), post_buffer())},
        {"x_up.dae", post_collada("X_UP")},
        {"y_up.dae", post_collada("Y_UP")},
        {"z_up.dae", post_collada("Z_UP")},
        {"post.3mf", post_3mf()},
        {"post.bt", post_octomap().bt(0.0625)},
        {"post.ot", post_octomap().ot(0.0625)}};
}

} // namespace chasles::tests
