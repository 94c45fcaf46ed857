#include "chasles/mesh/face_normal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace chasles {

namespace {

/// A unit vector at a right angle to the longest diagonal from the first corner.
Eigen::Vector3d beside_longest(std::span<const Eigen::Vector3d> arms) {
    const auto length = [](const Eigen::Vector3d& arm) { return arm.stableNorm(); };
    return std::ranges::max_element(arms, {}, length)->stableNormalized().unitOrthogonal();
}

} // namespace

FaceNormal face_normal(const Body& body, std::uint32_t face) {
    constexpr double rounding = 8 * 0x1p-53;   // of a cross product, over the product of the lengths
    constexpr double surely_normal = 0x1p-900; // a square of a length that has lost nothing to underflow
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
        products += std::sqrt(a.squaredNorm() * b.squaredNorm());
        a = b;
    }
    const double square = sum.squaredNorm();
    const double length = square > surely_normal ? std::sqrt(square) : sum.stableNorm();
    if (length == 0) {
        std::vector<Eigen::Vector3d> arms;
        for (std::size_t i = 1; i < corners.size(); ++i)
            arms.push_back(arm(i));
        return {beside_longest(arms), 1};
    }
    const Eigen::Vector3d unit = square > surely_normal ? Eigen::Vector3d(sum / length) : sum.stableNormalized();
    return {unit, std::min(1.0, rounding * products / length)};
}

} // namespace chasles
