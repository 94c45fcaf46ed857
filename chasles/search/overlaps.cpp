#include "chasles/search/overlaps.h"

namespace chasles::search {

std::optional<Overlap> refined(const Overlap& overlap, FeatureTests<algebra::DoubleDouble>& tests,
                               const motion::RationalMotion<algebra::DoubleDouble>& cubic) {
    const auto passage = tests.passage(overlap, elementary::Ends::not_proven_on_one_side);
    if (!passage)
        return std::nullopt;
    Vector3<algebra::DoubleDouble> point = passage->point;
    if (!overlap.edge_is_moving)
        point = cubic.orientation * point + cubic.origin;
    Overlap result = overlap;
    result.point = {double(point.x), double(point.y), double(point.z)};
    const auto proven = tests.passage(overlap, elementary::Ends::proven_opposite);
    result.certain = proven && proven->certain;
    return result;
}

} // namespace chasles::search
