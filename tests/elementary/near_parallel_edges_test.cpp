// Edges at angles of 1e-17 and more: no contact is missed, and no contact is reported for edges that pass each other at
// a distance. Proofs and the bound: docs/derivations/04-edge-edge.md, "Nearly parallel edges".
#include "tests/support/elementary_cases.h"
#include "tests/support/posed_motions.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using namespace test;
using DoublePoint = Vector3<double>;

Point rational(const DoublePoint& p) {
    return test::exact(p);
}

Point in_doubles(const Point& p) {
    return rational(rounded_to<double>(p));
}

DoublePoint normalized(const DoublePoint& p) {
    return scale(p, 1 / std::sqrt(dot(p, p)));
}

/// A direction, a perpendicular direction, and the normal of both.
struct Axes {
    DoublePoint along;
    DoublePoint across;
    DoublePoint normal;

    explicit Axes(Random& random) : along(normalized(random.vector(1))) {
        across = normalized(cross(along, random.vector(1)));
        normal = cross(along, across);
    }
};

double random_angle_of_edges(Random& random) {
    return random.chance(0.2) ? 0 : random.scaled(-17, -3);
}

PlainScrew random_motion(Random& random) {
    if (random.chance(0.3))
        return {{}, {}, rational(random.vector(3))};
    const DoublePoint tangent = random.vector(random.chance(0.3) ? std::abs(random.scaled(-16, -2)) : 1);
    return {rational(random.vector(1)), rational(tangent),
            scale(rational(tangent), Rational(random.chance(0.3) ? 0.0 : random.uniform(-3, 3)))};
}

/// At `tau` the moving edge lies on the fixed edge, or crosses it anywhere, including at its ends.
EdgeEdgeCase touching_edges(Random& random, const Rational& tau) {
    const Axes axes(random);
    const DoublePoint place = random.vector(2);
    const double angle = random_angle_of_edges(random);
    const auto through = [&](double turn) {
        const double length = random.chance(0.3) ? std::abs(random.scaled(-12, 0)) : 1;
        const DoublePoint direction = scale(axes.along + scale(axes.across, turn), length);
        const double share = random.chance(0.2) ? double(random.integer(0, 1)) : random.uniform(0, 1);
        return Line{rational(place - scale(direction, share)), rational(place + scale(direction, 1 - share))};
    };
    const PlainScrew screw = random_motion(random);
    const Line at_tau = through(angle);
    return {
        screw, {in_doubles(screw.start_of(at_tau.from, tau)), in_doubles(screw.start_of(at_tau.to, tau))}, through(0)};
}

struct Tally {
    int contacts = 0;
    int doubtful = 0; ///< uncertain answers where there is no contact

    void compare(const Answer& truth, const Answer& found) {
        if (truth) {
            ++contacts;
            ASSERT_TRUE(found) << "missed";
            EXPECT_LE(found->lower, truth->upper) << "late";
        }
        if (!truth && found) {
            EXPECT_FALSE(found->certain) << "certain, but there is no contact";
            ++doubtful;
        }
    }
};

TEST(NearParallelEdges, NoContactIsMissed) {
    Random random(741);
    Tally in_double;
    Tally refined;
    const int trials = 300 * times_if_long(40);
    for (int i = 0; i < trials; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const EdgeEdgeCase posed = touching_edges(random, Rational(random.uniform(0, 1)));
        const Answer truth = posed.ask<Rational>({1e-12, 1e-60});
        in_double.compare(truth, posed.ask<double>());
        refined.compare(truth, posed.ask<DoubleDouble>());
    }
    std::cout << in_double.contacts << " contacts of " << trials
              << " up to rounding; doubtful misses: " << in_double.doubtful << " in double, " << refined.doubtful
              << " in double-double\n";
    EXPECT_GT(in_double.contacts, trials / 5);
    EXPECT_LT(in_double.contacts, trials * 9 / 10);
    EXPECT_EQ(in_double.contacts, refined.contacts);
}

/// Two edges of length one that pass over each other in parallel planes, up to the rounding of their coordinates.
EdgeEdgeCase passing_edges(Random& random, double clearance) {
    const Axes axes(random);
    const double angle = random_angle_of_edges(random);
    const DoublePoint place = random.vector(1);
    const DoublePoint direction = axes.along + scale(axes.across, angle);
    const DoublePoint above =
        place + scale(axes.normal, clearance) + scale(axes.across, -1) + scale(axes.along, random.uniform(-0.9, 0.9));
    return {{{}, {}, rational(scale(axes.across, random.uniform(1.5, 3)))},
            {rational(above), rational(above + direction)},
            {rational(place), rational(place + axes.along)}};
}

TEST(NearParallelEdges, PassingAtADistanceIsClear) {
    Random random(742);
    const int trials = 300 * times_if_long(40);
    int false_alarms = 0;
    for (int i = 0; i < trials; ++i) {
        const EdgeEdgeCase posed = passing_edges(random, random.scaled(-12.7, -1)); // from 2e-13 of lengths of about 5
        ASSERT_FALSE(posed.ask<Rational>()) << "case " << i;
        false_alarms += posed.ask<DoubleDouble>() ? 1 : 0;
    }
    EXPECT_EQ(false_alarms, 0) << "of " << trials;
}

} // namespace
} // namespace chasles::elementary
