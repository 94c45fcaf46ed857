// One step along contacts: it keeps their gaps, loses energy, and comes back to the margin.
#include "chasles/manipulation/slide.h"

#include "chasles/motion/motion.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using manipulation::Displacement;
using manipulation::HandSpring;
using manipulation::ModelledContact;
using manipulation::next_slide;
using manipulation::Slide;
using manipulation::SlideKind;
using manipulation::SlideProblem;

constexpr double margin = 1e-3;

ModelledContact contact_at(const Vector3d& point, const Vector3d& normal, double gap, ContactKind kind) {
    ModelledContact result;
    result.contact.kind = kind;
    result.contact.point = point;
    result.contact.normal = normal;
    result.contact.gap = gap;
    return result;
}

double least_gap(const std::vector<ModelledContact>& contacts, const Pose& from, const Pose& to) {
    double least = 1e300;
    for (const ModelledContact& contact : contacts)
        least = std::min(least, gap_after(contact, Displacement::between(from, to)));
    return least;
}

/// Corners and faces around a body of size 1, pulled by up to ten sizes and half a turn.
TEST(Slide, KeepsGapsAndLosesEnergyHoweverStrongThePull) {
    Random random(1);
    int partial = 0, at_margin = 0, bent = 0;
    for (int round = 0; round < 3000; ++round) {
        const HandSpring spring({Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()});
        const Pose pose = random_pose(random, 1);
        std::vector<ModelledContact> contacts;
        for (int i = random.integer(1, 4); i > 0; --i)
            contacts.push_back(contact_at(pose.translation + random_point(random, 0.5),
                                          random_point(random, 1).normalized(), margin,
                                          random.chance(0.5) ? ContactKind::vertex_face : ContactKind::face_vertex));
        const Pose goal = random_goal(random, pose, random.uniform(-3, 3), random.chance(0.5) ? 10 : 0.1);
        const Slide slide = next_slide({spring, pose, goal, contacts, margin, 1, 1e-6});
        const Pose middle = Motion::screw(pose, slide.end).pose_at(0.5);
        EXPECT_GE(least_gap(contacts, pose, slide.end), 0.75 * margin * (1 - 1e-9)) << round;
        EXPECT_GE(least_gap(contacts, pose, middle), 0.75 * margin * (1 - 1e-9)) << round;
        if (slide.kind != SlideKind::partial)
            continue;
        EXPECT_GT(spring.energy_lost(pose, slide.end, goal), 0) << round;
        const double turn = Eigen::Quaterniond(pose.rotation)
                                .normalized()
                                .angularDistance(Eigen::Quaterniond(slide.end.rotation).normalized());
        EXPECT_LE(turn, 0.5 + 1e-9);
        EXPECT_LE((slide.end.translation - pose.translation).norm(), 0.5 + 1e-9);
        ++partial;
        bent += turn > 0.1;
        at_margin += turn > 0.1 && std::abs(least_gap(contacts, pose, slide.end) - margin) < 0.03 * margin;
    }
    EXPECT_GT(partial, 1500);
    EXPECT_GT(bent, 300);
    EXPECT_GT(at_margin, 0.05 * bent); // most are held by a contact that opens
    std::cout << partial << " partial, " << bent << " bent, " << at_margin << " of them end at the margin" << std::endl;
}

TEST(Slide, ComesBackToTheMarginWhileItSlides) {
    const HandSpring spring({Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()});
    const std::vector<ModelledContact> floor{
        contact_at({0, 0, -0.5}, Vector3d::UnitZ(), 0.8 * margin, ContactKind::vertex_face)};
    const Slide slide = next_slide({spring, Pose(), shifted(0.2, 0, -1), floor, margin, 1, 1e-6});
    EXPECT_EQ(slide.kind, SlideKind::partial);
    EXPECT_NEAR(least_gap(floor, Pose(), slide.end), margin, 0.02 * margin);
    EXPECT_NEAR(slide.end.translation.x(), 0.2, 0.02);
}

TEST(Slide, BetweenTwoNearWallsABodyIsKeptInTheMiddle) {
    const HandSpring spring({Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()});
    const std::vector<ModelledContact> walls{
        contact_at({-0.5, 0, 0}, Vector3d::UnitX(), 0.2 * margin, ContactKind::vertex_face),
        contact_at({0.5, 0, 0}, -Vector3d::UnitX(), 0.6 * margin, ContactKind::vertex_face)};
    const Slide slide = next_slide({spring, Pose(), shifted(-1, 0, 0), walls, margin, 1, 1e-6});
    EXPECT_EQ(slide.kind, SlideKind::partial);
    EXPECT_NEAR(slide.end.translation.x(), 0.2 * margin, 0.01 * margin);
}

TEST(Slide, WithoutContactsItLeadsToTheGoal) {
    const HandSpring spring({Vector3d::Zero(), Eigen::Matrix3d::Identity()});
    const Pose goal = turned({1, 2, 3}, {1, 0, 0}, 2);
    const Slide slide = next_slide({spring, Pose(), goal, {}, margin, 1, 1e-6});
    EXPECT_EQ(slide.kind, SlideKind::free);
    EXPECT_EQ(slide.end.translation, goal.translation);
}

} // namespace
} // namespace chasles::test
