#include "chasles/memory/orbit_filter.h"

#include "chasles/culling/body_ball.h"

#include <algorithm>

namespace chasles::memory {

namespace {

using search::PieceContext;

/// Trees are made once searches have cost about twice as much: in pairs of nodes for each face of both bodies.
constexpr double cost_of_face = 128;
/// How much dearer the next trees are after some that did not help.
constexpr double patience = 4;
/// The pairs of orbit nodes that may be tested, as a share of the cost of the dearest search. One costs about three.
constexpr double share_to_test = 0.25;

// In pairs of nodes.
constexpr double cost_of_face_pair = 4;
constexpr double cost_of_elementary_test = 20;

double cost_of(const Work& work) {
    return double(work.node_pairs) + cost_of_face_pair * double(work.face_pairs) +
           cost_of_elementary_test * double(work.elementary_tests);
}

/// Cheaper searches do not count.
constexpr double least_cost = 4096;

/// As a share of the moving body.
constexpr double most_deviation = 0x1p-12;

} // namespace

OrbitFilter::OrbitFilter(const Body& moving, const Body& fixed)
    : moving_(moving), fixed_(fixed), ball_(culling::ball_around(moving.bvh())),
      most_deviation_(most_deviation * ball_.radius),
      cost_to_pay_(cost_of_face * double(moving.face_count() + fixed.face_count())) {}

std::optional<motion::Orbit> OrbitFilter::orbit_of(const PieceContext& context) const {
    const motion::AnyPiece& piece = context.piece();
    std::optional<motion::Orbit> orbit = motion::orbit_of(piece.cubic(), most_deviation_);
    if (!orbit || !context.is_enclosed())
        return orbit;
    orbit->deviation += piece.enclosure({0, 1})->bounds.deviation_of(ball_);
    return orbit->deviation <= most_deviation_ ? orbit : std::nullopt;
}

std::optional<OrbitWay> OrbitFilter::way_of(const motion::Orbit& orbit, double margin) const {
    const OrbitWay way = way_along(orbit, *axis_, ball_, margin);
    return way.reach <= margin + 2 * most_deviation_ ? std::optional(way) : std::nullopt;
}

void OrbitFilter::learn(const PieceContext& context, const Work& work) {
    const double cost = cost_of(work);
    const auto orbit = cost >= least_cost ? orbit_of(context) : std::nullopt;
    if (!orbit)
        return;
    if (!axis_ || !way_of(*orbit, 0)) {
        axis_ = orbit;
        trees_.reset();
        cost_ = dearest_ = 0;
    }
    cost_ += cost;
    dearest_ = std::max(dearest_, cost);
}

/// It does not pay.
void OrbitFilter::give_up() {
    trees_.reset();
    cost_ = 0;
    cost_to_pay_ *= patience;
}

void OrbitFilter::make_trees() {
    if (!trees_)
        trees_ = Trees{{moving_, axis_->moving, axis_->pitch}, {fixed_, axis_->fixed, axis_->pitch}};
}

std::optional<std::span<const culling::NodePair>> OrbitFilter::pairs_worth_testing(const PieceContext& context,
                                                                                   double margin,
                                                                                   const culling::TimeRange& range,
                                                                                   Work& work) {
    if (range != culling::TimeRange() || (!trees_ && cost_ < cost_to_pay_))
        return std::nullopt;
    const auto orbit = orbit_of(context);
    const auto way = orbit ? way_of(*orbit, margin) : std::nullopt;
    if (!way)
        return std::nullopt;
    make_trees();
    pairs_ = orbit_pairs(trees_->moving, trees_->fixed, *way, std::size_t(share_to_test * dearest_), work.node_pairs);
    if (!pairs_)
        give_up();
    return pairs_;
}

} // namespace chasles::memory
