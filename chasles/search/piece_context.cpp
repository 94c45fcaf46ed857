#include "chasles/search/piece_context.h"

#include "chasles/culling/body_ball.h"
#include "chasles/culling/interval_ends.h"

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

std::optional<motion::EnclosureBounds> bounds_of_start(const motion::AnyPiece& piece) {
    const auto start = piece.enclosure({0, 1});
    return start ? std::optional(start->bounds) : std::nullopt;
}

} // namespace

PieceContext::PieceContext(const Body& moving, const Body& fixed, std::unique_ptr<const motion::AnyPiece> piece)
    : moving_(moving), fixed_(fixed), piece_(std::move(piece)), start_(bounds_of_start(*piece_)),
      maps_(motion::double_maps(piece_->cubic())), norms_(maps_) {}

elementary::ErrorScale PieceContext::error_scale(double margin) const {
    const motion::RationalMotion<algebra::DoubleDouble>& cubic = piece_->cubic();
    const double moving_extent =
        std::max(extent(moving_.bvh()), cubic.reference_extent) + motion::rounding_extent(cubic) + margin;
    elementary::ErrorScale scale = norms_.error_scale(moving_extent, extent(fixed_.bvh()));
    if (start_) { // poses are computed with a rounding of their own
        scale.deviation = start_->rounding_of(culling::ball_around(moving_.bvh(), moving_.bvh().radius() + margin));
        scale.turn_deviation = start_->turn_rounding;
    }
    return scale;
}

culling::PieceParts PieceContext::parts(double margin) const {
    const elementary::ErrorScale scale = error_scale(margin);
    if (!is_enclosed())
        return {maps_, scale};
    return {maps_,
            scale,
            *piece_,
            {culling::ball_around(moving_.bvh(), margin), extent(moving_.bvh()) + margin, extent(fixed_.bvh())}};
}

culling::TimeTree PieceContext::time_tree(double margin, const culling::PieceParts& parts) const {
    // Points that meet are within the margin of each other: either body counts as larger by the margin.
    const motion::Ball moving = culling::ball_around(moving_.bvh(), margin);
    const motion::Ball fixed = culling::ball_around(fixed_.bvh(), margin);
    return {parts, motion::ChordDeviation(piece_->cubic(), moving, fixed), moving, fixed, margin};
}

culling::TimeInterval PieceContext::interval(double margin, const culling::TimeRange& range) const {
    return time_tree(margin, parts(margin)).interval(range);
}

double PieceContext::deviation(double margin, const culling::TimeRange& range) const {
    return interval(margin, range).deviation;
}

/// Where the maps only enclose the true motion, the pose is the true one, and the velocity that of the sweep of a part
/// about the moment. In its middle it is the true velocity up to the square of its width. The part is so short that
/// this is some 1e-10 for turns of a radian, and so long that roundings are no more.
contact::RelativeConfiguration PieceContext::configuration_at(double tau) const {
    if (!is_enclosed())
        return {moving_, fixed_, maps_, tau};
    constexpr double width = 0x1p-15;
    const double lower = std::clamp(tau - 0.5 * width, 0.0, 1 - width);
    const auto maps_of = [&](const Bracket& part) { return motion::control_maps(piece_->enclosure(part)->cubic); };
    contact::RelativeConfiguration bodies(moving_, fixed_, maps_of({tau, tau}), 0);
    bodies.take_rates({moving_, fixed_, maps_of({lower, lower + width}), (tau - lower) / width}, 1 / width);
    return bodies;
}

motion::MatrixPose PieceContext::pose_at(double tau) const {
    if (!is_enclosed())
        return contact::RelativeConfiguration(moving_, fixed_, maps_, tau).pose();
    return culling::IntervalEnds(motion::control_maps(piece_->enclosure({tau, tau})->cubic)).start;
}

std::optional<RefinedStart> PieceContext::refined_start() const {
    if (!is_enclosed() || !piece_->is_refined())
        return std::nullopt;
    const motion::Enclosure<algebra::DoubleDouble> start = *piece_->refined_enclosure({0, 0x1p-45});
    const auto maps = motion::control_maps(start.cubic);
    return RefinedStart{maps, parts(0).scale_of(start, maps)};
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
