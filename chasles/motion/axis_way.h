// Where a motion about or along one axis is cut: where it turns back, and after turns that are large.
// Source: docs/derivations/35-one-axis.md, "Stops".
#pragma once

#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/axis_motion.h"

#include <memory>
#include <vector>

namespace chasles::motion {

/// Where the way of a piece begins or ends.
struct AxisStop {
    double time = 0;               ///< of the motion
    algebra::DoubleDouble value{}; ///< radians, or lengths of the direction
    bool is_slow = false;          ///< the value all but rests near this time
    HalfTurn place;                ///< without rounding, near the value; its sine is the value for a slide
    algebra::SineCosine<algebra::DoubleDouble> rounded{}; ///< likewise, for a direction of unit length
};

/// The numbers of an axis motion, each rounded once to double-double.
struct AxisNumbers {
    explicit AxisNumbers(const AxisMotion& motion);

    Vector3<algebra::DoubleDouble> direction;   ///< of unit length for a turn
    Vector3<algebra::DoubleDouble> place;       ///< of the body's origin at the value 0
    Vector3<algebra::DoubleDouble> arm;         ///< to the place from the nearest point of the line, for a turn
    Quaternion<algebra::DoubleDouble> rotation; ///< of the body at the value 0, of unit length
};

/// A section in both forms.
struct AxisWay {
    explicit AxisWay(AxisSection given) : section(std::move(given)), rounded(section.motion) {}

    AxisSection section;
    AxisNumbers rounded;
};

/// A part of the way along which the value rises, falls or stays.
struct AxisSpan {
    std::shared_ptr<const AxisWay> way;
    AxisStop start;
    AxisStop goal;
};

/// The spans of all sections in order of time. Empty if there are none, or if the value turns back too often.
std::vector<AxisSpan> axis_spans(std::vector<AxisSection> sections);

/// From the time at which the polynomial has the value `first` to that of `last`, rounded outward, in an interval of
/// its time in which it rises or falls. `first` comes first.
Bracket times_at(const TimePolynomial& polynomial, const algebra::DoubleDouble& first,
                 const algebra::DoubleDouble& last, const Bracket& times);

} // namespace chasles::motion
