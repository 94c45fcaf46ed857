// Cuts a smooth motion into pieces, and encloses their parts.
// Source: docs/derivations/24-enclosures.md.
#include "chasles/motion/smooth_trajectory.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

static_assert(Trajectory<SmoothTrajectory>);

namespace {

using Wide = algebra::DoubleDouble;

/// The rounding of the times at both ends of a part, in double and in double-double.
template <class S>
inline constexpr double rounding_of_times = 0x1p-51;
template <>
inline constexpr double rounding_of_times<Wide> = 0x1p-98;

/// How often the time between two cuts is divided.
constexpr int most_divisions = 20;

/// Where pieces are divided: a contact at exactly the end of a piece cannot be told from a miss, and round times are
/// frequent.
constexpr double uneven_half = 0.4837;

RateBounds largest(const RateBounds& a, const RateBounds& b) {
    return {std::max(a.turn_rate, b.turn_rate), std::max(a.turn_acceleration, b.turn_acceleration),
            std::max(a.speed, b.speed), std::max(a.acceleration, b.acceleration)};
}

/// The times 0 and 1, and those at which rates jump, in order.
std::vector<double> cuts_of(const MovingFrame& frame) {
    std::vector<double> cuts{0, 1};
    frame.add_cuts(cuts);
    std::ranges::sort(cuts);
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    return cuts;
}

/// Appends the ends of pieces within an interval that has no cut inside.
void append_pieces(const MovingFrame& frame, const Bracket& times, std::vector<double>& ends, int divisions = 0) {
    const double duration = times.upper - times.lower;
    const double turn = frame.rates(times).turn_rate * duration;
    if (turn <= most_turn_of_part) {
        ends.push_back(times.upper);
        return;
    }
    if (divisions == most_divisions)
        throw InvalidInput("motion: bounds: the body turns by more than 0.25 radians within a millionth of the time "
                           "between two knots");
    const double middle = times.lower + uneven_half * duration;
    append_pieces(frame, {times.lower, middle}, ends, divisions + 1);
    append_pieces(frame, {middle, times.upper}, ends, divisions + 1);
}

} // namespace

Pose public_pose(const GeneralPose<double>& pose) {
    const auto& [w, v] = pose.rotation;
    return {{pose.translation.x, pose.translation.y, pose.translation.z}, Eigen::Quaterniond(w, v.x, v.y, v.z)};
}

SmoothPiece::SmoothPiece(SmoothMotion motion, const Bracket& times)
    : motion_(std::move(motion)), times_(times), reference_(motion_.relative->reference()),
      reference_in_double_(in_double(reference_)), cubic_(widened(enclosure({0, 1})->cubic)) {}

double SmoothPiece::time_at(double tau) const {
    return tau == 1 ? times_.upper : times_.lower + tau * (times_.upper - times_.lower);
}

/// A body that is fast for a short while is displaced by the rounding of times.
template <class S>
EnclosureBounds SmoothPiece::bounds(const Bracket& part) const {
    const MovingFrame& frame = *motion_.relative;
    const Bracket times{time_at(part.lower), time_at(part.upper)};
    const RateBounds rates = frame.rates(times);
    const double duration = (part.upper - part.lower) * (times_.upper - times_.lower) + rounding_of_times<double>;
    EnclosureBounds bounds =
        enclosure_bounds(reference_in_double_, rates, duration, pose_rounding<S> * frame.rounding(), frame.size());
    const double shift = rates.speed * rounding_of_times<S>;
    const double turn = rates.turn_rate * rounding_of_times<S>;
    bounds.rounding += shift;
    bounds.deviation += shift;
    bounds.turn_rounding += turn;
    bounds.turn_deviation += turn;
    return bounds;
}

std::optional<Enclosure<double>> SmoothPiece::enclosure(const Bracket& part) const {
    const MovingFrame& frame = *motion_.relative;
    const PartEnds<double> ends{frame.at(time_at(part.lower)), frame.at(time_at(part.upper))};
    return Enclosure<double>{sweep_between_ends(ends, reference_in_double_), bounds<double>(part)};
}

