// Writes shapes as mesh files of all formats.
#pragma once

#include "tests/attack/shapes.h"

#include <array>
#include <bit>
#include <string>

namespace chasles::test {

struct MeshText {
    std::string extension;
    std::string bytes;
};

namespace detail {

inline std::string exact_text(double x) {
    std::array<char, 40> text{};
    return {text.data(), std::size_t(std::snprintf(text.data(), text.size(), "%.17g", x))};
}
inline std::string line_of(const Eigen::Vector3d& v) {
    return exact_text(v.x()) + " " + exact_text(v.y()) + " " + exact_text(v.z()) + "\n";
}
inline std::string lines_of(const attack::Shape& shape, bool has_indices_from_one) {
    std::string text;
    for (const Eigen::Vector3d& v : shape.vertices)
        text += (has_indices_from_one ? "v " : "") + line_of(v);
    for (const auto& face : shape.faces) {
        text += has_indices_from_one ? "f" : std::to_string(face.size());
        for (const std::uint32_t vertex : face)
            text += " " + std::to_string(vertex + (has_indices_from_one ? 1 : 0));
        text += "\n";
    }
    return text;
}
inline std::string ply_header(const attack::Shape& shape) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(shape.vertices.size()) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
           std::to_string(shape.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}
inline std::string ascii_stl(const attack::Shape& shape) {
    std::string text = "solid\n";
    for (const auto& face : shape.faces) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const std::uint32_t vertex : face)
            text += "vertex " + line_of(shape.vertices[vertex]);
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid\n";
}
template <class Number>
void append_bytes(std::string& bytes, Number number) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    bytes.append(raw.data(), raw.size());
}
inline std::string binary_stl(const attack::Shape& shape) {
    std::string bytes(80, ' ');
    append_bytes(bytes, std::uint32_t(shape.faces.size()));
    for (const auto& face : shape.faces) {
        bytes.append(12, '\0');
        for (const std::uint32_t vertex : face)
            for (const double x : shape.vertices[vertex])
                append_bytes(bytes, float(x));
        bytes.append(2, '\0');
    }
    return bytes;
}

} // namespace detail

inline constexpr int mesh_formats = 6;

/// A shape as a file: OBJ (twice, with and without a byte order mark), OFF, PLY, and STL in text or binary, which has
/// triangles only.
inline MeshText written(attack::Shape shape, int format) {
    using namespace detail;
    if (format >= 4)
        cut_into_triangles(shape);
    switch (format) {
    case 0:
        return {".obj", lines_of(shape, true)};
    case 1:
        return {".obj", "\xEF\xBB\xBF" + lines_of(shape, true)};
    case 2:
        return {".off", "OFF\n" + std::to_string(shape.vertices.size()) + " " + std::to_string(shape.faces.size()) +
                            " 0\n" + lines_of(shape, false)};
    case 3:
        return {".ply", ply_header(shape) + lines_of(shape, false)};
    case 4:
        return {".stl", ascii_stl(shape)};
    default:
        return {".stl", binary_stl(shape)};
    }
}

} // namespace chasles::test
