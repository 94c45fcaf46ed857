// Checks what the user's functions return.
#include "chasles/motion/own_frame.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/base/sort.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

using Wide = algebra::DoubleDouble;

class OwnFrame final : public MovingFrame {
public:
    explicit OwnFrame(const OwnTrajectory& given) : given_(given) {
        const double way = checked_way();
        const GeneralPose<double> start = at(0);
        size_ = norm1(start.translation) + way + given.reference.lpNorm<1>();
    }

    [[nodiscard]] GeneralPose<double> at(double time) const override {
        const Pose given = given_.pose_at(time);
        auto pose =
            pose_in<double>(is_ordinary(given) ? given : Pose(given.translation, Eigen::Quaterniond(given.rotation)));
        const double inverse = 1 / std::sqrt(pose.rotation.squared_norm());
        pose.rotation = {pose.rotation.w * inverse, scale(pose.rotation.v, inverse)};
        return pose;
    }
    [[nodiscard]] GeneralPose<Wide> refined_at(const Wide& /*time*/) const override { return {}; }
    [[nodiscard]] bool is_refined() const override { return false; }
    [[nodiscard]] Vector3<double> reference() const override { return vector_in<double>(given_.reference); }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return {}; }
    [[nodiscard]] RateBounds rates(const Bracket& times) const override {
        const MotionBounds bounds = checked_bounds(given_, times.lower, times.upper);
        return {bounds.turn_rate, bounds.turn_acceleration, bounds.speed, bounds.acceleration};
    }
    /// Third rates are not known.
    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override {
        const auto pose = at(middle_of(times));
        RateExpansion expansion{.pose = pose, .reference = placed(pose, reference())};
        expansion.bounds = expansion.sums = rates(times);
        return expansion;
    }
    [[nodiscard]] double size() const override { return size_; }
    [[nodiscard]] double rounding() const override { return 1 + 4 * given_.rounding / pose_rounding<double>; }
    void add_cuts(std::vector<double>& cuts) const override {
        cuts.insert(cuts.end(), given_.knots.begin(), given_.knots.end());
    }

private:
    /// How far the reference moves in all, at most.
    [[nodiscard]] double checked_way() const {
        std::vector<double> cuts = given_.knots;
        cuts.push_back(1);
        chasles::sort(cuts);
        double way = 0, from = 0;
        for (const double cut : cuts) {
            way += checked_bounds(given_, from, cut).speed * (cut - from);
            from = cut;
        }
        return way;
    }

    OwnTrajectory given_;
    double size_ = 0;
};

void require(bool holds, const char* what) {
    if (!holds)
        throw InvalidInput(std::string("trajectory: ") + what);
}

} // namespace

MotionBounds checked_bounds(const OwnTrajectory& trajectory, double from, double to) {
    const MotionBounds bounds = trajectory.bounds(from, to);
    const auto check = [&](const char* name, double bound, bool may_be_infinite) {
        if (!(bound >= 0) || (std::isinf(bound) && !may_be_infinite))
            throw InvalidInput("trajectory: bounds: " + std::string(name) + " from " + number_text(from) + " to " +
                               number_text(to) + ": " + number_text(bound) + " is no bound");
    };
    check("turn_rate", bounds.turn_rate, false);
    check("turn_acceleration", bounds.turn_acceleration, true);
    check("speed", bounds.speed, false);
    check("acceleration", bounds.acceleration, true);
    return bounds;
}

SharedFrame own_frame(const OwnTrajectory& trajectory) {
    require(bool(trajectory.pose_at), "pose_at: is missing");
    require(bool(trajectory.bounds), "bounds: is missing");
    require(trajectory.reference.allFinite(), "reference: a number is NaN or infinite");
    require(trajectory.rounding >= 0 && trajectory.rounding <= 1e-3, "rounding: must be in [0, 1e-3]");
    for (const double knot : trajectory.knots)
        require(knot > 0 && knot < 1, "knots: must be in (0, 1)");
    return std::make_shared<const OwnFrame>(trajectory);
}

} // namespace chasles::motion
