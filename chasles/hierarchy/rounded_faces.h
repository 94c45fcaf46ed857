// Faces relative to the middle of their body, in single precision and rounded outward.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/hierarchy/split_boxes.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace chasles {

/// Lists of vertices, and what encloses each vertex.
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
