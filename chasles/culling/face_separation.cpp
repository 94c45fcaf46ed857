#include "chasles/culling/face_separation.h"

#include <algorithm>

namespace chasles::culling {

/// Gilbert's algorithm: `nearest` is a point of the difference of both convex hulls, and moves to the point nearest to
/// 0 on the way to the support along it.
std::optional<Vector3<double>> FaceSeparation::direction(std::uint32_t moving_face, std::uint32_t fixed_face,
                                                         double time, double distance) {
    constexpr int most_steps = 6;
    place_corners(moving_face, fixed_face, time);
    Vector3<double> nearest = between_means();
    for (int step = 0; step < most_steps; ++step) {
        const double square = dot(nearest, nearest);
        if (!(square > distance * distance))
            return std::nullopt;
        const Vector3<double> farthest = support(nearest);
        const double gap = dot(nearest, farthest);
        if (gap > 0 && gap * gap > distance * distance * square)
            return nearest;
        const Vector3<double> way = farthest - nearest;
        nearest = nearest + scale(way, std::clamp(-dot(nearest, way) / dot(way, way), 0.0, 1.0));
    }
    return std::nullopt;
}

void FaceSeparation::place_corners(std::uint32_t moving_face, std::uint32_t fixed_face, double time) {
    const MatrixPose place = ends_.at(time);
    moving_corners_.clear();
    for (const std::uint32_t corner : moving_.face(moving_face))
        moving_corners_.push_back(place(point_of<double>(moving_, corner)));
    fixed_corners_.clear();
    for (const std::uint32_t corner : fixed_.face(fixed_face))
        fixed_corners_.push_back(point_of<double>(fixed_, corner));
}

Vector3<double> FaceSeparation::between_means() const {
    const auto mean = [](const std::vector<Vector3<double>>& corners) {
        Vector3<double> sum{0, 0, 0};
        for (const Vector3<double>& corner : corners)
            sum = sum + corner;
        return scale(sum, 1.0 / double(corners.size()));
    };
    return mean(moving_corners_) - mean(fixed_corners_);
}

/// The point of the difference of both faces that is least along the direction.
Vector3<double> FaceSeparation::support(const Vector3<double>& direction) const {
    const auto along = [&](const Vector3<double>& corner) { return dot(direction, corner); };
    return *std::ranges::min_element(moving_corners_, {}, along) - *std::ranges::max_element(fixed_corners_, {}, along);
}

} // namespace chasles::culling
