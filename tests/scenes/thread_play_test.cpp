// The clearance of the nut on its thread, computed without collision code: by projection of facets and by sampled
// poses.
#include "chasles/motion/motion.h"
#include "scenes/nut_motions.h"
#include "scenes/threaded_fastener.h"
#include "tests/scenes/axial_way.h"
#include "tests/scenes/exact_crossing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace chasles::scenes {
namespace {

using std::numbers::pi;

bool do_cross(const std::vector<Corners>& moving, const std::vector<Corners>& fixed) {
    bool found = false;
    for_near_pairs(moving, fixed, 0, [&](const Corners& a, const Corners& b) { found = found || cross(a, b); });
    return found;
}

const ThreadedFastener coarse{.bolt_length = 12, .nut_height = 6.5, .segments = 24};

TEST(ThreadPlay, InPhaseTheWayAlongTheAxisIsTheAxialClearanceWhateverTheFacets) {
    for (const int segments : {24, 31, 48}) {
        ThreadedFastener size = coarse;
        size.segments = segments;
        const auto fixed = placed(bolt(size), {});
        for (const int facets : {0, 5}) {
            const Pose pose = nut_pose({.height = 4}, static_cast<double>(facets) / segments);
            EXPECT_NEAR(way_to_contact(placed(nut(size), pose), fixed), axial_clearance(size), 1e-12);
        }
    }
}

// The bound is nearly reached in between, so it is nearly tight.
TEST(ThreadPlay, OutOfPhaseTheFacetsTakeAtMostTheirBound) {
    const auto fixed = placed(bolt(coarse), {});
    const Polyhedron ring = nut(coarse);
    double least = axial_clearance(coarse);
    for (double facets = 0.05; facets < 1; facets += 0.09) {
        const double way = way_to_contact(placed(ring, nut_pose({.height = 4}, facets / coarse.segments)), fixed);
        EXPECT_GE(way, axial_clearance(coarse) - axial_facet_error(coarse));
        least = std::min(least, way);
    }
    EXPECT_LE(least, axial_clearance(coarse) - 0.8 * axial_facet_error(coarse));
}

TEST(ThreadPlay, SampledPosesOfTheUnscrewingDoNotCross) {
    std::mt19937 random(20000428);
    const auto fixed = placed(bolt(coarse), {});
    const Polyhedron ring = nut(coarse);
    const std::vector<Pose> poses = nut_path({.height = 4, .turns = 4});
    for (std::size_t step = 0; step + 1 < poses.size(); ++step) {
        for (const ScrewMotion& piece : ScrewMotion::between(poses[step], poses[step + 1]).cut(pi / 18)) {
            const double time = std::uniform_real_distribution<double>()(random);
            ASSERT_FALSE(do_cross(placed(ring, piece.pose_at(time)), fixed)) << "step " << step << " time " << time;
        }
    }
}

// The sampling detects a crossing as soon as the nut exceeds its clearance.
TEST(ThreadPlay, PosesOutsideOfThePlayCross) {
    const auto fixed = placed(bolt(coarse), {});
    const Polyhedron ring = nut(coarse);
    const double play = axial_clearance(coarse);
    for (const double turns : {0.0, 0.37, 1.21}) {
        for (const double side : {-1.0, 1.0}) {
            const Pose pose = nut_pose({.height = 4 + side * 1.02 * play}, turns);
            EXPECT_TRUE(do_cross(placed(ring, pose), fixed)) << turns << ' ' << side;
        }
    }
}

} // namespace
} // namespace chasles::scenes
