// Motions that are made of frames: joints, polynomials, splines, the user's own, and products.
// Source: docs/derivations/26-frames.md.
#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/motion/even_trajectory.h"
#include "chasles/motion/frames.h"
#include "chasles/motion/motion.h"
#include "chasles/motion/own_frame.h"
#include "chasles/motion/splines.h"
#include "chasles/motion/sweep_trajectory.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace chasles {

namespace {

using motion::SharedFrame;
using motion::SmoothMotion;
using motion::TimePolynomial;

void require(bool holds, const std::string& what) {
    if (!holds)
        throw InvalidInput("motion: " + what);
}

motion::SmoothTrajectory smooth(SmoothMotion motion) {
    constexpr int most_factors = 1000; // the depth of calls, and the cost of one pose
    require(motion.relative->factors() <= most_factors,
            "is made of more than 1000 motions, which are all evaluated for every pose: multiply the poses of factors "
            "that stand still, or ask about a path of poses");
    return motion::SmoothTrajectory(std::move(motion));
}

Motion motion_of(SmoothMotion motion) {
    return Motion(
        std::make_shared<const motion::ErasedTrajectory<motion::SmoothTrajectory>>(smooth(std::move(motion))));
}

/// Numbers that are finite, and whose sizes sum up to at most `most`.
void require_usable(std::span<const double> numbers, const char* name, double most, const char* way_out = "") {
    double sum = 0;
    for (const double number : numbers)
        sum += std::abs(number);
    require(std::isfinite(sum), std::string(name) + ": a number is NaN or infinite");
    require(sum <= most, std::string(name) + ": the numbers are too large; their sizes may sum up to " +
                             number_text(most) + way_out);
}

void require_usable(const Eigen::Vector3d& vector, const char* name) {
    require_usable(std::span(vector.data(), 3), name, 3 * Pose::largest_length);
}

/// The frame of a factor, in the world.
SharedFrame frame_of(const Motion& motion, const char* what, const char* way_out = "") {
    SharedFrame frame = motion.trajectory().frame();
    require(frame != nullptr, std::string(what) +
                                  ": takes no screw and no sweep (constant twist and constant velocity are the even "
                                  "ones), and no motion whose fixed body moves" +
                                  way_out);
    return frame;
}

} // namespace

Motion Motion::velocity(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    return ConstantVelocity::between(start, goal, centre);
}

Motion Motion::twist(const Pose& start, const Pose& goal) {
    return ConstantTwist::between(start, goal);
}

Motion Motion::hinge(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, const std::vector<double>& angle) {
    constexpr double largest_angle = 1000;
    require_usable(point, "point");
    require_usable(direction, "direction");
    require(direction.cwiseAbs().maxCoeff() > 0, "direction: is zero");
    require_usable(angle, "angle", largest_angle,
                   " radians: ask about the turns one after another, each from the angle where the last one ended");
    return motion_of(SmoothMotion::of_one(motion::hinge_frame(point, direction, TimePolynomial(angle))));
}

Motion Motion::slider(const Eigen::Vector3d& direction, const std::vector<double>& way) {
    require_usable(direction, "direction");
    require(direction.cwiseAbs().maxCoeff() > 0, "direction: is zero");
    require_usable(way, "way", Pose::largest_length);
    return motion_of(SmoothMotion::of_one(motion::slide_frame(direction.stableNormalized(), TimePolynomial(way))));
}

Motion Motion::polynomial(const std::vector<Eigen::Vector3d>& places) {
    std::array<std::vector<double>, 3> coefficients;
    for (const Eigen::Vector3d& place : places)
        for (Eigen::Index i = 0; i < 3; ++i)
            coefficients[std::size_t(i)].push_back(place[i]);
    for (const std::vector<double>& part : coefficients)
        require_usable(part, "coefficients", Pose::largest_length);
    return motion_of(SmoothMotion::of_one(motion::path_frame(
        {TimePolynomial(coefficients[0]), TimePolynomial(coefficients[1]), TimePolynomial(coefficients[2])})));
}

Motion Motion::spline(const std::vector<double>& times, const std::vector<Pose>& poses) {
    return motion_of(SmoothMotion::of_one(motion::natural_spline(times, poses)));
}

Motion Motion::b_spline(const std::vector<Pose>& poses) {
    return motion_of(SmoothMotion::of_one(motion::cumulative_b_spline(poses)));
}

Motion Motion::along(const OwnTrajectory& trajectory) {
    return motion_of(SmoothMotion::of_one(motion::own_frame(trajectory)));
}

Motion operator*(const Motion& outer, const Motion& inner) {
    return motion_of(
        SmoothMotion::of_one(motion::product_frame(frame_of(outer, "product"), frame_of(inner, "product"))));
}

namespace {

/// A trajectory of two moving bodies that knows how the moving one moves.
template <class Trajectory>
class OfTwo : public Trajectory {
public:
    OfTwo(Trajectory trajectory, Motion moving) : Trajectory(std::move(trajectory)), moving_(std::move(moving)) {}
    [[nodiscard]] motion::SharedTrajectory with_goal(const Pose& goal_in_world) const {
        return moving_.trajectory().with_goal(goal_in_world);
    }

private:
    Motion moving_;
};

template <class Trajectory>
Motion of_two(Trajectory trajectory, const Motion& moving) {
    return Motion(std::make_shared<const motion::ErasedTrajectory<OfTwo<Trajectory>>>(
        OfTwo<Trajectory>(std::move(trajectory), moving)));
}

} // namespace

/// Two motions that are straight and even make a sweep, which is exact.
Motion relative(const Motion& moving, const Motion& fixed) {
    const motion::MotionEnds* a = moving.trajectory().straight_ends();
    const motion::MotionEnds* b = fixed.trajectory().straight_ends();
    if (a && b)
        return of_two(motion::SweepTrajectory(motion::MotionEnds::relative(a->start, a->goal, b->start, b->goal),
                                              Eigen::Vector3d::Zero()),
                      moving);
    const SharedFrame of_moving = frame_of(moving, "relative");
    const SharedFrame of_fixed = frame_of(fixed, "relative");
    return of_two(smooth({motion::relative_frame(of_moving, of_fixed), of_moving, of_fixed}), moving);
}

Motion rest_of(const Motion& motion, double start) {
    require(start >= 0 && start < 1, "rest: the time must be in [0, 1)");
    if (const motion::MotionEnds* ends = motion.trajectory().straight_ends())
        return Motion::velocity(motion.pose_at(start), ends->goal);
    const SharedFrame whole =
        frame_of(motion, "rest", "; of two motions take relative(rest_of(moving, start), rest_of(fixed, start))");
    return motion_of(SmoothMotion::of_one(motion::part_frame(whole, start, 1)));
}

} // namespace chasles
