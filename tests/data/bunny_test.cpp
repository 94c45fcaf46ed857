// A large pair: two scans of 69,451 triangles each, half a body length and 20 degrees into contact.
// Times are printed, not asserted: the benchmarks compare them.

#include "tests/data/shared_data.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace chasles::test {
namespace {

constexpr double body_length = 0.155;

/// A motion from beside the fixed copy towards it, with a turn about the body's middle.
Motion approach(int direction) {
    const Eigen::Vector3d middle(-0.0168, 0.11, -0.0015);
    const double heading = 1.1 * direction;
    const Eigen::Vector3d away = Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.2).normalized();
    Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
    start.translation() = 1.02 * body_length * away;
    Eigen::Isometry3d goal = Eigen::Isometry3d::Identity();
    goal.linear() = Eigen::AngleAxisd(std::numbers::pi / 9, Eigen::Vector3d(0.3, 1, 0.4).normalized()).matrix();
    goal.translation() = middle - goal.linear() * middle + 0.52 * body_length * away;
    return ScrewMotion::between(start, goal);
}

TEST(Bunny, LargePairComesIntoContactAndGoesBackClearOfIt) {
    CHASLES_REQUIRE_DATA("meshes/stanford-bunny.obj");
    const Stopwatch loading;
    const Polyhedron bunny = Polyhedron::load(shared_data("meshes/stanford-bunny.obj"));
    const double load_seconds = loading.seconds();
    const double bytes = double(bunny.memory()) / double(bunny.face_count());
    EXPECT_EQ(bunny.face_count(), 69451u);
    EXPECT_LT(bytes, 200);
    double slowest = 0;
    int contacts = 0;
    for (int direction = 0; direction < 6; ++direction) {
        const Motion motion = approach(direction);
        const Stopwatch watch;
        const FirstContact found = first_contact({.moving = bunny, .fixed = bunny, .motion = motion});
        slowest = std::max(slowest, watch.seconds());
        contacts += found.verdict == Verdict::contact ? 1 : 0;
        if (found.verdict != Verdict::contact)
            continue;
        EXPECT_TRUE(found.certain);
        EXPECT_LE(found.time.upper - found.time.lower, 1e-12);
    }
    EXPECT_GE(contacts, 4);
    print_figures("bunny pair, 2 x 69,451 triangles: loaded with hierarchy in %.2f s, %.0f bytes a triangle beyond the "
                  "vertices; %d of 6 motions touch, slowest first contact %.2f ms",
                  load_seconds, bytes, contacts, 1e3 * slowest);
}

} // namespace
} // namespace chasles::test
