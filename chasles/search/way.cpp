#include "chasles/search/way.h"

#include "chasles/motion/screw_path.h"

#include <algorithm>

namespace chasles::search {

namespace {

/// For sums of positions, of which each is off by a bound of coefficients: a matrix has nine (note 31).
constexpr double roundings_of_places = 16;

/// A bound of the distance between the places of any point of a body on two maps that need not be rotations. The
/// spectral norm of a matrix is at most its Frobenius norm.
double distance_of_maps(const Body& body, const motion::MatrixPose& a, const motion::MatrixPose& b) {
    const algebra::Vector3<double> centre = motion::vector_in<double>(body.bvh().centre());
    double squares = 0;
    for (int i = 0; i < 3; ++i) {
        const algebra::Vector3<double> row = a.rotation.row[i] - b.rotation.row[i];
        squares += dot(row, row);
    }
    return length(a(centre) - b(centre)) + std::sqrt(squares) * body.bvh().radius();
}

/// Likewise for rotations.
double distance_of_poses(const Body& body, const motion::MatrixPose& a, const motion::MatrixPose& b) {
    return motion::distance(a, b, motion::vector_in<double>(body.bvh().centre()), body.bvh().radius());
}

} // namespace

Way way_of(const PieceContext& context, const culling::TimeInterval& whole, double margin) {
    Way way{culling::IntervalEnds(context.maps()), margin, whole.deviation,
            elementary::with_underflow<double>(roundings_of_places *
                                               elementary::position_error<double>(context.parts(margin).scale())),
            0};
    way.travel = distance_of_poses(context.moving(), way.ends.start, way.ends.end) + way.deviation + 2 * way.rounding;
    return way;
}

Arrival Travel::go_to(const Way& way) {
    const double gone = distance_of_poses(moving_, last_.start, way.ends.start) + 2 * way.rounding;
    const double length = distance_of_poses(moving_, last_.start, last_.end);
    Arrival arrival;
    arrival.share = length > 0 ? std::min(1.0, gone / length) : 0;
    arrival.beside = distance_of_maps(moving_, last_.at(arrival.share), way.ends.start) + 2 * way.rounding;
    arrival.from_end = distance_of_poses(moving_, last_.end, way.ends.start) + 2 * way.rounding;
    sum_ = with_rounding(sum_ + gone);
    arrival.travelled = sum_;
    last_ = way.ends;
    return arrival;
}

} // namespace chasles::search
