// Certificates of every kind of motion are verified by the checker, which has its own formulas of motions.
#include "chasles/certificate/piece_motion.h"

#include "chasles/motion/timed_poses.h"
#include "tests/certificate/checked.h"

#include <gtest/gtest.h>

#include <map>

namespace chasles::test {
namespace {

struct Ends {
    Pose start, goal;
};

class RandomMotions {
public:
    explicit RandomMotions(Random& random) : random_(random) {}

    Ends ends() {
        const Pose start = random_pose(random_, 2.5);
        return {start, random_goal(random_, start, random_.uniform(0, 3), 4)};
    }
    Motion of_kind(const std::string& kind) {
        const auto [start, goal] = ends();
        const auto [other, end] = ends();
        const Eigen::Vector3d centre = random_point(random_, 1), axis = random_point(random_, 1);
        const std::vector<double> even{random_.uniform(-1, 1), 0x1p-3 * double(random_.integer(-20, 20))};
        if (kind == "screw of two")
            return ScrewMotion::relative(start, goal, other, end);
        if (kind == "sweep")
            return SweepMotion::between(start, goal, centre);
        if (kind == "sweep of two")
            return SweepMotion::relative(start, goal, other, end);
        if (kind == "velocity")
            return Motion::velocity(start, goal, centre);
        if (kind == "twist")
            return Motion::twist(start, goal);
        if (kind == "velocity of two")
            return relative(Motion::velocity(start, goal, centre), Motion::velocity(other, end));
        if (kind == "twist of two")
            return relative(Motion::twist(start, goal), Motion::twist(other, end));
        if (kind == "track")
            return TimedPoses::through({0, 1, 3}, {start, goal, random_goal(random_, goal, 2, 2)},
                                       random_.chance(0.5) ? TimedPoses::Between::velocity : TimedPoses::Between::twist,
                                       centre);
        if (kind == "hinge")
            return Motion::at_rest(start) * Motion::hinge(centre, axis, {even[1], 2 * even[1]});
        if (kind == "slider")
            return Motion::at_rest(start) * Motion::slider(axis, {0.25, 4 * even[1]});
        if (kind == "polynomial")
            return Motion::polynomial({random_point(random_, 2), random_point(random_, 4)}) * Motion::at_rest(start);
        return relative(Motion::at_rest(start) * Motion::hinge(centre, axis, {0, 2 * even[1]}) *
                            Motion::slider(axis, {0, even[1]}) * Motion::twist(other, end),
                        Motion::hinge(axis, centre, {0, even[1]}) * Motion::at_rest(goal));
    }

private:
    Random& random_;
};

class CertifiedMotions : public ::testing::TestWithParam<std::string> {};

TEST_P(CertifiedMotions, AreVerified) {
    Random random(4748);
    RandomBodies bodies;
    RandomMotions motions(random);
    std::map<Verdict, int> count;
    for (int round = 0; round < 80; ++round) {
        FirstContactQuery query{bodies(random), bodies(random), motions.of_kind(GetParam())};
        query.options.margin = random.chance(0.3) ? random.uniform(0, 0.3) : 0;
        const Verdict verdict = first_contact(query).verdict;
        const Certificate proof = expect_verified(query, verdict);
        ASSERT_FALSE(HasFailure()) << round;
        EXPECT_FALSE(is_about(proof.text, motions.of_kind(GetParam())));
        ++count[verdict];
    }
    EXPECT_GT(count[Verdict::clear], 10);
    EXPECT_GT(count[Verdict::contact], 1);
    EXPECT_GT(count[Verdict::contact_at_start], 1);
}

TEST(CertifiedTracks, NameThePieceOfTheContact) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const Pose end(Eigen::Vector3d(0.2, 0.1, 0), Eigen::Quaterniond(0.9, 0.1, 0, 0.3));
    const Motion track = TimedPoses::through({0, 1, 3}, {shifted(3, 0, 0), shifted(3, 3, 0), end});
    const Certificate proof = expect_verified({cube, cube, track}, Verdict::contact);
    EXPECT_NE(proof.text.find("verdict contact 1 "), std::string::npos) << proof.text;
}

INSTANTIATE_TEST_SUITE_P(Kinds, CertifiedMotions,
                         ::testing::Values("screw of two", "sweep", "sweep of two", "velocity", "twist",
                                           "velocity of two", "twist of two", "track", "hinge", "slider", "polynomial",
                                           "product"),
                         [](const auto& kind) {
                             std::string name = kind.param;
                             std::ranges::replace(name, ' ', '_');
                             return name;
                         });

} // namespace
} // namespace chasles::test
