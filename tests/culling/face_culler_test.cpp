// The last culling stage, against dense sampling. Culled faces never meet in the window. A corner that is reported to
// stay off the other plane never reaches this plane.
#include "chasles/culling/face_culler.h"

#include "chasles/motion/any_trajectory.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"
#include "tests/support/surface_distance.h"

#include <gtest/gtest.h>

namespace chasles::culling {
namespace {

using namespace test;
using Corners = Triangle3<double>;

Corners random_corners(Random& random, double reach) {
    return {random_point(random, reach), random_point(random, reach), random_point(random, reach)};
}
Polyhedron body_of(const Corners& corners) {
    return triangle(corners[0], corners[1], corners[2]).polyhedron();
}

/// Two triangles and one sweep.
struct Scene {
    Corners moving;
    Corners fixed;
    std::unique_ptr<const motion::AnyPiece> piece;
    motion::ControlMaps<double> maps = motion::double_maps(piece->cubic());
    Polyhedron moving_body = body_of(moving);
    Polyhedron fixed_body = body_of(fixed);

    Scene(const Corners& mover, const Corners& target, const Motion& motion)
        : moving(mover), fixed(target), piece(motion.trajectory().pieces()->at(0)) {}

    /// The answer of a new culler.
    [[nodiscard]] std::optional<TimeRange> part_of(const FacePair& pair, double best, double margin) const {
        FaceCuller culler(moving_body.body(), fixed_body.body(), {maps, elementary::error_scale(maps, 10, 10)}, margin);
        const auto faces = culler.cull(pair, best);
        return faces ? std::optional(faces->part) : std::nullopt;
    }
    [[nodiscard]] Corners moving_at(double tau) const {
        const Eigen::Isometry3d placement = piece->pose_at(tau).isometry();
        return {placement * moving[0], placement * moving[1], placement * moving[2]};
    }
    [[nodiscard]] double distance(double tau) const {
        return std::sqrt(squared_distance_of_triangles<double>(moving_at(tau), fixed));
    }
};

Scene random_scene(Random& random, double reach) {
    const Pose start = random_pose(random, 2);
    return {random_corners(random, reach), random_corners(random, reach),
            Motion::sweep(start, random_goal(random, start, random.uniform(0, 1), 1))};
}

/// Cullers that have met few faces do without chords.
constexpr double never_used = 0;

/// A dyadic interval and a window in it.
FacePair random_pair(Random& random) {
    const double width = std::ldexp(1.0, -random.integer(0, 6));
    const double lower = width * random.integer(0, int(1 / width) - 1);
    const auto first = static_cast<float>(random.uniform(0, 1));
    const auto last = static_cast<float>(random.uniform(double(first), 1));
    return {0, 0, {lower, lower + width}, {first, last}, lower, never_used};
}

TEST(FaceCuller, PairsThatItCullsDoNotMeetInTheWindow) {
    Random random(831);
    int culled = 0, meeting = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Scene scene = random_scene(random, 1.5);
        const FacePair pair = random_pair(random);
        const double margin = trial % 3 == 0 ? 0.2 : 0;
        const bool is_culled = !scene.part_of(pair, 1, margin);
        culled += is_culled ? 1 : 0;
        bool meets = false;
        for (int i = 0; i <= 20; ++i) {
            const double share = double(pair.when.lower) + (pair.when.upper - pair.when.lower) * i / 20.0;
            meets = meets || scene.distance(pair.interval.at(share)) <= margin;
        }
        meeting += meets ? 1 : 0;
        EXPECT_FALSE(is_culled && meets) << "trial " << trial;
    }
    std::cout << culled << " culled, " << meeting << " meet\n";
    EXPECT_GT(culled, 500);
    EXPECT_GT(meeting, 150);
}

/// Pairs that touch at a known time, with nothing to spare: one corner lies in the other triangle, or two edges cross.
TEST(FaceCuller, PairsThatTouchAreNeverCulled) {
    Random random(832);
    for (int trial = 0; trial < 3000; ++trial) {
        const Pose start = random_pose(random, 2);
        const Motion motion = Motion::sweep(start, random_goal(random, start, random.uniform(0, 1), 1));
        const FacePair pair = random_pair(random);
        const double touching =
            pair.interval.at(double(pair.when.lower) + random.uniform(0, 1) * (pair.when.upper - pair.when.lower));
        const Corners moving = random_corners(random, 1);
        const Eigen::Isometry3d placement = motion.pose_at(touching).isometry();
        const Eigen::Vector3d point = placement * (trial % 2 == 0 ? moving[0] : (moving[0] + moving[1]) / 2);
        const Eigen::Vector3d along = random_point(random, 1);
        const Eigen::Vector3d across = random_point(random, 1);
        const Corners fixed = trial % 2 == 0 ? Corners{point - along - across, point + along, point + across}
                                             : Corners{point - along, point + along, point + across};
        const Scene scene(moving, fixed, motion);
        EXPECT_TRUE(scene.part_of(pair, 1, 0)) << "trial " << trial;
        EXPECT_TRUE(scene.part_of(pair, 1, 0.1)) << "trial " << trial;
        EXPECT_TRUE(scene.part_of(pair, touching, 0)) << "trial " << trial << ": up to the contact";
    }
}

TEST(FaceCuller, ThePartHoldsTheWindowUpToBest) {
    Random random(833);
    int found = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const Scene scene = random_scene(random, 3);
        const FacePair pair = random_pair(random);
        const double first = pair.interval.at(pair.when.lower);
        const double best = random.uniform(first, 1);
        const auto part = scene.part_of(pair, best, 0);
        if (!part)
            continue;
        ++found;
        EXPECT_LE(part->lower, first);
        EXPECT_GE(part->upper, std::min(best, pair.interval.at(pair.when.upper)));
        EXPECT_GE(part->lower, pair.interval.lower);
        EXPECT_LE(part->upper, pair.interval.upper);
    }
    EXPECT_GT(found, 100);
}

