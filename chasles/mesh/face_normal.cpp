#include "chasles/mesh/face_normal.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles {

FaceNormal face_normal(const Body& body, std::uint32_t face) {
    constexpr double rounding = 8 * 0x1p-53; // of a cross product, over the product of the lengths
    const auto corners = body.face(face);
    const auto arm = [&](std::size_t i) -> Eigen::Vector3d {
        return body.vertices()[corners[i]] - body.vertices()[corners[0]];
    };
    Eigen::Vector3d longest = arm(1);
    for (std::size_t i = 2; i < corners.size(); ++i)
        if (arm(i).stableNorm() > longest.stableNorm())
            longest = arm(i);
    const double size = longest.cwiseAbs().maxCoeff();
    if (size == 0) // a point
        return {Eigen::Vector3d::UnitX(), 1};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double products = 0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Eigen::Vector3d a = arm(i) / size;
        const Eigen::Vector3d b = arm(i + 1) / size;
        sum += a.cross(b);
        products += a.norm() * b.norm();
    }
    if (sum.isZero(0))
        return {longest.stableNormalized().unitOrthogonal(), 1};
    return {sum.stableNormalized(), std::min(1.0, rounding * products / sum.stableNorm())};
}

} // namespace chasles
