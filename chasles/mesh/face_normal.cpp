#include "chasles/mesh/face_normal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

namespace chasles {

namespace {

/// A unit vector at a right angle to the longest diagonal from the first corner.
Eigen::Vector3d beside_longest(const Body& body, std::span<const std::uint32_t> corners) {
    const auto arm = [&](std::uint32_t corner) -> Eigen::Vector3d {
        return body.vertices()[corner] - body.vertices()[corners[0]];
    };
    const auto length = [&](std::uint32_t corner) { return arm(corner).stableNorm(); };
    return arm(*std::ranges::max_element(corners, {}, length)).stableNormalized().unitOrthogonal();
}

} // namespace

FaceNormal face_normal(const Body& body, std::uint32_t face) {
    constexpr double rounding = 8 * 0x1p-53; // of a cross product, over the product of the lengths
    const auto corners = body.face(face);
    const Eigen::Vector3d& first = body.vertices()[corners[0]];
    const auto arm = [&](std::size_t i) -> Eigen::Vector3d { return body.vertices()[corners[i]] - first; };
    double size = 0;
    for (std::size_t i = 1; i < corners.size(); ++i)
        size = std::max(size, arm(i).cwiseAbs().maxCoeff());
    if (size == 0) // a point
        return {Eigen::Vector3d::UnitX(), 1};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double products = 0;
    Eigen::Vector3d a = arm(1) / size;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const Eigen::Vector3d b = arm(i) / size;
        sum += a.cross(b);
        products += a.norm() * b.norm();
        a = b;
    }
    if (sum.isZero(0))
        return {beside_longest(body, corners), 1};
    return {sum.stableNormalized(), std::min(1.0, rounding * products / sum.stableNorm())};
}

} // namespace chasles
