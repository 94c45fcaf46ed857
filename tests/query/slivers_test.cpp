// Slivers, faces far narrower than long, on motions that are only enclosed: pairs that a plane keeps apart are clear,
// and pairs that touch are found. Both are built backwards, from the plane or from the touch. Note 34.
#include "chasles/chasles.h"
#include "tests/query/bodies.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// An even turn about an axis with an even slide along it.
struct Twist {
    Vector3d point;
    Vector3d direction; ///< unit
    double angle;
    double slide;

    [[nodiscard]] Isometry3d at(double time) const {
        return Eigen::Translation3d(point + time * slide * direction) * Eigen::AngleAxisd(time * angle, direction) *
               Eigen::Translation3d(-point);
    }
};

/// A triangle that is carried by a twist.
struct Carried {
    Vertices corners;
    Twist twist;

    /// The least height over the plane z = 0 during the motion, by samples and ternary search around the least one.
    [[nodiscard]] double least_height(double sign) const {
        constexpr int samples = 200;
        double least = 1e9;
        for (const Vector3d& corner : corners) {
            const auto height = [&](double time) { return sign * (twist.at(time) * corner).z(); };
            int best = 0;
            for (int i = 1; i <= samples; ++i)
                best = height(double(i) / samples) < height(double(best) / samples) ? i : best;
            double lower = std::max(0.0, (best - 1.0) / samples), upper = std::min(1.0, (best + 1.0) / samples);
            least = std::min({least, height(lower), height(upper)});
            for (int i = 0; i < 90; ++i) {
                const double a = lower + (upper - lower) / 3, b = upper - (upper - lower) / 3;
                least = std::min({least, height(a), height(b)});
                (height(a) < height(b) ? upper : lower) = height(a) < height(b) ? b : a;
            }
        }
        return least;
    }
    /// Shifts the corners, so that they are shifted by `way` at half of the time.
    void shift_at_half_time(const Vector3d& way) {
        for (Vector3d& corner : corners)
            corner += twist.at(0.5).linear().transpose() * way;
    }
    [[nodiscard]] Vector3d middle_at_half_time() const {
        return twist.at(0.5) * Vector3d((corners[0] + corners[1] + corners[2]) / 3);
    }
    [[nodiscard]] Motion motion(const Isometry3d& then) const {
        const auto pose = [&](double time) {
            const Isometry3d placed = then * twist.at(time);
            return Pose(placed.translation(), Eigen::Quaterniond(placed.linear()));
        };
        return Motion::twist(pose(0), pose(1));
    }
    [[nodiscard]] Polyhedron polyhedron() const { return triangle(corners[0], corners[1], corners[2]).polyhedron(); }
};

/// A triangle of the length 1: with one short side, or with a corner near a long side.
Vertices sliver(std::mt19937& random, double width) {
    const Vector3d along = random_vector(random, 1).normalized();
    const Vector3d across = along.cross(random_vector(random, 1)).normalized();
    const double foot = uniform(random, 0, 1) < 0.6 ? 1 : uniform(random, 0.1, 0.9);
    return {Vector3d::Zero(), along, foot * along + width * across};
}

/// A sliver over the plane z = 0 and a triangle below it, each on its own twist. In half of the pairs both move along
/// the plane and stay near each other all the time.
struct PairAtAPlane {
    Carried sliver;
    Carried other;
    Motion motion_of_sliver;
    Motion motion_of_other;

    [[nodiscard]] FirstContact ask(bool sliver_moves, double margin) const {
        const auto query = [&](const Carried& moving, const Carried& fixed, const Motion& motion) {
            return first_contact({.moving = moving.polyhedron(),
                                  .fixed = fixed.polyhedron(),
                                  .motion = motion,
                                  .options = {.margin = margin}});
        };
        return sliver_moves ? query(sliver, other, relative(motion_of_sliver, motion_of_other))
                            : query(other, sliver, relative(motion_of_other, motion_of_sliver));
    }
};

PairAtAPlane pair_at_a_plane(std::mt19937& random, double width, double gap) {
    const bool along_plane = uniform(random, 0, 1) < 0.5;
    const auto twist = [&]() -> Twist {
        if (along_plane) { // nearly: a turn about its normal is decided by heights alone (note 36)
            const Vector3d tilt = std::pow(10, uniform(random, -6, -2)) * random_vector(random, 1);
            return {random_vector(random, 2), (Vector3d::UnitZ() + tilt).normalized(), uniform(random, -1.5, 1.5), 0};
        }
        return {random_vector(random, 2), random_vector(random, 1).normalized(), uniform(random, -1.5, 1.5),
                uniform(random, -0.5, 0.5)};
    };
    Carried above{sliver(random, width), twist()};
    Carried below{{random_vector(random, 0.7), random_vector(random, 0.7), random_vector(random, 0.7)}, twist()};
    const double steepness = uniform(random, 0, 1) < 0.3 ? 0 : std::pow(10, uniform(random, -6, 0));
    for (Carried* body : {&above, &below}) {
        for (Vector3d& corner : body->corners)
            corner.z() *= along_plane ? steepness : 1;
        body->shift_at_half_time(random_vector(random, 0.3) - body->middle_at_half_time());
    }
    const Eigen::Translation3d up(0, 0, gap / 2 - above.least_height(1));
    const Eigen::Translation3d down(0, 0, below.least_height(-1) - gap / 2);
    const Isometry3d world =
        Eigen::Translation3d(random_vector(random, 1)) * Eigen::AngleAxisd(2, random_vector(random, 1).normalized());
    const Motion motion_above = above.motion(world * up), motion_below = below.motion(world * down);
    return {above, below, motion_above, motion_below};
}

