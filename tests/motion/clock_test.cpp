// Tau and time of a screw against a hundred digits, for turns from 1e-17 to the largest turn of one piece.
// The bound is in docs/derivations/10-error-bounds.md, "Time".
#include "tests/support/posed_motions.h"
#include "tests/support/trajectories.h"
#include "tests/support/wide.h"

namespace chasles {
namespace {

using namespace test;

/// Half of the exact turn between two poses.
Wide half_turn_of(const ScrewMotion& screw) {
    const motion::Quaternion<DoubleDouble>& p = relative_ends_of(screw).start.rotation;
    const motion::Quaternion<DoubleDouble>& q = relative_ends_of(screw).goal.rotation;
    const auto widened = [](const motion::Quaternion<DoubleDouble>& x) {
        return motion::Quaternion<Wide>{wide(x.w), {wide(x.v.x), wide(x.v.y), wide(x.v.z)}};
    };
    const motion::Quaternion<Wide> turn = widened(q) * widened(p).conjugate();
    const Wide sine = sqrt(Wide(dot(turn.v, turn.v)));
    return atan2(sine, Wide(abs(turn.w)));
}

double random_turn(Random& random) {
    return random.chance(0.4) ? std::abs(random.scaled(-17, -1)) : random.uniform(0, std::numbers::pi - 2.1e-3);
}

double random_tau(Random& random) {
    return random.chance(0.3) ? std::abs(random.scaled(-300, 0)) : random.uniform(0, 1);
}

/// The largest relative error, in units of 2^-53, of `made` as a value of `truth`.
class Units {
public:
    void compare(double made, const Wide& truth) {
        ++count_;
        if (truth != 0)
            largest_ = std::max(largest_, static_cast<double>(Wide(abs(Wide((Wide(made) - truth) / truth)))) * 0x1p53);
    }
    [[nodiscard]] double largest() const { return largest_; }
    void print(const char* what) const {
        std::cout << what << ": " << largest_ << " units at most, of " << count_ << std::endl;
    }

private:
    double largest_ = 0;
    int count_ = 0;
};

TEST(Clock, TimeOfTauIsGoodToElevenUnits) {
    Random random(671);
    Units units;
    for (int trial = 0; trial < 400 * times_if_long(100); ++trial) {
        const auto [start, goal] = random_pose_pair(random, {1, random_turn(random)});
        const auto screw = ScrewMotion::between(start, goal);
        const Wide half = half_turn_of(screw);
        const Wide tangent = tan(half);
        for (int i = 0; i < 5; ++i) {
            const double tau = random_tau(random);
            units.compare(screw.time_at(tau), half == 0 ? Wide(tau) : Wide(atan(Wide(tau * tangent)) / half));
        }
        EXPECT_EQ(screw.time_at(0), 0);
        EXPECT_NEAR(screw.time_at(1), 1, 0x1p-52);
    }
    units.print("time of tau");
    EXPECT_LT(units.largest(), 11);
    EXPECT_GT(units.largest(), 1);
}

TEST(Clock, TheGreatestRateIsAtTheStart) {
    Random random(672);
    for (int trial = 0; trial < 300; ++trial) {
        const auto [start, goal] = random_pose_pair(random, {1, random_turn(random)});
        const auto screw = ScrewMotion::between(start, goal);
        const double greatest = 1 / screw.tau_rate(0);
        const double lower = random_tau(random);
        const double upper = random.uniform(lower, 1);
        const double width = screw.time_at(upper) - screw.time_at(lower);
        EXPECT_LE(width, std::max(1.0, greatest) * (upper - lower) + 40 * 0x1p-53)
            << "the bracket of time is wider than first_contact assumes";
    }
}

} // namespace
} // namespace chasles
