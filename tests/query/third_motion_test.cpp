// A motion that the library does not know goes through the whole search: each of its pieces deviates from a cubic
// motion by a stated length. The answer is early by what this deviation costs, and never late.
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/support/constant_velocity.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

FirstContact ask(const Polyhedron& moving, const Polyhedron& fixed, const ConstantVelocity& trajectory,
                 const QueryOptions& options = {}) {
    return first_contact({.moving = moving, .fixed = fixed, .motion = motion_of(trajectory), .options = options});
}

/// Never late, and no earlier than the deviation of the piece explains: there the true surfaces are within the margin
/// and two deviations.
void expect_never_late_and_little_early(const FirstContact& found, const Polyhedron& moving, const Polyhedron& fixed,
                                        const ConstantVelocity& trajectory, double margin, int samples) {
    const double until = found.verdict == Verdict::clear ? 1 : found.time.lower;
    EXPECT_EQ(found.clear_until, until);
    for (int i = 0; i <= samples; ++i)
        if (const double time = double(i) / samples; time < until) {
            ASSERT_GT(distance_at(moving, fixed, trajectory.pose_at(time)), margin)
                << "time " << time << ", but said to be clear until " << until;
        }
    if (found.verdict == Verdict::clear)
        return;
    // Where the answer is the joint of two pieces, the later one found it.
    const double deviation = trajectory.piece_of(found.time.upper).deviation();
    EXPECT_LE(distance_at(moving, fixed, trajectory.pose_at(found.time.lower)), margin + 2 * deviation + 1e-9);
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

    [[nodiscard]] ConstantVelocity in_pieces(const std::vector<double>& ends) const { return {motion, ends, 2.01}; }
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

TEST(ThirdMotion, ABarMeetsACornerNeverLateAndEarlyByTheDeviation) {
    const BarAndPost scene;
    for (const int count : {1, 2, 5, 20}) {
        const ConstantVelocity trajectory = scene.in_pieces(growing_pieces(count));
        const FirstContact found = ask(scene.bar, scene.post, trajectory);
        ASSERT_EQ(found.verdict, Verdict::contact) << count << " pieces";
        EXPECT_LE(found.time.lower, scene.contact);
        const double deviation = trajectory.piece_of(found.time.lower).deviation();
        const double speed =
            BarAndPost::arm * BarAndPost::turn * std::cos(BarAndPost::place - BarAndPost::turn * scene.contact);
        // The bar comes nearer at no less than half of this speed.
        EXPECT_GE(found.time.lower, scene.contact - 2 * deviation / (0.5 * speed)) << count << " pieces";
        EXPECT_FALSE(found.certain);
        EXPECT_EQ(found.clear_until, found.time.lower);
        EXPECT_LE(found.time.upper - found.time.lower, 1.1e-12);
        EXPECT_TRUE(found.pose.isometry().isApprox(scene.motion.at(found.time.lower).isometry(), 1e-12));
        expect_never_late_and_little_early(found, scene.bar, scene.post, trajectory, 0, 400);
    }
}

TEST(ThirdMotion, ShorterPiecesTellTheTimeBetter) {
    const BarAndPost scene;
    double before = 1;
    for (const int count : {4, 8, 16, 32}) {
        std::vector<double> even;
        for (int i = 1; i <= count; ++i)
            even.push_back(double(i) / count);
        const double early = scene.contact - ask(scene.bar, scene.post, scene.in_pieces(even)).time.lower;
        EXPECT_GE(early, 0);
        EXPECT_LT(early, 0.5 * before) << count << " pieces";
        before = early;
    }
}

TEST(ThirdMotion, AClearMissIsClearAndCertain) {
    const BarAndPost scene;
    const EvenTurn motion{shifted(0, 0, 1.5), turned({0, 0, 1.5}, {0, 0, 1}, BarAndPost::turn)};
    const ConstantVelocity trajectory(motion, growing_pieces(12), 2.01);
    const FirstContact found = ask(scene.bar, scene.post, trajectory);
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(found.clear_until, 1);
    EXPECT_TRUE(found.pose.isometry().isApprox(motion.goal.isometry(), 1e-12));
}

TEST(ThirdMotion, FarApartIsToldWithoutASearch) {
    const BarAndPost scene;
    const EvenTurn motion{shifted(100, 0, 0), turned({100, 20, 0}, {0, 0, 1}, 3)};
    const FirstContact found = ask(scene.bar, scene.post, ConstantVelocity(motion, {0.3, 1}, 2.01));
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_EQ(found.work.node_pairs, 0U);
}

TEST(ThirdMotion, BodiesThatOverlapAtTheStartAreInContactThere) {
    const BarAndPost scene;
    const EvenTurn motion{turned({0, 0, 0}, {0, 0, 1}, BarAndPost::place), turned({0, 0, 0}, {0, 0, 1}, 2)};
    const FirstContact found = ask(scene.bar, scene.post, ConstantVelocity(motion, {0.1, 0.4, 1}, 2.01));
    EXPECT_EQ(found.verdict, Verdict::contact_at_start);
    EXPECT_EQ(found.clear_until, 0);
    EXPECT_FALSE(found.certain);
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
        double radius = 0;
        for (const Eigen::Vector3d& vertex : moving.vertices())
            radius = std::max(radius, vertex.norm());
        const ConstantVelocity trajectory(motion, ends, radius);
        const double margin = trial % 3 == 0 ? 0.1 : 0;
        const FirstContact found = ask(moving, fixed, trajectory, {.margin = margin});
        (found.verdict == Verdict::clear ? clear : contacts) += 1;
        SCOPED_TRACE("trial " + std::to_string(trial));
        if (found.verdict != Verdict::contact_at_start)
            expect_never_late_and_little_early(found, moving, fixed, trajectory, margin, 200);
    }
    std::cout << contacts << " contacts, " << clear << " clear\n";
    EXPECT_GT(contacts, 10);
    EXPECT_GT(clear, 10);
}

/// Where a piece deviates more than the one before, bodies may be within its deviation at its start, though they were
/// clear of the deviation at the end of the piece before.
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
