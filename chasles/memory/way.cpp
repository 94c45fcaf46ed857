#include "chasles/memory/way.h"

#include "chasles/motion/screw_path.h"

#include <algorithm>

namespace chasles::memory {

namespace {

/// For sums of positions, of which each is off by a bound of coefficients: a matrix has nine (note 31).
constexpr double roundings_of_places = 16;

/// A bound of the distance between the places of any point of a body.
double distance(const Body& body, const motion::MatrixPose& a, const motion::MatrixPose& b) {
    return motion::distance(a, b, motion::vector_in<double>(body.bvh().centre()), body.bvh().radius());
}

} // namespace

Way way_of(const search::PieceContext& context, const culling::TimeInterval& whole, double margin) {
    Way way{culling::IntervalEnds(context.maps()), margin, whole.deviation,
            elementary::with_underflow<double>(roundings_of_places *
                                               elementary::position_error<double>(context.error_scale(margin))),
            0};
    way.travel = distance(context.moving(), way.ends.start, way.ends.end) + way.deviation + 2 * way.rounding;
    return way;
}

Arrival Travel::go_to(const Way& way) {
    const culling::IntervalEnds last = last_.value_or(culling::IntervalEnds(way.ends.start));
    const motion::MatrixPose& here = way.ends.start;
    const double gone = distance(moving_, last.start, here) + 2 * way.rounding;
    const double length = distance(moving_, last.start, last.end);
    const double share = length > 0 ? std::min(1.0, gone / length) : 0;
    const double beside = motion::distance_of_maps(
        last.at(share), here, motion::vector_in<double>(moving_.bvh().centre()), moving_.bvh().radius());
    sum_ = with_rounding(sum_ + gone);
    last_ = way.ends;
    return {share, beside + 2 * way.rounding, sum_};
}

} // namespace chasles::memory