std::optional<Enclosure<Wide>> SmoothPiece::refined_enclosure(const Bracket& part) const {
    const MovingFrame& frame = *motion_.relative;
    if (!frame.is_refined())
        return std::nullopt;
    const auto at = [&](double tau) {
        const Wide duration = Wide(times_.upper) - Wide(times_.lower);
        return frame.refined_at(Wide(times_.lower) + Wide(tau) * duration);
    };
    const PartEnds<Wide> ends{at(part.lower), at(part.upper)};
    return Enclosure<Wide>{sweep_between_ends(ends, reference_), bounds<Wide>(part)};
}

Bracket SmoothPiece::time_of(const Bracket& tau) const {
    constexpr double rounding = 0x1p-50;
    return {std::max(0.0, time_at(tau.lower) * (1 - rounding)), std::min(1.0, time_at(tau.upper) * (1 + rounding))};
}

double SmoothPiece::tau_tolerance(double time_tolerance) const {
    return std::min(1.0, time_tolerance / (times_.upper - times_.lower));
}

Pose SmoothPiece::pose_at(double tau) const {
    return public_pose(motion_.moving->at(time_at(tau)));
}

Pose SmoothPiece::fixed_pose_at(double tau) const {
    return motion_.fixed ? public_pose(motion_.fixed->at(time_at(tau))) : Pose();
}

SmoothPieces::SmoothPieces(SmoothMotion motion) : motion_(std::move(motion)), cuts_{0} {
    const std::vector<double> cuts = cuts_of(*motion_.relative);
    for (std::size_t i = 1; i < cuts.size(); ++i)
        append_pieces(*motion_.relative, {cuts[i - 1], cuts[i]}, cuts_);
}

/// The point is never farther from the middle of a motion without cuts than half of its way.
PathBall SmoothTrajectory::ball_around_path(const Vector3<double>& point) const {
    const MovingFrame& frame = *motion_.relative;
    const Vector3<double> reference = in_double(frame.reference());
    const std::vector<double> cuts = cuts_of(frame);
    const auto place = [&](double time) {
        const GeneralPose<double> pose = frame.at(time);
        return rotated(pose.rotation, point) + pose.translation;
    };
    double radius = 0;
    const Vector3<double> centre = place(0.5);
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const RateBounds rates = frame.rates({cuts[i - 1], cuts[i]});
        const double duration = cuts[i] - cuts[i - 1];
        const double way = duration * (rates.speed + rates.turn_rate * length(point - reference));
        const double start = length(place(cuts[i - 1]) - centre);
        const double goal = length(place(cuts[i]) - centre);
        radius = std::max(radius, 0.5 * (start + goal + way));
    }
    return {centre, radius, frame.size() + norm1(point)};
}

std::optional<CoarseMotion> SmoothTrajectory::coarse() const {
    constexpr double quarter_turn = 1.5707963;
    const MovingFrame& frame = *motion_.relative;
    const std::vector<double> cuts = cuts_of(frame);
    RateBounds rates = frame.rates({0, cuts[1]});
    for (std::size_t i = 2; i < cuts.size(); ++i)
        rates = largest(rates, frame.rates({cuts[i - 1], cuts[i]}));
    if (!(rates.turn_rate <= quarter_turn))
        return std::nullopt;
    if (cuts.size() > 2) // rates jump: only the speeds hold for the whole
        rates.acceleration = rates.turn_acceleration = INFINITY;
    const Vector3<double> reference = in_double(frame.reference());
    const EnclosureBounds bounds =
        enclosure_bounds(reference, rates, 1, pose_rounding<double> * frame.rounding(), frame.size());
    return CoarseMotion{sweep_between_ends<double>({frame.at(0), frame.at(1)}, reference), bounds.deviation,
                        frame.size(), bounds.turn_deviation, reference};
}

Pose SmoothTrajectory::pose_at(double time) const {
    return public_pose(motion_.moving->at(std::clamp(time, 0.0, 1.0)));
}

Pose SmoothTrajectory::fixed_pose_at(double time) const {
    return motion_.fixed ? public_pose(motion_.fixed->at(std::clamp(time, 0.0, 1.0))) : Pose();
}

} // namespace chasles::motion