/// One triangle falls straight through the plane of another, beside it at first: only then do its corners meet the
/// plane.
TEST(FaceCuller, CullsUpToBestWhatMeetsOnlyLater) {
    const Corners small{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0.1), Eigen::Vector3d(0, 1, 0.1)};
    const Corners large{Eigen::Vector3d(-5, -5, 0), Eigen::Vector3d(5, -5, 0), Eigen::Vector3d(0, 5, 0)};
    const Scene scene(small, large, Motion::sweep(shifted(0, 0, 1), shifted(0, 0, -0.5)));
    const FacePair whole{0, 0, {}, {}, 0, never_used};
    EXPECT_TRUE(scene.part_of(whole, 1, 0));
    EXPECT_FALSE(scene.part_of(whole, 0.45, 0));
    EXPECT_TRUE(scene.part_of(whole, 0.45, 0.3)) << "within the margin before";
}

TEST(FaceCuller, SaysWhichCornersMayReachTheOtherPlane) {
    const Corners small{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 5), Eigen::Vector3d(0, 1, 5)};
    const Corners large{Eigen::Vector3d(-5, -5, 0), Eigen::Vector3d(5, -5, 0), Eigen::Vector3d(0, 5, 0)};
    const Scene scene(small, large, Motion::sweep(shifted(0, 0, 1), shifted(0, 0, -1)));
    FaceCuller culler(scene.moving_body.body(), scene.fixed_body.body(),
                      {scene.maps, elementary::error_scale(scene.maps, 10, 10)}, 0);
    const auto faces = culler.cull({0, 0, {}, {}, 0, never_used}, 1);
    ASSERT_TRUE(faces);
    EXPECT_TRUE(faces->moving.may_meet(0U));
    EXPECT_FALSE(faces->moving.may_meet(1U));
    EXPECT_FALSE(faces->moving.may_meet(2U));
    EXPECT_TRUE(faces->moving.may_meet(Edge{0, 1}));
    EXPECT_FALSE(faces->moving.may_meet(Edge{1, 2})) << "both ends stay above";
}

/// A culler keeps the planes of the last interval. They must not be used for the next interval.
TEST(FaceCuller, OneCullerAnswersLikeANewOne) {
    Random random(834);
    int culled = 0, open = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Scene scene = random_scene(random, 2);
        FaceCuller culler(scene.moving_body.body(), scene.fixed_body.body(),
                          {scene.maps, elementary::error_scale(scene.maps, 10, 10)}, 0);
        for (int i = 0; i < 10; ++i) {
            const FacePair pair = random_pair(random);
            const auto faces = culler.cull(pair, 1);
            EXPECT_EQ(faces.has_value(), scene.part_of(pair, 1, 0).has_value());
            (faces ? open : culled) += 1;
        }
    }
    EXPECT_GT(culled, 50);
    EXPECT_GT(open, 50);
}

} // namespace
} // namespace chasles::culling
