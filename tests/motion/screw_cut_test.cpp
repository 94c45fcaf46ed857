// Cutting a screw: the pieces join without gaps, add up to the screw, and none turns by more than max_turn.
#include "chasles/base/invalid_input.h"
#include "chasles/motion/motion.h"
#include "tests/support/random_poses.h"
#include "tests/support/trajectories.h"
#include "tests/support/wide.h"

#include <limits>
#include <numbers>

namespace chasles {
namespace {

using namespace test;

using std::numbers::pi;

template <class V>
bool same(const V& a, const V& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool same_pose(const motion::GeneralPose<algebra::DoubleDouble>& a,
               const motion::GeneralPose<algebra::DoubleDouble>& b) {
    return same(a.translation, b.translation) && a.rotation.w == b.rotation.w && same(a.rotation.v, b.rotation.v);
}

void expect_joined(const ScrewMotion& whole, const std::vector<ScrewMotion>& pieces) {
    EXPECT_TRUE(same_pose(relative_ends_of(pieces.front()).start, relative_ends_of(whole).start));
    EXPECT_TRUE(same_pose(relative_ends_of(pieces.back()).goal, relative_ends_of(whole).goal));
    for (std::size_t i = 1; i < pieces.size(); ++i)
        EXPECT_TRUE(same_pose(relative_ends_of(pieces[i - 1]).goal, relative_ends_of(pieces[i]).start))
            << "gap before piece " << i;
}

TEST(ScrewCut, PiecesJoinAndAddUp) {
    Random random(651);
    for (int trial = 0; trial < 100; ++trial) {
        const Pose start = random_pose(random, 5);
        const auto whole = ScrewMotion::between(start, random_goal(random, start, random.uniform(0, pi), 3));
        const double most = random.uniform(0.1, 1);
        const auto pieces = whole.with_max_turn(most).pieces();
        EXPECT_EQ(pieces.size(), static_cast<std::size_t>(std::max(1.0, std::ceil(whole.angle() / most))));
        expect_joined(whole, pieces);
        for (const ScrewMotion& piece : pieces) {
            EXPECT_LE(piece.angle(), most * (1 + 1e-9));
            EXPECT_NEAR(piece.angle(), whole.angle() / double(pieces.size()), 1e-14);
            EXPECT_NEAR(piece.slide(), whole.slide() / double(pieces.size()), 1e-13);
        }
    }
}

TEST(ScrewCut, ExactMultiplesAreNotCutOnceMore) {
    const Pose goal({0, 0, 1}, Eigen::Quaterniond(Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitZ())));
    EXPECT_EQ(ScrewMotion::between(Pose(), goal, pi / 18).pieces().size(), 9u);
    EXPECT_EQ(ScrewMotion::between(Pose(), goal, pi / 2).pieces().size(), 1u);
}

TEST(ScrewCut, OnePieceAtATimeIsTheSame) {
    Random random(653);
    const Pose start = random_pose(random, 5);
    const auto whole = ScrewMotion::between(start, random_goal(random, start, 2, 3), 0.3);
    const auto pieces = whole.pieces();
    ASSERT_EQ(whole.piece_count(), pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const motion::RelativeEnds piece(whole.trajectory().pieces().ends_of(i));
        EXPECT_TRUE(same_pose(piece.start, relative_ends_of(pieces[i]).start));
        EXPECT_TRUE(same_pose(piece.goal, relative_ends_of(pieces[i]).goal));
    }
}

TEST(ScrewCut, TranslationIsNeverCut) {
    const auto straight = ScrewMotion::between(Pose(), Pose({0, 3, 4}, Eigen::Quaterniond::Identity()));
    EXPECT_EQ(straight.with_max_turn(ScrewMotion::least_max_turn).pieces().size(), 1u);
}

TEST(ScrewCut, HalfTurnIsCutWhateverIsAllowed) {
    for (const Eigen::Quaterniond& turn : {Eigen::Quaterniond(0, 0, 0, 1), Eigen::Quaterniond(1e-12, 0.6, 0.8, 0)}) {
        const auto half_turn = ScrewMotion::between(Pose(), Pose({1, 2, 3}, turn));
        EXPECT_NEAR(half_turn.angle(), pi, 1e-11);
        const auto pieces = half_turn.with_max_turn(pi).pieces();
        ASSERT_EQ(pieces.size(), 2u);
        expect_joined(half_turn, pieces);
        EXPECT_NEAR(pieces[0].angle(), pi / 2, 1e-11);
        EXPECT_NEAR(pieces[1].angle(), pi / 2, 1e-11);
    }
}

TEST(ScrewCut, PiecesStayOnTheUniformHelix) {
    const Pose goal({0, 0, 6}, Eigen::Quaterniond(Eigen::AngleAxisd(2, Eigen::Vector3d::UnitZ())));
    const auto whole = ScrewMotion::between(Pose(), goal);
    const auto pieces = whole.with_max_turn(pi / 18).pieces();
    const double slide = 6.0 / double(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (const double time : {0.0, 0.25, 0.5, 0.577, 0.75, 1.0}) {
            const Pose pose = pieces[i].pose_at(time);
            const double done = (double(i) + time) / double(pieces.size());
            EXPECT_NEAR(pose.translation.z(), 6 * done, 1e-3 * slide) << "a thousandth of the piece's slide";
            EXPECT_NEAR(pose.rotation.angularDistance(Eigen::Quaterniond::Identity()), 2 * done, 1e-14);
        }
}

TEST(ScrewCut, PiecesOfARelativeMotionCutTheFixedBodyToo) {
    Random random(652);
    const Pose a = random_pose(random, 2);
    const Pose b = random_pose(random, 2);
    const auto whole = ScrewMotion::relative(a, random_goal(random, a, 1, 2), b, random_goal(random, b, 0.5, 2));
    const auto pieces = whole.with_max_turn(0.1).pieces();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double done = double(i) / double(pieces.size());
        EXPECT_TRUE(pieces[i].trajectory().fixed_pose_at(0).isometry().isApprox(
            whole.trajectory().fixed_pose_at(done).isometry(), 1e-14));
        if (i > 0) {
            EXPECT_TRUE(pieces[i].pose_at(0).isometry().isApprox(pieces[i - 1].pose_at(1).isometry(), 1e-14));
        }
    }
    EXPECT_TRUE(pieces.back().pose_at(1).isometry().isApprox(whole.pose_at(1).isometry(), 1e-14));
}

TEST(ScrewCut, TurnBelowTheLeastIsRefused) {
    const auto screw = ScrewMotion::between(Pose(), Pose());
    for (const double bad : {0.0, -1.0, 0.99 * ScrewMotion::least_max_turn, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW((void)screw.with_max_turn(bad), InvalidInput);
}

} // namespace
} // namespace chasles
