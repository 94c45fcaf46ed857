// Two bodies at one configuration, and everywhere near it: do they stay apart, or in touch?
// Source: docs/derivations/40-ranges.md, "Clear" and "In contact".
#pragma once

#include "chasles/robot/overlap_surface.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace chasles::robot {

/// How joints may move one body as seen from another one, in the frame of the fixed body. A point of the moving body is
/// displaced by the sum of what the turns and slides do to it at first order, and by no more than `rest_of_moving`
/// beside it; likewise a point of the fixed body, as seen from the moving one.
struct SmallMotion {
    struct Step {
        Eigen::Vector3d axis;   ///< of unit length
        Eigen::Vector3d origin; ///< on the axis
        double way;             ///< radians, or the length unit
        bool turns;
    };
    std::vector<Step> steps = {};
    double rest_of_moving = 0;
    double rest_of_fixed = 0;
    double way_of_moving = 0; ///< bounds the displacement of any point of the body, with the rest
    double way_of_fixed = 0;

    /// A bound at first order of the displacement of a point.
    [[nodiscard]] double way(const Eigen::Vector3d& point) const {
        double sum = 0;
        for (const Step& step : steps)
            sum += step.way * (step.turns ? step.axis.cross(point - step.origin).norm() : 1);
        return sum;
    }
    /// Likewise of its component along a unit vector, for all points within a radius.
    [[nodiscard]] double way_along(const Eigen::Vector3d& direction, const Eigen::Vector3d& point,
                                   double radius = 0) const {
        double sum = 0;
        for (const Step& step : steps) {
            if (!step.turns) {
                sum += step.way * std::abs(direction.dot(step.axis));
                continue;
            }
            const Eigen::Vector3d lever = direction.cross(step.axis);
            sum += step.way * (std::abs(lever.dot(point - step.origin)) + (radius > 0 ? radius * lever.norm() : 0));
        }
        return sum;
    }
};

/// Two faces that may come within the margin.
struct NearFaces {
    std::uint32_t moving = 0;
    std::uint32_t fixed = 0;
};

/// Both bodies at one configuration. All are kept by reference but the pose, which places the moving body in the frame
/// of the fixed one.
struct PairAtRest {
    const OverlapSurface& moving;
    const OverlapSurface& fixed;
    Eigen::Isometry3d relative;
    const SmallMotion& motion;
    double margin = 0; ///< of the question
    double size = 0;   ///< of the lengths that enter the pose
};

/// Empty if the bodies are proven to stay farther apart than the margin, and neither to be inside of the other one,
/// wherever the motion takes them. Otherwise two faces for which that is not proven; `first` is tried first.
std::optional<NearFaces> near_faces(const PairAtRest& pair, const std::optional<NearFaces>& first = {});

/// Whether the bodies are proven to touch, or to be within the margin, wherever the motion takes them.
bool stay_in_touch(const PairAtRest& pair);

} // namespace chasles::robot
