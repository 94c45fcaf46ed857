// A motion that the library does not know goes through the whole search: its pieces are enclosed by cubic motions. The
// answer is proven for the true motion, however long the pieces are.
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/support/even_turn_motion.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

FirstContact ask(const Polyhedron& moving, const Polyhedron& fixed, const EvenTurnMotion& trajectory,
                 const QueryOptions& options = {}) {
    return first_contact({.moving = moving, .fixed = fixed, .motion = motion_of(trajectory), .options = options});
}

/// Never late, and at the time of the answer the true surfaces are within the margin.
void expect_never_late_nor_early(const FirstContact& found, const Polyhedron& moving, const Polyhedron& fixed,
                                 const EvenTurnMotion& trajectory, double margin, int samples) {
    const double until = found.verdict == Verdict::clear ? 1 : found.time.lower;
    EXPECT_EQ(found.clear_until, until);
    for (int i = 0; i <= samples; ++i)
        if (const double time = double(i) / samples; time < until) {
            ASSERT_GT(distance_at(moving, fixed, trajectory.pose_at(time)), margin)
                << "time " << time << ", but said to be clear until " << until;
        }
    if (found.verdict == Verdict::clear)
        return;
    EXPECT_TRUE(found.certain);
    EXPECT_LE(distance_at(moving, fixed, trajectory.pose_at(found.time.lower)), margin + 1e-9);
}

/// A bar of half width 0.1 turns about its middle towards the corner of a post, which is at 1.5 from the middle.
struct BarAndPost {
    static constexpr double half_width = 0.1;
    static constexpr double turn = 1.2;
    static constexpr double place = 0.8; ///< of the corner: angle from the bar's first direction
    static constexpr double arm = 1.5;

    Polyhedron bar = box({2, half_width, half_width}).polyhedron();
    Polyhedron post = [] {
        test::Body body = box({0.3, 0.3, 1});
        const Eigen::AngleAxisd diamond(place + std::numbers::pi / 4, Eigen::Vector3d::UnitZ());
        const Eigen::AngleAxisd to_corner(place, Eigen::Vector3d::UnitZ());
        const Eigen::Vector3d middle = to_corner * Eigen::Vector3d(arm, 0.3 * std::numbers::sqrt2, 0);
        for (Eigen::Vector3d& vertex : body.vertices)
            vertex = diamond * vertex + middle;
        return body.polyhedron();
    }();
    EvenTurn motion{Pose(), turned({0, 0, 0}, {0, 0, 1}, turn)};
    double contact = (place - std::asin(half_width / arm)) / turn;

    [[nodiscard]] EvenTurnMotion in_pieces(const std::vector<double>& ends) const { return {motion, ends}; }
};

/// `count` pieces, each longer than the one before by a fifth.
std::vector<double> growing_pieces(int count) {
    std::vector<double> ends;
    double length = 1, sum = 0;
    for (int i = 0; i < count; ++i, length *= 1.2)
        ends.push_back(sum += length);
    for (double& end : ends)
        end /= sum;
    ends.back() = 1;
    return ends;
}

/// Poses are known in double only, so the bracket is as wide as their rounding makes it.
TEST(ThirdMotion, ABarMeetsACornerAtTheTimeOfTheClosedForm) {
    const BarAndPost scene;
    for (const int count : {1, 2, 5, 20}) {
        const EvenTurnMotion trajectory = scene.in_pieces(growing_pieces(count));
        const FirstContact found = ask(scene.bar, scene.post, trajectory);
        ASSERT_EQ(found.verdict, Verdict::contact) << count << " pieces";
        EXPECT_LE(found.time.lower, scene.contact + 1e-15);
        EXPECT_GE(found.time.upper, scene.contact - 1e-15);
        EXPECT_LE(found.time.upper - found.time.lower, 1e-11);
        EXPECT_TRUE(found.certain);
        EXPECT_EQ(found.clear_until, found.time.lower);
        EXPECT_TRUE(found.pose.isometry().isApprox(scene.motion.at(found.time.lower).isometry(), 1e-12));
        expect_never_late_nor_early(found, scene.bar, scene.post, trajectory, 0, 400);
    }
}

