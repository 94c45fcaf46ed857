// Reads arguments from the numbers that JavaScript wrote: poses, motions, options.
#pragma once

#include "chasles/query/first_contact.h"
#include "chasles/query/least_distance.h"
#include "chasles/query/profile.h"
#include "view/motion_numbers.h"

#include <optional>
#include <span>
#include <vector>

namespace chasles::javascript {

/// Takes numbers one after another. Throws InvalidInput when there are no more, and for a number that is not what it
/// should be.
class NumbersIn {
public:
    explicit NumbersIn(std::span<const double> numbers) : rest_(numbers) {}

    double number();
    /// A whole number from 0 to `most`.
    std::size_t whole(std::size_t most);
    std::span<const double> some(std::size_t count);
    bool flag() { return whole(1) == 1; }
    /// A flag, and three numbers if it is set. `name` is the name in messages.
    std::optional<Eigen::Vector3d> point(const char* name);
    /// A count, and so many numbers.
    Pose pose(const std::string& name);
    /// A count, and so many poses.
    std::vector<Pose> poses(const std::string& name);
    /// A time of a motion, in [0, 1].
    double time();

private:
    std::span<const double> rest_;
};

/// How a body goes from one pose to the next.
struct MotionRule {
    view::MotionKind kind = view::MotionKind::screw;
    double max_turn = ScrewMotion::default_max_turn; ///< of a screw, radians
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// The motion of a query, with the numbers that an answer shows.
struct NamedMotion {
    Motion motion;
    view::MotionNumbers numbers;
};

/// A kind, a flag with a greatest turn, and a point. Throws InvalidInput for a centre of a motion that has none.
MotionRule rule_in(NumbersIn& in);
NamedMotion motion_between(const MotionRule& rule, const Pose& start, const Pose& goal);
/// A rule, start and goal, and a flag with both poses and the centre of the fixed body.
NamedMotion motion_in(NumbersIn& in);
/// The motion of a body in a scene: a rule and a form, which says what follows (`WorldForm` in the source).
Motion world_motion_in(NumbersIn& in);
/// Margin, a flag with hold, time tolerance and what to find.
QueryOptions options_in(NumbersIn& in);
/// Tolerance, time tolerance and what to find.
LeastDistanceOptions least_options_in(NumbersIn& in);
/// Tolerance, absolute tolerance, time tolerance, a count of margins and so many.
ProfileOptions profile_options_in(NumbersIn& in);

} // namespace chasles::javascript
