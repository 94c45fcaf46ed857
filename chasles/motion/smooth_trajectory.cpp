// Cuts a smooth motion into pieces, and encloses their parts.
// Source: docs/derivations/24-enclosures.md.
#include "chasles/motion/smooth_trajectory.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit_of_thread.h"
#include "chasles/base/sort.h"
#include "chasles/motion/axis_piece.h"
#include "chasles/motion/frames.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <chrono>
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

/// All sections in one, at whose ends velocities may jump.
Section whole_of(const std::vector<Section>& sections) {
    RateBounds rates{0, INFINITY, 0, INFINITY};
    for (const Section& section : sections) {
        rates.turn_rate = std::max(rates.turn_rate, section.rates.turn_rate);
        rates.speed = std::max(rates.speed, section.rates.speed);
    }
    return {{0, 1}, rates, {sections.front().ends.start, sections.back().ends.goal}};
}

bool are_finite(const RateBounds& rates) {
    return std::isfinite(rates.turn_acceleration) && std::isfinite(rates.acceleration);
}

/// The way of a motion in sections. Most are made in microseconds, so that a question has something to start from at
/// any limit; bounds that the user computes may take long.
struct MadeSections {
    std::vector<Section>& all;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

    void throw_if_late() const {
        if (is_cancelled() && std::chrono::steady_clock::now() - begin > std::chrono::milliseconds(50))
            throw Cancelled();
    }
};

/// Appends the interval between two times, or parts of it in which the body turns little. `poses` are those at its
/// ends. Throws Cancelled if that takes long.
void append_sections(const MovingFrame& frame, const Bracket& times, const PartEnds<double>& poses,
                     const MadeSections& sections, int divisions = 0) {
    sections.throw_if_late();
    const double duration = times.upper - times.lower;
    const RateBounds rates = frame.rates(times);
    if (rates.turn_rate * duration <= most_turn_of_part) {
        sections.all.push_back({times, rates, poses});
        return;
    }
    if (divisions == most_divisions)
        throw InvalidInput("motion: bounds: the body turns by more than 0.25 radians within a millionth of the time "
                           "between two knots");
    const double middle = times.lower + uneven_half * duration;
    const GeneralPose<double> between = frame.at(middle);
    append_sections(frame, {times.lower, middle}, {poses.start, between}, sections, divisions + 1);
    append_sections(frame, {middle, times.upper}, {between, poses.goal}, sections, divisions + 1);
}

} // namespace

Pose public_pose(const GeneralPose<double>& pose) {
    const auto& [w, v] = pose.rotation;
    return {{pose.translation.x, pose.translation.y, pose.translation.z}, Eigen::Quaterniond(w, v.x, v.y, v.z)};
}

SmoothPiece::SmoothPiece(SmoothMotion motion, const Section& section)
    : motion_(std::move(motion)), times_(section.times), rates_{section.rates, {}},
      reference_(motion_.relative->reference()), latest_(section) {
    find_axis(section.ends);
    whole_ = {sweep_between_ends(section.ends, reference_), bounds<double>({0, 1})};
    cubic_ = widened(whole_.cubic);
}

