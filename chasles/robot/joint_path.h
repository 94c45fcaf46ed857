// How the joints of a robot move: segments of time, in each of which every variable is a polynomial.
// Source: docs/derivations/29-robots.md.
#pragma once

#include "chasles/base/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace chasles {

class Robot;
struct RobotVariable;

/// Values of all variables of a robot, in the order of Robot::variables(): radians, or the mesh unit.
using Configuration = Eigen::VectorXd;

/// A path of a robot in joint space. The polynomials of a segment have the time of the segment, from 0 to 1.
class CHASLES_EXPORT JointPath {
public:
    /// How the polynomials follow from the knots: the configurations that the path was made of, at the ends of its
    /// segments.
    enum class Knots : std::uint8_t {
        none,           ///< a path of polynomials, or of several robots
        straight,       ///< each segment by the two knots at its ends
        cubic,          ///< likewise, for given velocities
        quintic,        ///< likewise, for given velocities and accelerations
        natural_spline, ///< each segment by all knots
    };

    struct Segment {
        double begin = 0; ///< time stamp
        double end = 1;   ///< likewise; later
        /// coefficients(k, i) belongs to the k-th power of time and to variable i.
        Eigen::MatrixXd coefficients;
        /// What rounding has taken from the coefficients; empty: nothing.
        Eigen::MatrixXd remainders = {};
    };

    /// Straight in joint space from each configuration to the next: what planners call edges. Continuous joints go the
    /// shorter way round, and floating ones turn evenly about one axis. Segment k has the stamps k and k + 1.
    ///
    /// Throws InvalidInput "path: configuration I: WHY" for fewer than two configurations, a wrong number of values,
    /// NaN, infinity, a value beyond 1000 in magnitude, or a quaternion that is zero. Limits of joints are not checked.
    /// The bounds of sines and cosines hold up to 1000 radians.
    static JointPath straight(const Robot& robot, std::span<const Configuration> configurations);
    /// Likewise, with the stamps of the configurations. Throws InvalidInput, too, where they do not ascend.
    static JointPath straight(const Robot& robot, std::span<const Configuration> configurations,
                              std::span<const double> times);
    /// Cubic Hermite splines: through positions at times, with velocities (value per unit of time). What controllers
    /// make of trajectories with positions and velocities. Values are taken as they are, also those of continuous
    /// joints. Throws InvalidInput for robots with floating joints, too.
    static JointPath cubic(const Robot& robot, std::span<const double> times, std::span<const Configuration> positions,
                           std::span<const Configuration> velocities);
    /// Likewise with quintic splines, for trajectories with accelerations.
    static JointPath quintic(const Robot& robot, std::span<const double> times,
                             std::span<const Configuration> positions, std::span<const Configuration> velocities,
                             std::span<const Configuration> accelerations);
    /// The natural cubic spline through configurations: smooth in velocity and acceleration.
    static JointPath natural_spline(const Robot& robot, std::span<const double> times,
                                    std::span<const Configuration> positions);
    /// Any polynomials. Throws InvalidInput for floating joints, and for a segment that does not begin where the one
    /// before ends (1e-9 of the sizes, or a few roundings of its terms).
    static JointPath polynomials(const Robot& robot, std::vector<Segment> segments);

    /// By the names of robots: a path, or the configuration at which the robot rests.
    using OfRobots = std::map<std::string, std::variant<JointPath, Configuration>>;
    /// The path of a cell (Robot::together) whose robots have a path each, with stamps of their own. It has a segment
    /// between each stamp and the next one of any robot. A robot rests before its path begins, and after it ends.
    /// Throws InvalidInput for a robot that is not named, an unknown name, a path of another robot, and if all robots
    /// rest. Source: docs/derivations/42-several-robots.md.
    static JointPath together(const Robot& cell, const OfRobots& paths);

    [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }
    [[nodiscard]] Knots knots() const { return knots_; }
    /// The configuration at a stamp; outside of the path, at its nearer end.
    [[nodiscard]] Configuration at(double stamp) const;

    /// For the library's own use: what a path consists of, and a path of such parts, which are not checked.
    [[nodiscard]] const std::vector<std::size_t>& quaternions() const { return quaternions_; }
    /// The variables of the robot that the path was made for; null if they are not known.
    using Variables = std::shared_ptr<const std::vector<RobotVariable>>;
    [[nodiscard]] const Variables& variables() const { return variables_; }
    static JointPath of_parts(std::vector<Segment> segments, std::vector<std::size_t> quaternions,
                              Variables variables = {}, Knots knots = Knots::none) {
        return {std::move(segments), std::move(quaternions), std::move(variables), knots};
    }

private:
    JointPath(std::vector<Segment> segments, std::vector<std::size_t> quaternions, Variables variables, Knots knots)
        : segments_(std::move(segments)), quaternions_(std::move(quaternions)), variables_(std::move(variables)),
          knots_(knots) {}

    std::vector<Segment> segments_;
    std::vector<std::size_t> quaternions_; ///< of floating joints: the first one of four variables
    Variables variables_;
    Knots knots_ = Knots::none;
};

} // namespace chasles
