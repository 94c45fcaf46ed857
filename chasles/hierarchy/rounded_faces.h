// The faces of a body in single precision, relative to the centre of the body and rounded outward.
// The boxes of the faces enclose the faces.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/hierarchy/split_boxes.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace chasles {

/// The outlines of faces as lists of vertices, and a box around each vertex.
struct RoundedFaces {
    const FlatLists<std::uint32_t>& outlines;
    std::span<const PackedBox> vertices;

    [[nodiscard]] std::size_t size() const { return outlines.size(); }
    [[nodiscard]] PackedBox box(std::size_t face) const {
        PackedBox box = PackedBox::empty();
        for (const std::uint32_t vertex : outlines[face])
            box.extend(vertices[vertex]);
        box.set_face(static_cast<std::uint32_t>(face));
        return box;
    }
};

} // namespace chasles