/// The axis of the turn from start to goal. If there is none, the coordinate along which the body moves most evenly.
void SmoothPiece::find_axis(const PartEnds<double>& ends) {
    const auto try_axis = [&](const Vector3<double>& axis) {
        const auto expansion = motion_.relative->expansion_about(axis, times_);
        if (expansion && (!rates_.axis || expansion->across.acceleration < rates_.axis->across.acceleration))
            rates_.axis = {algebra::cast<Wide>(axis), expansion->across};
    };
    const Vector3<double> turn = turn_between(ends.start, ends.goal).v;
    if (const double size = length(turn); size > 0)
        return try_axis(scale(turn, 1 / size));
    for (const Vector3<double>& axis : {Vector3<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
        try_axis(axis);
}

double SmoothPiece::time_at(double tau) const {
    return tau == 1 ? times_.upper : times_.lower + tau * (times_.upper - times_.lower);
}

/// The rates of a part alone.
SmoothPiece::Rates SmoothPiece::rates_of(const Bracket& times) const {
    const MovingFrame& frame = *motion_.relative;
    if (rates_.axis)
        if (const auto expansion = frame.expansion_about(in_double(rates_.axis->direction), times))
            return {expansion->all.bounds, Axis{rates_.axis->direction, expansion->across}};
    return {frame.rates(times), {}};
}

/// Of a part in double-double. An axis that is known as well leaves nothing but its rounding across it.
SmoothPiece::Rates SmoothPiece::refined_rates_of(const Bracket& times) const {
    const auto axis = motion_.relative->refined_axis(times);
    if (!axis)
        return rates_of(times);
    constexpr double off = axis_rounding<Wide>;
    const RateBounds bounds = motion_.relative->rates(times);
    return {bounds, Axis{*axis, {off * bounds.turn_rate, off * bounds.turn_acceleration, off * bounds.acceleration}}};
}

/// The rates of a part cost as much as two poses in double, so those of the piece serve all parts there. Refined poses
/// cost far more, and the rates of a short part may be far smaller: where a motion comes to rest, and where a contact
/// grazes.
template <class S>
EnclosureBounds SmoothPiece::bounds(const Bracket& part) const {
    if (std::is_same_v<S, double> && are_finite(rates_.bounds))
        return bounds_by<S>(rates_, part);
    const Bracket times{time_at(part.lower), time_at(part.upper)};
    return bounds_by<S>(std::is_same_v<S, double> ? rates_of(times) : refined_rates_of(times), part);
}

/// A body that is fast for a short while is displaced by the rounding of times.
template <class S>
EnclosureBounds SmoothPiece::bounds_by(const Rates& all, const Bracket& part) const {
    const MovingFrame& frame = *motion_.relative;
    const RateBounds& rates = all.bounds;
    const double duration = (part.upper - part.lower) * (times_.upper - times_.lower) + rounding_of_times<double>;
    EnclosureBounds bounds =
        enclosure_bounds(reference_, rates, duration, pose_rounding<S> * frame.rounding(), frame.size());
    const double shift = rates.speed * rounding_of_times<S>;
    const double turn = rates.turn_rate * rounding_of_times<S>;
    bounds.rounding += shift;
    bounds.deviation += shift;
    bounds.turn_rounding += turn;
    bounds.turn_deviation += turn;
    if (all.axis)
        bounds.along = bounds_along(all.axis->direction, all.axis->across, rates.turn_rate, duration, bounds,
                                    0.25 * axis_rounding<S>);
    return bounds;
}

Enclosure<double> SmoothPiece::enclosed(const Bracket& part) const {
    const MovingFrame& frame = *motion_.relative;
    const PartEnds<double> ends{latest_.at(frame, time_at(part.lower)), latest_.at(frame, time_at(part.upper))};
    return {sweep_between_ends(ends, reference_), bounds<double>(part)};
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
    return Enclosure<Wide>{sweep_between_ends(ends, frame.refined_reference()), bounds<Wide>(part)};
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

const std::vector<Section>& Sections::all() const {
    std::call_once(is_made_, [this] { make(); });
    return sections_;
}

std::shared_ptr<const std::vector<AxisSpan>> Sections::axis_spans() const {
    std::call_once(axis_is_known_, [this] {
        axis_spans_ = std::make_shared<const std::vector<AxisSpan>>(motion::axis_spans(frame_->axis_sections()));
    });
    return axis_spans_;
}

void Sections::make() const {
    std::vector<double> cuts;
    frame_->add_cuts(cuts);
    std::erase_if(cuts, [](double cut) { return !(0 < cut && cut < 1); });
    cuts.push_back(1);
    chasles::sort(cuts);
    sections_.clear(); // the first try may have ended in an error
    const MadeSections made{sections_};
    Bracket times{0, 0};
    PartEnds<double> poses{{}, frame_->at(0)};
    for (const double cut : cuts) {
        if (cut == times.upper)
            continue; // twice the same
        times = {times.upper, cut};
        poses = {poses.goal, frame_->at(cut)};
        append_sections(*frame_, times, poses, made);
    }
}

std::unique_ptr<const AnyPieces> SmoothPieces::axis_pieces() const {
    return motion::axis_pieces(motion_, sections_->axis_spans());
}

/// From any place, the point is never farther than half of the way of a section and half of the way to its ends. Nor is
/// it farther than the farther end, and how far the point leaves its chord.
PathBall SmoothTrajectory::ball_around_path(const Vector3<double>& point) const {
    const MovingFrame& frame = *motion_.relative;
    const std::vector<Section>& sections = sections_->all();
    const double arm = length(point - frame.reference());
    const Vector3<double> first = placed(sections.front().ends.start, point);
    const Vector3<double> centre = scale(first + placed(sections.back().ends.goal, point), 0.5);
    double radius = 0;
    double start = length(first - centre);
    for (const auto& [times, rates, ends] : sections) {
        const double duration = times.upper - times.lower;
        const double goal = length(placed(ends.goal, point) - centre);
        const double by_speed = 0.5 * (start + goal + rates.speed_at(arm) * duration);
        const double by_acceleration = std::max(start, goal) + 0.125 * rates.acceleration_at(arm) * duration * duration;
        radius = std::max(radius, std::min(by_speed, by_acceleration));
        start = goal;
    }
    return {centre, radius, frame.size() + norm1(point)};
}

/// Few sections have a coarse motion each; many have one in common.
std::size_t SmoothTrajectory::coarse_count() const {
    constexpr std::size_t few = 8;
    const std::size_t count = sections_->all().size();
    return count <= few ? count : 1;
}

std::optional<CoarseMotion> SmoothTrajectory::coarse(std::size_t part) const {
    const std::vector<Section>& sections = sections_->all();
    return coarse_count() == sections.size() ? coarse_over(sections[part]) : coarse_over(whole_of(sections));
}

std::optional<CoarseMotion> SmoothTrajectory::coarse_over(const Section& section) const {
    const auto& [times, rates, ends] = section;
    const MovingFrame& frame = *motion_.relative;
    return coarse_part({ends, frame.reference(), rates, times.upper - times.lower,
                        pose_rounding<double> * frame.rounding(), frame.size()});
}

Pose SmoothTrajectory::pose_at(double time) const {
    return public_pose(motion_.moving->at(std::clamp(time, 0.0, 1.0)));
}

Pose SmoothTrajectory::fixed_pose_at(double time) const {
    return motion_.fixed ? public_pose(motion_.fixed->at(std::clamp(time, 0.0, 1.0))) : Pose();
}

SharedTrajectory SmoothTrajectory::reversed() const {
    SmoothMotion back = SmoothMotion::of_one(reversed_frame(motion_.relative));
    if (motion_.fixed)
        back = {.relative = back.relative,
                .moving = reversed_frame(motion_.moving),
                .fixed = reversed_frame(motion_.fixed)};
    return std::make_shared<const ErasedTrajectory<SmoothTrajectory>>(SmoothTrajectory(std::move(back)));
}

} // namespace chasles::motion
