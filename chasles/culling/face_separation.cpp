#include "chasles/culling/face_separation.h"

#include "chasles/culling/nearest_to_origin.h"

#include <algorithm>
#include <span>

namespace chasles::culling {

namespace {

Vector3<double> mean(const std::vector<Vector3<double>>& corners) {
    Vector3<double> sum{0, 0, 0};
    for (const Vector3<double>& corner : corners)
        sum = sum + corner;
    return scale(sum, 1.0 / double(corners.size()));
}

const Vector3<double>& least_along(const Vector3<double>& direction, const std::vector<Vector3<double>>& corners) {
    const Vector3<double>* least = corners.data();
    double height = dot(direction, *least);
    for (const Vector3<double>& corner : std::span(corners).subspan(1))
        if (const double other = dot(direction, corner); other < height) {
            least = &corner;
            height = other;
        }
    return *least;
}

/// The point on the way from one point to another one that is nearest to 0: a step of Gilbert's algorithm.
Vector3<double> step_towards(const Vector3<double>& nearest, const Vector3<double>& farthest) {
    const Vector3<double> way = farthest - nearest;
    return nearest + scale(way, std::clamp(-dot(nearest, way) / dot(way, way), 0.0, 1.0));
}

} // namespace

template <class Nearer>
bool FaceSeparation::approach(int most_steps, double enough, WidestGap& widest, Nearer nearer) const {
    Vector3<double> nearest = between_means_;
    for (int step = 0; step < most_steps; ++step) {
        const double distance = length(nearest);
        if (!(distance > 0))
            break;
        const Vector3<double> farthest = try_direction(scale(nearest, 1 / distance), widest);
        if (widest.gap > enough * distance)
            return true;
        nearest = nearer(nearest, farthest);
    }
    return false;
}

/// Gilbert's algorithm: `nearest` is a point of the difference of both convex hulls, and moves to the point nearest to
/// 0 on the way to the support along it.
std::optional<Vector3<double>> FaceSeparation::direction(std::uint32_t moving_face, std::uint32_t fixed_face,
                                                         double time, double distance) {
    constexpr int most_steps = 6;
    place_corners(moving_face, fixed_face, time);
    Vector3<double> nearest = between_means_;
    for (int step = 0; step < most_steps; ++step) {
        const double square = dot(nearest, nearest);
        if (!(square > distance * distance))
            return std::nullopt;
        const Vector3<double> farthest = support(nearest);
        const double gap = dot(nearest, farthest);
        if (gap > 0 && gap * gap > distance * distance * square)
            return nearest;
        nearest = step_towards(nearest, farthest);
    }
    return std::nullopt;
}

/// Gilbert's algorithm converges slowly for faces that lie along each other: they are widest apart along a normal of a
/// face, or along a direction that is perpendicular to two edges.
std::optional<FaceSeparation::Direction> FaceSeparation::widest(std::uint32_t moving_face, std::uint32_t fixed_face,
                                                                double time) {
    constexpr int most_steps = 3;
    constexpr double enough = 0.9; // of the distance
    place_corners(moving_face, fixed_face, time);
    WidestGap widest;
    if (approach(most_steps, enough, widest, step_towards))
        return Direction{widest.direction, no_axis};
    for (Axis axis = 1; axis < end_of_axes(); ++axis)
        try_axis(axis, widest);
    return widest.gap > 0 ? std::optional(Direction{widest.direction, widest.axis}) : std::nullopt;
}

std::optional<Vector3<double>> FaceSeparation::along(Axis axis, std::uint32_t moving_face, std::uint32_t fixed_face,
                                                     double time) {
    place_corners(moving_face, fixed_face, time);
    WidestGap widest;
    if (axis != no_axis && axis < end_of_axes())
        try_axis(axis, widest);
    return widest.gap > 0 ? std::optional(widest.direction) : std::nullopt;
}

/// Each step of Gilbert's algorithm is at a point of the difference of both hulls: the faces are no farther apart.
std::optional<Vector3<double>> FaceSeparation::beyond(std::uint32_t moving_face, std::uint32_t fixed_face, double time,
                                                      double distance) {
    constexpr int most_steps = 6;
    place_corners(moving_face, fixed_face, time);
    WidestGap widest;
    Vector3<double> nearest = between_means_;
    for (int step = 0; step < most_steps; ++step) {
        const double most = length(nearest);
        if (!(most > distance))
            break;
        const Vector3<double> farthest = try_direction(scale(nearest, 1 / most), widest);
        if (widest.gap > distance)
            break;
        nearest = step_towards(nearest, farthest);
    }
    return widest.gap > 0 ? std::optional(widest.direction) : std::nullopt;
}

/// E. Gilbert, D. Johnson and S. Keerthi, "A fast procedure for computing the distance between complex objects in
/// three-dimensional space", 1988.
std::optional<Vector3<double>> FaceSeparation::nearest(std::uint32_t moving_face, std::uint32_t fixed_face,
                                                       double time) {
    constexpr int most_steps = 24;
    constexpr double enough = 1 - 1e-9; // of the distance
    place_corners(moving_face, fixed_face, time);
    WidestGap widest;
    Simplex simplex; // of points of the difference of both hulls
    approach(most_steps, enough, widest, [&](const auto&, const auto& farthest) { return simplex.add(farthest); });
    return widest.gap > 0 ? std::optional(widest.direction) : std::nullopt;
}

FaceSeparation::Axis FaceSeparation::end_of_axes() const {
    constexpr std::size_t most_edge_pairs = 64;
    const std::size_t edge_pairs = moving_corners_.size() * fixed_corners_.size();
    return first_of_edges + (edge_pairs <= most_edge_pairs ? Axis(edge_pairs) : 0);
}

/// The normals of both faces, and then the perpendiculars of their edges.
void FaceSeparation::try_axis(Axis axis, WidestGap& widest) const {
    if (axis < first_of_edges) {
        const auto& corners = axis == 1 ? fixed_corners_ : moving_corners_;
        try_across(corners[1] - corners[0], corners[2] - corners[0], axis, widest);
        return;
    }
    const std::size_t edges = axis - first_of_edges, count = fixed_corners_.size();
    try_across(edge(moving_corners_, edges / count), edge(fixed_corners_, edges % count), axis, widest);
}

/// From a corner to the next one.
Vector3<double> FaceSeparation::edge(const std::vector<Vector3<double>>& corners, std::size_t from) {
    return corners[from + 1 < corners.size() ? from + 1 : 0] - corners[from];
}

/// Along a unit direction. Returns the support.
Vector3<double> FaceSeparation::try_direction(const Vector3<double>& along, WidestGap& widest, Axis axis) const {
    const Vector3<double> farthest = support(along);
    if (const double gap = dot(along, farthest); gap > widest.gap)
        widest = {along, gap, axis};
    return farthest;
}

/// Perpendicular to both, towards the moving face.
void FaceSeparation::try_across(const Vector3<double>& a, const Vector3<double>& b, Axis axis,
                                WidestGap& widest) const {
    const Vector3<double> across = cross(a, b);
    const double size = length(across);
    if (!(size > 0))
        return;
    const bool is_towards_moving = dot(across, between_means_) > 0;
    try_direction(scale(across, is_towards_moving ? 1 / size : -1 / size), widest, axis);
}

/// Consecutive questions often share a face.
void FaceSeparation::place_corners(std::uint32_t moving_face, std::uint32_t fixed_face, double time) {
    if (moving_face_ != moving_face || time_ != time) {
        const MatrixPose place = ends_.at(time);
        moving_corners_.clear();
        for (const std::uint32_t corner : moving_.face(moving_face))
            moving_corners_.push_back(place(point_of<double>(moving_, corner)));
        moving_mean_ = mean(moving_corners_);
        moving_face_ = moving_face;
        time_ = time;
    }
    if (fixed_face_ != fixed_face) {
        fixed_corners_.clear();
        for (const std::uint32_t corner : fixed_.face(fixed_face))
            fixed_corners_.push_back(point_of<double>(fixed_, corner));
        fixed_mean_ = mean(fixed_corners_);
        fixed_face_ = fixed_face;
    }
    between_means_ = moving_mean_ - fixed_mean_;
}

/// The point of the difference of both faces that is least along the direction.
Vector3<double> FaceSeparation::support(const Vector3<double>& direction) const {
    return least_along(direction, moving_corners_) - least_along(scale(direction, -1.0), fixed_corners_);
}

} // namespace chasles::culling
