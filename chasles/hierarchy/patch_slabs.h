// The slabs of all nodes of a patch. A patch is a subtree with so few faces that their surface may be nearly flat.
// Each slab encloses the corners of all faces below its node.
#pragma once

#include "chasles/hierarchy/bvh.h"
#include "chasles/hierarchy/rounded_faces.h"

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// Computes the slabs of patches, one patch after another. It reuses its memory.
class PatchSlabs {
public:
    /// A node with more faces has its box as slab, because almost no surface is flat over so many faces. In the cases
    /// of peers_bench this limit changes the number of node pairs by a few per cent. It halves the work for bodies of a
    /// million faces.
    static constexpr std::size_t largest_patch = 1024;

    /// `size` is the size of the body and greater than 0. Normals are computed relative to it: they neither overflow
    /// nor vanish.
    PatchSlabs(const RoundedFaces& faces, float size) : faces_(faces), unit_(1 / size) {}

    /// Sets the slabs of the node `root` and of all nodes below it. Its leaves have the faces of `boxes` from left to
    /// right. The slab of a node is normal to the sum of the face normals.
    void add(std::span<BvhNode> nodes, std::size_t root, std::span<const PackedBox> boxes);

private:
    /// Four corners of a face on SIMD lanes. The last corner fills unused lanes.
    struct FourCorners {
        Eigen::Array4f x;
        Eigen::Array4f y;
        Eigen::Array4f z;
    };
    struct Face {
        Eigen::Vector3f normal; ///< its length is twice the area, relative to the size of the body
        std::uint32_t end;      ///< end of its corners in `corners_`
    };

    void gather(std::size_t face);
    Eigen::Vector3f add_below(std::span<BvhNode> nodes, std::size_t root);
    [[nodiscard]] PackedSlab around(std::span<const FourCorners> corners, const Eigen::Vector3f& along,
                                    const BoxMiddle& box) const;

    RoundedFaces faces_;
    float unit_;
    std::vector<FourCorners> corners_;
    std::vector<Face> gathered_;
    std::size_t used_ = 0; ///< number of leaves visited
};

} // namespace chasles
