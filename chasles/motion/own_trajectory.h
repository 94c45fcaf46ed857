// Trajectories of the user's own: a function for poses and a function for bounds of their rates.
#pragma once

#include "chasles/base/export.h"
#include "chasles/motion/pose.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace chasles {

/// Bounds during an interval of time, per unit of the time in [0, 1] of the whole motion. If an acceleration is not
/// known, it stays infinite: then the query takes more steps, as the speed alone bounds how far the body is from a
/// straight way.
struct MotionBounds {
    double turn_rate = 0;                                               ///< of the angular velocity, radians
    double turn_acceleration = std::numeric_limits<double>::infinity(); ///< of the angular acceleration, radians
    double speed = 0;                                                   ///< of the reference point, mesh unit
    double acceleration = std::numeric_limits<double>::infinity();      ///< of the reference point, mesh unit
};

/// A motion over time in [0, 1] that the library does not know. The proof of a query holds if the bounds do: see
/// find_broken_bound(). Every thread that queries the motion calls the functions. An exception of a function reaches
/// the caller of the query.
struct OwnTrajectory {
    /// The pose of the moving body in the frame of the fixed body, at a time in [0, 1].
    std::function<Pose(double time)> pose_at;
    /// Bounds that hold from one time to another, within [0, 1]. The interval has no knot inside. The tighter the
    /// bounds for short intervals, the fewer steps a query takes.
    std::function<MotionBounds(double from, double to)> bounds;
    /// The point of the moving body, in its frame, whose speed and acceleration are bounded. Best where it accelerates
    /// least.
    Eigen::Vector3d reference = Eigen::Vector3d::Zero();
    /// Times in (0, 1) at which velocities jump.
    std::vector<double> knots;
    /// A bound of the error of poses by rounding: of their unit quaternions, and of their translations over their size.
    /// The default is 64 units of rounding.
    double rounding = 0x1p-47;
};

/// A bound that does not hold.
struct BrokenBound {
    std::string bound; ///< the name in MotionBounds
    double from = 0;   ///< the interval
    double to = 0;
    double at = 0;     ///< the time in it at which it breaks
    double stated = 0; ///< the bound
    double found = 0;  ///< what the poses show, at least
};

/// Samples the poses of a trajectory at random times and compares them with its bounds. Returns the first bound that it
/// finds broken. Empty is no proof. 2,000 intervals take some milliseconds for simple functions. Throws InvalidInput
/// for a bound that is negative or NaN, for a knot outside of (0, 1), and if a function is missing.
CHASLES_EXPORT std::optional<BrokenBound> find_broken_bound(const OwnTrajectory& trajectory, int intervals = 2000,
                                                            std::uint64_t seed = 1);

} // namespace chasles
