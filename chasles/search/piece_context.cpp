#include "chasles/search/piece_context.h"

#include "chasles/culling/body_ball.h"

#include <algorithm>
#include <cmath>

namespace chasles::search {

namespace {

/// The largest coordinate of a body.
double extent(const Bvh& bvh) {
    const BvhNode& root = bvh.nodes()[0];
    double result = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double half = std::max(std::abs(double(root.lower[i])), std::abs(double(root.upper[i])));
        result = std::max(result, std::abs(bvh.centre()[Eigen::Index(i)]) + half);
    }
    return result;
}

} // namespace

PieceContext::PieceContext(const Body& moving, const Body& fixed, std::unique_ptr<const motion::AnyPiece> piece)
    : moving_(moving), fixed_(fixed), piece_(std::move(piece)), maps_(motion::double_maps(piece_->cubic())),
      norms_(maps_) {}

elementary::ErrorScale PieceContext::error_scale(double margin) const {
    const motion::RationalMotion<algebra::DoubleDouble>& cubic = piece_->cubic();
    const double moving_extent =
        std::max(extent(moving_.bvh()), cubic.reference_extent) + motion::rounding_extent(cubic) + margin;
    return norms_.error_scale(moving_extent, extent(fixed_.bvh()));
}

culling::TimeTree PieceContext::time_tree(double margin, const elementary::ErrorScale& scale) const {
    // Points that meet are within the margin of each other: either body counts as larger by the margin.
    const motion::Ball moving = culling::ball_around(moving_.bvh(), margin);
    const motion::Ball fixed = culling::ball_around(fixed_.bvh(), margin);
    return {maps_, piece_->chord_deviation(moving, fixed), moving, fixed, scale, margin};
}

const motion::ControlMaps<algebra::DoubleDouble>& PieceContext::refined_maps() {
    if (!refined_maps_)
        refined_maps_ =
            std::make_unique<const motion::ControlMaps<algebra::DoubleDouble>>(motion::control_maps(piece_->cubic()));
    return *refined_maps_;
}

const motion::ControlMaps<algebra::ExactNumber>* PieceContext::exact_maps() {
    if (!exact_is_computed_)
        exact_ = piece_->exact();
    exact_is_computed_ = true;
    return exact_ ? &exact_->maps : nullptr;
}

} // namespace chasles::search
