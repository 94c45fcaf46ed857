// A direction that separates two faces at one moment. Source: docs/derivations/16-margin.md, "Pruning".
#pragma once

#include "chasles/culling/cached_face.h"
#include "chasles/culling/interval_ends.h"

#include <optional>
#include <vector>

namespace chasles::culling {

/// Looks for directions between faces of two bodies in one interval. Bodies are kept by reference.
class FaceSeparation {
public:
    FaceSeparation(const Body& moving, const Body& fixed) : moving_(moving), fixed_(fixed) {}

    void use(const IntervalEnds& ends) {
        ends_ = ends;
        moving_face_.reset();
    }

    /// A direction from the fixed face to the moving face, of any length, along which the faces are farther apart than
    /// the distance at about `time` (in [0, 1] of the interval). Empty if the search finds none. The direction is a
    /// guess: rounding, and the motion between both ends of the interval, do not enter.
    std::optional<Vector3<double>> direction(std::uint32_t moving_face, std::uint32_t fixed_face, double time,
                                             double distance);

    /// A direction that the features of both faces have in common: a normal, or across two edges.
    using Axis = std::uint32_t;
    static constexpr Axis no_axis = 0;
    struct Direction {
        Vector3<double> along; ///< unit
        Axis axis;             ///< or none
    };
    /// The direction with the widest gap that a longer search finds, up to rounding. Empty if it finds no gap.
    std::optional<Direction> widest(std::uint32_t moving_face, std::uint32_t fixed_face, double time);
    /// The unit direction of an axis at another time. Empty if there is no gap along it.
    std::optional<Vector3<double>> along(Axis axis, std::uint32_t moving_face, std::uint32_t fixed_face, double time);

    /// A unit direction along which the faces are farther apart than the distance. If the search finds none: the
    /// direction with the widest gap that it finds. Empty if it finds no gap.
    std::optional<Vector3<double>> beyond(std::uint32_t moving_face, std::uint32_t fixed_face, double time,
                                          double distance);

    /// The unit direction between the nearest points of the convex hulls of both faces. Empty if it finds no gap.
    std::optional<Vector3<double>> nearest(std::uint32_t moving_face, std::uint32_t fixed_face, double time);

private:
    struct WidestGap {
        Vector3<double> direction{};
        double gap = 0;
        Axis axis = no_axis;
    };
    static constexpr Axis first_of_edges = 3;
    Vector3<double> try_direction(const Vector3<double>& along, WidestGap& widest, Axis axis = no_axis) const;
    /// Tries directions to points of the difference of both hulls, each nearer to 0 than the one before: `nearer` makes
    /// it from that one and its support. True once the gap is this part of the distance.
    template <class Nearer>
    bool approach(int most_steps, double enough, WidestGap& widest, Nearer nearer) const;
    [[nodiscard]] Axis end_of_axes() const;
    void try_axis(Axis axis, WidestGap& widest) const;
    void try_across(const Vector3<double>& a, const Vector3<double>& b, Axis axis, WidestGap& widest) const;
    static Vector3<double> edge(const std::vector<Vector3<double>>& corners, std::size_t from);
    void place_corners(std::uint32_t moving_face, std::uint32_t fixed_face, double time);
    [[nodiscard]] Vector3<double> support(const Vector3<double>& direction) const;

    const Body& moving_;
    const Body& fixed_;
    IntervalEnds ends_;
    std::optional<std::uint32_t> moving_face_; ///< placed at time_
    std::optional<std::uint32_t> fixed_face_;
    double time_ = 0;
    std::vector<Vector3<double>> moving_corners_;
    std::vector<Vector3<double>> fixed_corners_;
    Vector3<double> moving_mean_{};
    Vector3<double> fixed_mean_{};
    Vector3<double> between_means_{};
};

} // namespace chasles::culling
