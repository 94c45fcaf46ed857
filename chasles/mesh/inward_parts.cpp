#include "chasles/mesh/inward_parts.h"

#include "chasles/mesh/connected_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace chasles {
namespace {

/// The volumes of the parts, each as seen from a vertex of the part: a small part far away keeps its sign.
class PartVolumes {
public:
    PartVolumes(const Surface& surface, const Volume& volume)
        : surface_(surface), parts_(parts_of_surface(
                                 surface.vertices.size(), surface.outlines.size(),
                                 [&](std::size_t face) { return surface.outlines[face]; }, volume.joined)),
          sums_(surface.vertices.size()) {
        for (std::size_t face = 0; face < surface.outlines.size(); ++face)
            if (volume.is_bounded_by(face))
                add(surface.outlines[face]);
    }

    [[nodiscard]] std::size_t count_below_zero() const {
        return static_cast<std::size_t>(std::ranges::count_if(sums_, [](const Sum& sum) {
            constexpr double rounding = 0x1p-52;     // of one operation, twice
            const double operations = sum.count + 8; // each term enters the sum, and has eight roundings of its own
            return sum.value < -rounding * operations * sum.magnitude;
        }));
    }

private:
    struct Sum {
        double value = 0;
        double magnitude = 0; ///< sum of the terms without their signs
        double count = 0;
    };

    void add(std::span<const std::uint32_t> outline) {
        const std::uint32_t part = parts_.of(outline[0]);
        const Eigen::Vector3d& origin = surface_.vertices[part];
        const auto corner = [&](std::size_t i) -> Eigen::Vector3d { return surface_.vertices[outline[i]] - origin; };
        Sum& sum = sums_[part];
        const Eigen::Vector3d first = corner(0);
        for (std::size_t i = 2; i < outline.size(); ++i) {
            const Eigen::Vector3d a = corner(i - 1), b = corner(i);
            sum.value += first.dot(a.cross(b));
            sum.magnitude += first.norm() * a.norm() * b.norm();
            ++sum.count;
        }
    }

    const Surface& surface_;
    ConnectedParts parts_;
    std::vector<Sum> sums_; ///< for the vertex that stands for a part
};

} // namespace

std::size_t count_inward_parts(const Surface& surface, const Volume& volume) {
    return volume.is_solid() ? PartVolumes(surface, volume).count_below_zero() : 0;
}

} // namespace chasles
