// Bounds of the rates of rigid groups, against differences of their placements.
#include "chasles/robot/group_motion.h"

#include "chasles/motion/screw_path.h"
#include "tests/robot/random_robot.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using motion::RateBounds;

constexpr std::size_t intervals = 2000;

/// A group as seen from another one.
class SampledGroup {
public:
    SampledGroup(robot::Placements& placements, std::size_t from, std::size_t to) {
        for (std::size_t i = 0; i <= intervals; ++i) {
            const motion::GeneralPose<double> pose = seen_from(placements(i, from), placements(i, to));
            const auto& [w, v] = pose.rotation;
            places_.emplace_back(pose.translation.x, pose.translation.y, pose.translation.z);
            turns_.push_back(Quaterniond(w, v.x, v.y, v.z).normalized());
        }
    }

    /// The largest central differences.
    [[nodiscard]] RateBounds rates() const {
        constexpr double step = 1.0 / double(intervals);
        RateBounds rates;
        for (std::size_t i = 2; i + 2 <= intervals; ++i) {
            const Vector3d speed = (places_[i + 1] - places_[i - 1]) / (2 * step);
            const Vector3d acceleration = (places_[i + 1] - 2 * places_[i] + places_[i - 1]) / (step * step);
            const Vector3d turn_acceleration = (turn_rate(i + 1) - turn_rate(i - 1)) / (2 * step);
            rates.speed = std::max(rates.speed, speed.norm());
            rates.acceleration = std::max(rates.acceleration, acceleration.norm());
            rates.turn_rate = std::max(rates.turn_rate, turn_rate(i).norm());
            rates.turn_acceleration = std::max(rates.turn_acceleration, turn_acceleration.norm());
        }
        return rates;
    }

private:
    [[nodiscard]] Vector3d turn_rate(std::size_t i) const {
        const Eigen::AngleAxisd turn(turns_[i + 1] * turns_[i - 1].conjugate());
        const double angle = std::remainder(turn.angle(), 2 * std::numbers::pi);
        return turn.axis() * angle * double(intervals) / 2;
    }

    std::vector<Vector3d> places_;
    std::vector<Quaterniond> turns_;
};

/// Differences have errors of the order of the squared step.
void expect_within(const RateBounds& sampled, const RateBounds& bounds, const std::string& what) {
    const auto expect = [&](double value, double bound, const char* rate) {
        EXPECT_LE(value, bound * (1 + 1e-4) + 1e-4) << what << ": " << rate;
    };
    expect(sampled.speed, bounds.speed, "speed");
    expect(sampled.acceleration, bounds.acceleration, "acceleration");
    expect(sampled.turn_rate, bounds.turn_rate, "turn rate");
    expect(sampled.turn_acceleration, bounds.turn_acceleration, "turn acceleration");
}

/// A joint after a joint, along straight and curved paths: each group as seen from the base, and the base from it.
TEST(GroupRates, BoundTheRatesOfEveryGroup) {
    Random random(2401);
    for (int trial = 0; trial < 150; ++trial) {
        const Robot robot(random_robot(random, random.integer(3, 5), random.chance(0.2)));
        const bool has_quaternion = !robot.model().quaternions.empty();
        const std::array ends{random_configuration(random, robot, 1), random_configuration(random, robot, 1)};
        const std::array rates{random_configuration(random, robot, 1), random_configuration(random, robot, 1)};
        const JointPath path = has_quaternion || random.chance(0.5)
                                   ? JointPath::straight(robot, ends)
                                   : JointPath::cubic(robot, std::array{0.0, 1.0}, ends, rates);
        const robot::Model& model = robot.model();
        const robot::SegmentMotion motion = model.motion_of(path.segments().front());
        const robot::GroupRates group_rates(model, motion);
        robot::Placements placements(model, motion, intervals);
        for (std::size_t group = 1; group < model.groups.size(); ++group) {
            std::vector<std::size_t> chain; // from the group up
            for (std::size_t g = group; g != 0; g = model.groups[g].parent)
                chain.push_back(g);
            RateBounds down, up;
            for (std::size_t i = chain.size(); i-- > 0;)
                group_rates.go_down(down, chain[i]);
            for (const std::size_t g : chain)
                group_rates.go_up(up, g);
            const std::string what = "trial " + std::to_string(trial) + ", group " + std::to_string(group);
            expect_within(SampledGroup(placements, 0, group).rates(), down, what + " down");
            expect_within(SampledGroup(placements, group, 0).rates(), up, what + " up");
        }
    }
}

} // namespace
} // namespace chasles::test
