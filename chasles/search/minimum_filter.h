// Rejects features that cannot be at a local minimum of the distance to a face, before any root is computed.
// Source: docs/derivations/17-hold.md, "Before any root".
#pragma once

#include "chasles/contact/feature_pair.h"
#include "chasles/culling/interval_ends.h"
#include "chasles/search/four_points.h"
#include "chasles/search/owned_pairs.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace chasles::search {

/// The filter of one search. Bodies are kept by reference.
class MinimumFilter {
public:
    MinimumFilter(const Body& moving, const Body& fixed) : moving_(moving), fixed_(fixed) {}

    /// Sets the interval. A direction leads nearer if the distance falls by more than `tolerance` times its length
    /// (length unit). The tolerance covers chord deviations and roundings.
    void use(const culling::IntervalEnds& ends, double tolerance) {
        poses_ = {ends.start, ends.end};
        is_at_rest_ = false;
        tolerance_ = tolerance;
    }
    /// Likewise for bodies at rest.
    void use(const motion::MatrixPose& pose, double tolerance) {
        poses_ = {pose, pose};
        is_at_rest_ = true;
        tolerance_ = tolerance;
    }

    /// Sets the two faces. False if no two features that they own are at a local minimum during the interval.
    bool set(const TwoFaces& faces);
    /// Whether the features, which the two faces own, may be at a local minimum.
    [[nodiscard]] bool allows(const contact::FeaturePair& features) const {
        return !has(moving_side_, moving_feature_kind(features.kind), features.moving) &&
               !has(fixed_side_, fixed_feature_kind(features.kind), features.fixed);
    }

private:
    /// The features that a face owns.
    struct Side {
        std::vector<FourPoints> others; ///< corners of the other face at both ends, in the frame of this body
        std::vector<Feature> rejected;  ///< a vertex is a feature with equal ends
        std::size_t vertices = 0;       ///< that are not rejected
        std::size_t edges = 0;
    };

    static bool has(const Side& side, FeatureKind kind, const Feature& feature) {
        return kind != FeatureKind::face && std::ranges::find(side.rejected, feature) != side.rejected.end();
    }
    void place(const TwoFaces& faces);
    void find_rejected(const Body& body, std::uint32_t face, Side& side) const;
    /// Whether all corners of the other face are on the side into which a way leads, away from the feature.
    [[nodiscard]] bool are_beside(const Side& side, std::span<const Eigen::Vector3d> ways, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& to) const;

    const Body& moving_;
    const Body& fixed_;
    std::array<motion::MatrixPose, 2> poses_{};
    bool is_at_rest_ = false; ///< both poses are equal
    double tolerance_ = 0;
    Side moving_side_;
    Side fixed_side_;
};

} // namespace chasles::search