TEST(ThirdMotion, AClearMissIsClearAndCertain) {
    const BarAndPost scene;
    const EvenTurn motion{shifted(0, 0, 1.5), turned({0, 0, 1.5}, {0, 0, 1}, BarAndPost::turn)};
    const EvenTurnMotion trajectory(motion, growing_pieces(12));
    const FirstContact found = ask(scene.bar, scene.post, trajectory);
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(found.clear_until, 1);
    EXPECT_TRUE(found.pose.isometry().isApprox(motion.goal.isometry(), 1e-12));
}

TEST(ThirdMotion, FarApartIsToldWithoutASearch) {
    const BarAndPost scene;
    const EvenTurn motion{shifted(100, 0, 0), turned({100, 20, 0}, {0, 0, 1}, 3)};
    const FirstContact found = ask(scene.bar, scene.post, EvenTurnMotion(motion, {0.3, 1}));
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_EQ(found.work.node_pairs, 0U);
}

TEST(ThirdMotion, BodiesThatOverlapAtTheStartAreInContactThere) {
    const BarAndPost scene;
    const EvenTurn motion{turned({0, 0, 0}, {0, 0, 1}, BarAndPost::place), turned({0, 0, 0}, {0, 0, 1}, 2)};
    const FirstContact found = ask(scene.bar, scene.post, EvenTurnMotion(motion, {0.1, 0.4, 1}));
    EXPECT_EQ(found.verdict, Verdict::contact_at_start);
    EXPECT_EQ(found.clear_until, 0);
    EXPECT_TRUE(found.certain);
}

TEST(ThirdMotion, RandomBodiesAreNeverLateInPiecesOfAnyLength) {
    std::mt19937 random(801);
    int contacts = 0, clear = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const Polyhedron moving = random_octahedron(random).polyhedron();
        const Polyhedron fixed = random_octahedron(random).polyhedron();
        const EvenTurn motion{random_pose(random, 3, 3), random_pose(random, 3, 3)};
        const auto pieces = static_cast<std::size_t>(4 + trial % 30);
        std::vector<double> ends(pieces);
        for (double& end : ends)
            end = uniform(random, 0.01, 0.99);
        ends.back() = 1;
        std::ranges::sort(ends);
        const EvenTurnMotion trajectory(motion, ends);
        const double margin = trial % 3 == 0 ? 0.1 : 0;
        const FirstContact found = ask(moving, fixed, trajectory, {.margin = margin});
        (found.verdict == Verdict::clear ? clear : contacts) += 1;
        SCOPED_TRACE("trial " + std::to_string(trial));
        if (found.verdict != Verdict::contact_at_start)
            expect_never_late_nor_early(found, moving, fixed, trajectory, margin, 200);
    }
    std::cout << contacts << " contacts, " << clear << " clear\n";
    EXPECT_GT(contacts, 10);
    EXPECT_GT(clear, 10);
}

/// A contact just after the joint of two pieces.
TEST(ThirdMotion, ALongPieceAfterShortOnesMissesNoContact) {
    const BarAndPost scene;
    for (const double before : {0.05, 0.02, 0.005}) {
        const double joint = scene.contact - before;
        std::vector<double> ends;
        for (int i = 1; i <= 60; ++i)
            ends.push_back(joint * i / 60);
        ends.push_back(1);
        const FirstContact found = ask(scene.bar, scene.post, scene.in_pieces(ends));
        ASSERT_EQ(found.verdict, Verdict::contact) << "joint " << before << " before the contact";
        EXPECT_LE(found.time.lower, scene.contact);
    }
}

} // namespace
} // namespace chasles::test
