// Four points as three arrays: one instruction then computes with several of them.
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/matrix_pose.h"

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <tuple>

namespace chasles::search {

/// Four points; the last ones may be equal.
struct FourPoints {
    using Coordinates = Eigen::Array<double, 4, 1, Eigen::DontAlign>; ///< of one layout in every instruction set

    Coordinates x;
    Coordinates y;
    Coordinates z;

    [[nodiscard]] bool are_beyond(double height, const Eigen::Vector3d& way) const {
        return (x * way.x() + y * way.y() + z * way.z()).minCoeff() > height;
    }
    [[nodiscard]] FourPoints moved(const motion::MatrixPose& pose) const {
        const auto& [rows, shift] = std::tie(pose.rotation.row, pose.translation);
        const auto coordinate = [&](int i) -> Coordinates {
            return rows[i].x * x + rows[i].y * y + rows[i].z * z + shift[i];
        };
        return {coordinate(0), coordinate(1), coordinate(2)};
    }
    [[nodiscard]] FourPoints moved_back(const motion::MatrixPose& pose) const {
        const auto& rows = pose.rotation.row;
        const FourPoints from{x - pose.translation.x, y - pose.translation.y, z - pose.translation.z};
        const auto coordinate = [&](int i) -> Coordinates {
            return rows[0][i] * from.x + rows[1][i] * from.y + rows[2][i] * from.z;
        };
        return {coordinate(0), coordinate(1), coordinate(2)};
    }
};

/// Calls `visit(four points)` until all corners of a face have been visited.
template <class Visit>
void for_four_corners(const Body& body, std::uint32_t face, Visit visit) {
    const std::span<const std::uint32_t> corners = body.face(face);
    for (std::size_t first = 0; first < corners.size(); first += 4) {
        FourPoints points;
        for (std::size_t i = 0; i < 4; ++i) {
            const Eigen::Vector3d& point = body.vertices()[corners[std::min(first + i, corners.size() - 1)]];
            const auto lane = static_cast<Eigen::Index>(i);
            points.x[lane] = point.x();
            points.y[lane] = point.y();
            points.z[lane] = point.z();
        }
        visit(points);
    }
}

} // namespace chasles::search
