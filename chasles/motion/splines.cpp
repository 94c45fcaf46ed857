// Cubic segments between knots, each a path that carries a turn.
// Source: docs/derivations/26-frames.md, "Splines".
#include "chasles/motion/splines.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/motion/even_trajectory.h"
#include "chasles/motion/frames.h"

#include <Eigen/Dense>
#include <string>

namespace chasles::motion {

namespace {

using Eigen::Vector3d;

/// Between two control orientations of a B-spline, in radians: just below a half turn, whose direction is not unique.
constexpr double largest_control_turn = 3.14159;

Pose usable(const Pose& pose) {
    return MotionEnds::between(pose, pose).start;
}

Pose turn_of(const Pose& pose) {
    return {Vector3d::Zero(), Eigen::Quaterniond(pose.rotation)};
}

using Wide = algebra::DoubleDouble;
using WideVector = Vector3<Wide>;

WideVector place_of(const Pose& pose) {
    return vector_in<Wide>(pose.translation);
}

/// A path from four coefficients in the time of its segment. With coefficients in double-double, segments meet without
/// a jump.
SharedFrame path_of(const std::array<WideVector, 4>& coefficients) {
    std::array<TimePolynomial, 3> place;
    for (int i = 0; i < 3; ++i) {
        std::vector<Wide> part;
        part.reserve(coefficients.size());
        for (const WideVector& c : coefficients)
            part.push_back(c[i]);
        place[std::size_t(i)] = TimePolynomial(std::move(part));
    }
    return path_frame(std::move(place));
}

/// The turn from one orientation to another, times a polynomial share of its angle.
SharedFrame turn_by_share(const Pose& from, const Pose& to, const std::array<Wide, 4>& share) {
    const EvenMotion<Wide> turn = EvenFrame::turn_between(from, to);
    if (double(turn.angle) > largest_control_turn)
        throw InvalidInput("motion: b_spline: two consecutive orientations are a half turn apart");
    std::vector<Wide> angle;
    angle.reserve(share.size());
    for (const Wide& c : share)
        angle.push_back(c * turn.angle);
    // The direction is in the frame of the fixed body; the turn is carried by the orientation before.
    const Quaternion<Wide> back = turn.orientation.conjugate();
    return hinge_frame(rotated(back, turn.direction), TimePolynomial(std::move(angle)));
}

/// The segment of a cumulative B-spline with four control poses.
SharedFrame b_spline_segment(std::span<const Pose, 4> poses) {
    const auto sixth = [](double numerator) { return Wide(numerator) / Wide(6.0); };
    const std::array<std::array<Wide, 4>, 3> shares{{{sixth(5), sixth(3), sixth(-3), sixth(1)},
                                                     {sixth(1), sixth(3), sixth(3), sixth(-2)},
                                                     {sixth(0), sixth(0), sixth(0), sixth(1)}}};
    std::array<WideVector, 4> path{place_of(poses[0]), {}, {}, {}};
    SharedFrame turn = frame_at_rest(turn_of(poses[0]));
    for (std::size_t j = 0; j < 3; ++j) {
        const WideVector step = place_of(poses[j + 1]) - place_of(poses[j]);
        for (std::size_t k = 0; k < 4; ++k)
            path[k] = path[k] + scale(step, shares[j][k]);
        turn = product_frame(std::move(turn), turn_by_share(poses[j], poses[j + 1], shares[j]));
    }
    return product_frame(path_of(path), std::move(turn));
}

} // namespace

void require_track(std::span<const double> times, std::span<const Pose> poses) {
    const auto refuse = [](const std::string& why) { throw InvalidInput("motion: " + why); };
    if (poses.size() < 2)
        refuse("poses: at least two are needed");
    if (times.size() != poses.size())
        refuse("times: there are " + std::to_string(times.size()) + " for " + std::to_string(poses.size()) + " poses");
    if (times.front() != 0 || times.back() != 1)
        refuse("times: must run from 0 to 1");
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
        if (!(times[i] < times[i + 1]))
            refuse("times: must ascend, but time " + std::to_string(i + 1) + " is " + number_text(times[i + 1]) +
                   " after " + number_text(times[i]));
}

SharedFrame even_track(std::vector<double> times, std::span<const Pose> poses, TimedPoses::Between kind,
                       const Vector3d& centre) {
    require_track(times, poses);
    std::vector<SharedFrame> frames;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
        const Pose start = usable(poses[i]);
        const Pose goal = usable(poses[i + 1]);
        frames.push_back(kind == TimedPoses::Between::velocity ? velocity_frame(start, goal, centre)
                                                               : twist_frame(start, goal));
    }
    return joined_frames(std::move(times), std::move(frames));
}

SharedFrame natural_spline(const std::vector<double>& times, std::span<const Pose> given) {
    require_track(times, given);
    std::vector<Pose> poses;
    std::vector<Vector3d> places;
    for (const Pose& pose : given) {
        poses.push_back(usable(pose));
        places.push_back(poses.back().translation);
    }
    const std::vector<Vector3d> seconds = natural_second_derivatives<Vector3d>(times, places);
    std::vector<SharedFrame> frames;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
        const double h = times[i + 1] - times[i];
        const WideVector from = place_of(poses[i]);
        const WideVector start = vector_in<Wide>(h * h / 6 * seconds[i]);
        const WideVector end = vector_in<Wide>(h * h / 6 * seconds[i + 1]);
        const WideVector slope = place_of(poses[i + 1]) - from - scale(start, Wide(2.0)) - end;
        frames.push_back(product_frame(path_of({from, slope, scale(start, Wide(3.0)), end - start}),
                                       velocity_frame(turn_of(poses[i]), turn_of(poses[i + 1]), Vector3d::Zero())));
    }
    return joined_frames(times, std::move(frames));
}

SharedFrame cumulative_b_spline(std::span<const Pose> given) {
    if (given.size() < 2)
        throw InvalidInput("motion: b_spline: at least two poses are needed");
    std::vector<Pose> poses(2, usable(given.front()));
    for (const Pose& pose : given)
        poses.push_back(usable(pose));
    poses.insert(poses.end(), 2, usable(given.back()));
    const std::size_t segments = poses.size() - 3;
    std::vector<double> times;
    std::vector<SharedFrame> frames;
    for (std::size_t i = 0; i <= segments; ++i)
        times.push_back(double(i) / double(segments));
    for (std::size_t i = 0; i < segments; ++i)
        frames.push_back(b_spline_segment(std::span<const Pose, 4>(poses.data() + i, 4)));
    return joined_frames(std::move(times), std::move(frames));
}

} // namespace chasles::motion
