#include "chasles/search/descent.h"

#include "chasles/base/limit_of_thread.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <limits>

namespace chasles::search {

namespace {

using contact::FeaturePair;

contact::RelativeConfiguration bodies_at(const PieceContext& context, double tau) {
    return context.configuration_at(tau);
}

/// How two features approach each other over the piece.
class Approach {
public:
    Approach(const PieceContext& context, const FeaturePair& features) : context_(context), features_(features) {}

    /// The tau with the least distance among those asked for.
    [[nodiscard]] double best() const { return best_; }
    [[nodiscard]] double least() const { return least_; }

    [[nodiscard]] double distance_at(double tau) {
        return nearest_.points(bodies_at(context_, tau), features_).distance;
    }
    /// Half the rate of the square of the distance. For bodies that pass each other it is nearly linear in tau.
    double rate_at(double tau) {
        const contact::RelativeConfiguration bodies = bodies_at(context_, tau);
        const NearPoints points = nearest_.points(bodies, features_);
        if (points.distance < least_) {
            least_ = points.distance;
            best_ = tau;
        }
        return points.apart().dot(bodies.velocity_at(points.on_moving));
    }

private:
    const PieceContext& context_;
    const FeaturePair& features_;
    NearestAtRest nearest_;
    double best_ = 0;
    double least_ = std::numeric_limits<double>::infinity();
};

/// The ends are in order and the rates at them have different signs, so that the solver reports no error. A policy that
/// could report one would bring streams and locales into every program.
using NoErrors =
    boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;

/// Where the rate is 0 between two tau with rates of different signs.
Bracket zero_between(Approach& approach, const Bracket& taus, double rate_at_lower, double rate_at_upper, int bits,
                     std::uintmax_t most) {
    const auto rate_at = [&](double time) { return approach.rate_at(time); };
    const auto [lower, upper] =
        boost::math::tools::toms748_solve(rate_at, taus.lower, taus.upper, rate_at_lower, rate_at_upper,
                                          boost::math::tools::eps_tolerance<double>(bits), most, NoErrors());
    return {lower, upper};
}

/// Goes downhill from `tau` in growing steps until the distance grows, then to the minimum in the last step.
void descend(Approach& approach, double tau) {
    constexpr int bits = 40;
    double rate = approach.rate_at(tau);
    double step = rate < 0 ? 0x1p-8 : -0x1p-8;
    const double end = rate < 0 ? 1 : 0;
    while (rate * step < 0 && tau != end) {
        const double next = std::clamp(tau + step, 0.0, 1.0);
        const double next_rate = approach.rate_at(next);
        if (next_rate * step > 0) {
            constexpr std::uintmax_t most = 20;
            zero_between(approach, {std::min(tau, next), std::max(tau, next)}, step > 0 ? rate : next_rate,
                         step > 0 ? next_rate : rate, bits, most);
            return;
        }
        tau = next;
        rate = next_rate;
        step *= 4;
    }
}

} // namespace

std::optional<NearMoment> nearest_of_samples(const PieceContext& context, double bound, Work& work) {
    constexpr double rough = 0.9; // a descent follows
    std::optional<NearMoment> nearest;
    for (const double tau : {0.5, 0.0, 1.0})
        if (const auto found = nearest_features(bodies_at(context, tau), {bound, rough}, work)) {
            nearest = NearMoment{tau, *found};
            bound = found->distance;
        }
    return nearest;
}

NearMoment local_minimum(const PieceContext& context, double tau, const FeaturePair& features, Work& work) {
    constexpr int most_rounds = 64;
    NearMoment best{tau, {features, 0}};
    for (int round = 0; round < most_rounds; ++round) {
        Approach approach(context, best.near.features);
        descend(approach, best.tau);
        best.tau = approach.best();
        best.near.distance = approach.least();
        if (is_cancelled())
            break;
        const auto nearer = nearest_features(bodies_at(context, best.tau), {best.near.distance, 1}, work);
        if (!nearer)
            break;
        best.near = *nearer;
    }
    return best;
}

NearMoment minimum_between(const PieceContext& context, const FeaturePair& features, const Bracket& taus) {
    constexpr int bits = 50;
    constexpr std::uintmax_t most = 60;
    Approach approach(context, features);
    const double at_lower = approach.rate_at(taus.lower), at_upper = approach.rate_at(taus.upper);
    double tau = approach.best(); // the nearer end
    if (at_lower < 0 && at_upper > 0) {
        const Bracket zero = zero_between(approach, taus, at_lower, at_upper, bits, most);
        tau = 0.5 * (zero.lower + zero.upper);
    }
    return {tau, {features, approach.distance_at(tau)}};
}

} // namespace chasles::search