int pairs_at_planes() {
    return std::getenv("CHASLES_LONG") != nullptr ? 20'000 : 150;
}

/// Each pair is asked about in both roles. Pairs whose surfaces are told apart by signs alone do not count as hits.
void expect_all_clear(unsigned seed, double margin_per_gap, double least_hits) {
    std::mt19937 random(seed);
    const int pairs = pairs_at_planes();
    int hits = 0;
    for (int i = 0; i < pairs; ++i) {
        const double width = std::pow(10, uniform(random, -12, -4)), gap = std::pow(10, uniform(random, -9, -1));
        const PairAtAPlane pair = pair_at_a_plane(random, width, gap);
        for (const bool sliver_moves : {true, false}) {
            const FirstContact found = pair.ask(sliver_moves, margin_per_gap * gap);
            EXPECT_EQ(found.verdict, Verdict::clear)
                << "seed " << seed << ", pair " << i << ", width " << width << ", gap " << gap << ", sliver "
                << (sliver_moves ? "moves" : "is fixed") << ", at " << found.time.lower;
            hits += sliver_moves && found.work.root_brackets > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(hits, least_hits * pairs);
}

TEST(Slivers, ThatAPlaneKeepsApartAreClear) {
    expect_all_clear(4101, 0, 0.05);
}

TEST(Slivers, ThatAPlaneKeepsBeyondTheMarginAreClear) {
    expect_all_clear(4102, 0.5, 0.05);
}

/// The least distance of such a pair is the gap or more, never 0.
TEST(Slivers, ThatAPlaneKeepsApartHaveADistance) {
    std::mt19937 random(4103);
    for (int i = 0; i < 40; ++i) {
        const double gap = std::pow(10, uniform(random, -6, -1));
        const PairAtAPlane pair = pair_at_a_plane(random, 1e-8, gap);
        const LeastDistance found = least_distance({.moving = pair.sliver.polyhedron(),
                                                    .fixed = pair.other.polyhedron(),
                                                    .motion = relative(pair.motion_of_sliver, pair.motion_of_other)});
        EXPECT_GT(found.distance.lower, 0.999 * gap) << "pair " << i;
        EXPECT_TRUE(found.certain || gap < 1e-4) << "pair " << i << ", gap " << gap;
    }
}

/// A corner of the triangle is on the sliver at a time between 0 and 1, and moves through it.
TEST(Slivers, ThatTouchAreFound) {
    std::mt19937 random(4104);
    int certain = 0;
    constexpr int pairs = 400;
    for (int i = 0; i < pairs; ++i) {
        const double width = std::pow(10, uniform(random, -9, -4)), time = uniform(random, 0.1, 0.9);
        const auto twist = [&]() -> Twist {
            return {random_vector(random, 2), random_vector(random, 1).normalized(), uniform(random, -1.5, 1.5),
                    uniform(random, -0.5, 0.5)};
        };
        const Carried thin{sliver(random, width), twist()};
        Carried other{{random_vector(random, 0.7), random_vector(random, 0.7), random_vector(random, 0.7)}, twist()};
        const double b = uniform(random, 0.2, 0.5), c = uniform(random, 0.2, 0.4);
        const Vector3d touch = (1 - b - c) * thin.corners[0] + b * thin.corners[1] + c * thin.corners[2];
        const Vector3d shift = other.twist.at(time).inverse() * (thin.twist.at(time) * touch) - other.corners[0];
        for (Vector3d& corner : other.corners)
            corner += shift;
        const Isometry3d world = Isometry3d::Identity();
        const PairAtAPlane pair{thin, other, thin.motion(world), other.motion(world)};
        for (const bool sliver_moves : {true, false}) {
            const FirstContact found = pair.ask(sliver_moves, 0);
            ASSERT_NE(found.verdict, Verdict::clear) << "pair " << i << ", width " << width << ", time " << time;
            EXPECT_LE(found.time.lower, time + 1e-9) << "pair " << i; // the touch is rounded
            certain += found.certain ? 1 : 0;
        }
    }
    EXPECT_GT(certain, 2 * pairs * 0.95);
}

} // namespace
} // namespace chasles::test
