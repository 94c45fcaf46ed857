// Chains of joints, against products of public motions.
#include "chasles/motion/chain_frame.h"

#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion.h"
#include "tests/motion/frame_bounds.h"
#include "tests/support/random_poses.h"

namespace chasles::test {
namespace {

using algebra::DoubleDouble;
using Eigen::Vector3d;

/// A chain, and the same as a product.
struct ChainAndProduct {
    motion::Chain chain;
    Motion product = Motion::at_rest(Pose());

    void add(const Pose& pose) {
        chain.add(motion::FixedPose(pose));
        product = product * Motion::at_rest(pose);
    }
    void add_joint(Random& random) {
        const Vector3d axis = random_point(random, 1).normalized();
        std::vector<double> powers{random.uniform(-1, 1), random.uniform(-2, 2)};
        if (random.chance(0.5))
            powers.insert(powers.end(), {random.uniform(-2, 2), random.uniform(-2, 2)});
        const bool turns = random.chance(0.7), is_inverse = random.chance(0.5);
        const motion::FixedAxis fixed(motion::Vector3<DoubleDouble>{axis.x(), axis.y(), axis.z()});
        const auto value = std::make_shared<const motion::TimePolynomial>(powers);
        chain.add(motion::ElementaryJoint{fixed, value, turns, is_inverse});
        if (is_inverse)
            for (double& power : powers)
                power = -power;
        product = product * (turns ? Motion::hinge(Vector3d::Zero(), axis, powers) : Motion::slider(axis, powers));
    }
};

ChainAndProduct random_chain(Random& random) {
    ChainAndProduct made;
    const int joints = random.integer(1, 6);
    for (int i = 0; i < joints; ++i) {
        if (random.chance(0.7))
            made.add(random_pose(random, 1));
        made.add_joint(random);
    }
    if (random.chance(0.7))
        made.add(random_pose(random, 1));
    return made;
}

Eigen::Isometry3d isometry(const motion::GeneralPose<double>& pose) {
    const auto& [place, turn] = pose;
    return Pose({place.x, place.y, place.z}, {turn.w, turn.v.x, turn.v.y, turn.v.z}).isometry();
}

TEST(ChainFrame, IsTheProductOfItsJoints) {
    Random random(2501);
    for (int trial = 0; trial < 300; ++trial) {
        const ChainAndProduct made = random_chain(random);
        const motion::SharedFrame chain = motion::chain_frame(made.chain);
        for (const double time : {0.0, 0.37, 1.0}) {
            const Eigen::Isometry3d expected = made.product.pose_at(time).isometry();
            EXPECT_TRUE(isometry(chain->at(time)).isApprox(expected, 1e-13)) << "trial " << trial;
            EXPECT_TRUE(isometry(chain->expansion({time, time}).pose).isApprox(expected, 1e-13)) << "trial " << trial;
        }
    }
}

TEST(ChainFrame, NoBoundOfRatesIsBroken) {
    Random random(2502);
    for (int trial = 0; trial < 150; ++trial) {
        SCOPED_TRACE(trial);
        expect_bounds_hold(motion::chain_frame(random_chain(random).chain), std::uint64_t(trial));
    }
}

} // namespace
} // namespace chasles::test
