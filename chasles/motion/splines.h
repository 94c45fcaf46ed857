// Splines of positions and orientations as frames. Source: docs/derivations/26-frames.md, "Splines".
#pragma once

#include "chasles/motion/moving_frame.h"
#include "chasles/motion/timed_poses.h"

#include <span>

namespace chasles::motion {

/// Even motions from pose to pose; a velocity has the body point `centre` on straight lines. Times ascend from 0 to 1.
SharedFrame even_track(std::vector<double> times, std::span<const Pose> poses, TimedPoses::Between kind,
                       const Eigen::Vector3d& centre);

/// The body's origin on the natural cubic spline through all positions, with slerp from orientation to orientation.
SharedFrame natural_spline(const std::vector<double>& times, std::span<const Pose> poses);

/// The uniform cumulative cubic B-spline, whose first and last control pose count three times.
SharedFrame cumulative_b_spline(std::span<const Pose> poses);

/// The second derivatives of the natural cubic spline through points at ascending times, by the usual tridiagonal
/// system. Points are vectors of Eigen.
template <class Vector>
std::vector<Vector> natural_second_derivatives(std::span<const double> times, const std::vector<Vector>& points) {
    const std::size_t last = times.size() - 1;
    std::vector<Vector> seconds(times.size(), Vector::Zero(points.front().size()));
    std::vector<double> diagonal(times.size(), 1);
    const auto slope = [&](std::size_t i) -> Vector { return (points[i + 1] - points[i]) / (times[i + 1] - times[i]); };
    for (std::size_t i = 1; i < last; ++i) { // elimination of what is below the diagonal
        const double before = times[i] - times[i - 1];
        diagonal[i] = 2 * (times[i + 1] - times[i - 1]);
        seconds[i] = 6 * (slope(i) - slope(i - 1));
        if (i > 1) {
            const double factor = before / diagonal[i - 1];
            diagonal[i] -= factor * before;
            seconds[i] -= factor * seconds[i - 1];
        }
    }
    for (std::size_t i = last; i-- > 1;) {
        if (i + 1 < last)
            seconds[i] -= (times[i + 1] - times[i]) * seconds[i + 1];
        seconds[i] /= diagonal[i];
    }
    return seconds;
}

/// Throws InvalidInput unless there are at least two poses and as many times, which ascend from 0 to 1.
void require_track(std::span<const double> times, std::span<const Pose> poses);

} // namespace chasles::motion
