// Slabs for all nodes of a patch: a subtree of so few faces that they may be nearly flat.
#pragma once

#include "chasles/hierarchy/bvh.h"
#include "chasles/hierarchy/rounded_faces.h"

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// Makes the slabs of one patch after another; keeps its memory for the next one.
class PatchSlabs {
public:
    /// Nodes of more faces have their box for a slab: hardly a surface is flat over so many. That changes the pairs of
    /// nodes in the cases of peers_bench by a few per cent, and halves the work for bodies of a million faces.
    static constexpr std::size_t largest_patch = 1024;

    /// Normals are in terms of the body's size (greater than 0), so that they neither overflow nor vanish.
    PatchSlabs(const RoundedFaces& faces, float size) : faces_(faces), unit_(1 / size) {}

    /// To the node `root` and all below, whose leaves have the faces of `boxes` from left to right: around the corners
    /// of all faces of a node, along what their normals add up to.
    void add(std::span<BvhNode> nodes, std::size_t root, std::span<const PackedBox> boxes);

private:
    /// Corners of a face on SIMD lanes; the last one fills up.
    struct FourCorners {
        Eigen::Array4f x;
        Eigen::Array4f y;
        Eigen::Array4f z;
    };
    struct Face {
        Eigen::Vector3f normal; ///< as long as twice the area
        std::uint32_t end;      ///< of its corners
    };

    void gather(std::size_t face);
    Eigen::Vector3f add_below(std::span<BvhNode> nodes, std::size_t root);
    [[nodiscard]] PackedSlab around(std::span<const FourCorners> corners, const Eigen::Vector3f& along,
                                    const BoxMiddle& box) const;

    RoundedFaces faces_;
    float unit_;
    std::vector<FourCorners> corners_;
    std::vector<Face> gathered_;
    std::size_t used_ = 0; ///< faces whose leaves have been seen
};

} // namespace chasles
