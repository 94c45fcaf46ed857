// A third motion, which the library does not know: the origin of the moving body runs straight and evenly while the
// body turns evenly about one axis ("slerp and lerp"). Its pieces are as long as the caller says, and each is a sweep
// that leaves the true motion by a stated deviation.
#pragma once

#include "chasles/motion/motion.h"
#include "chasles/motion/sweep_trajectory.h"

#include <memory>
#include <utility>
#include <vector>

namespace chasles::test {

/// The true motion between two poses, over time in [0, 1].
struct EvenTurn {
    Pose start;
    Pose goal;

    [[nodiscard]] double angle() const {
        return Eigen::Quaterniond(start.rotation.normalized()).angularDistance(goal.rotation.normalized());
    }
    [[nodiscard]] Pose at(double time) const {
        const Eigen::Quaterniond from(start.rotation.normalized());
        const Eigen::Quaterniond to(goal.rotation.normalized());
        return Pose((1 - time) * start.translation + time * goal.translation, from.slerp(time, to));
    }
};

/// The part [from, to] of the time of an even turn: the sweep between the true poses at both ends.
class EvenTurnPiece {
public:
    /// `radius`: of a ball around the body's origin that holds the body.
    EvenTurnPiece(const EvenTurn& whole, double from, double to, double radius)
        : whole_(whole), from_(from), to_(to), radius_(radius),
          sweep_(motion::MotionEnds::between(whole.at(from), whole.at(to)), Eigen::Vector3d::Zero()) {}

    [[nodiscard]] const motion::RationalMotion<algebra::DoubleDouble>& cubic() const { return sweep_.cubic(); }
    [[nodiscard]] std::optional<motion::ExactMotion> exact() const { return std::nullopt; }

    /// Two paths with the same ends over a duration h, with accelerations of at most A and B, are h^2 / 8 (A + B) apart
    /// at most: so far each may leave the common chord. Let the piece turn by phi. The truth turns evenly about an
    /// origin that runs evenly: h^2 A = phi^2 r. The origin of the sweep runs just so; its angle is 2 atan(s k) and a
    /// constant, with k = tan(phi / 4) and s = 2 tau - 1. The rate of the angle is at most 4 k and that rate's at most
    /// 16 k^3, so h^2 B <= (16 k^2 + 16 k^3) r. A point of the fixed body that meets the moving body is within r of its
    /// origin, too. The last term covers the rounding of poses.
    [[nodiscard]] double deviation() const {
        const double phi = whole_.angle() * (to_ - from_);
        const double k = std::tan(phi / 4);
        const double size = radius_ + whole_.start.translation.norm() + whole_.goal.translation.norm();
        return (phi * phi + 16 * k * k + 16 * k * k * k) * radius_ / 8 + 1e-14 * size;
    }
    [[nodiscard]] motion::ChordDeviation chord_deviation(const motion::Ball& moving, const motion::Ball& fixed) const {
        return sweep_.chord_deviation(moving, fixed);
    }

    [[nodiscard]] Bracket time_of(const Bracket& tau) const {
        constexpr double rounding = 0x1p-50;
        return {std::max(0.0, time_at(tau.lower) * (1 - rounding)), std::min(1.0, time_at(tau.upper) * (1 + rounding))};
    }
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return time_of(tau); }
    [[nodiscard]] double tau_rate(double) const { return 1 / (to_ - from_); }
    [[nodiscard]] double tau_tolerance(double time_tolerance) const {
        return std::min(1.0, time_tolerance / (to_ - from_));
    }
    [[nodiscard]] Pose pose_at(double tau) const { return whole_.at(time_at(tau)); }
    [[nodiscard]] static Pose fixed_pose_at(double) { return {}; }

    [[nodiscard]] double time_at(double tau) const { return tau == 1 ? to_ : from_ + tau * (to_ - from_); }

private:
    EvenTurn whole_;
    double from_;
    double to_;
    double radius_;
    motion::SweepPiece sweep_;
};

/// An even turn in pieces that end at given times.
class ConstantVelocity {
public:
    /// `ends`: the ends of the pieces in ascending order, the last one 1. `radius`: of the body, around its origin.
    ConstantVelocity(const EvenTurn& whole, std::vector<double> ends, double radius)
        : whole_(whole), ends_(std::move(ends)), radius_(radius) {}

    class Pieces {
    public:
        explicit Pieces(const ConstantVelocity& motion) : motion_(motion) {}
        [[nodiscard]] std::size_t size() const { return motion_.ends_.size(); }
        [[nodiscard]] EvenTurnPiece operator[](std::size_t index) const { return motion_.piece(index); }

    private:
        const ConstantVelocity& motion_;
    };

    [[nodiscard]] Pieces pieces() const { return Pieces(*this); }
    [[nodiscard]] motion::PathBall ball_around_path(const motion::Vector3<double>& point) const {
        const Eigen::Vector3d& from = whole_.start.translation;
        const Eigen::Vector3d& to = whole_.goal.translation;
        return {motion::vector_in<double>((from + to) / 2), (to - from).norm() / 2 + length(point),
                from.lpNorm<1>() + to.lpNorm<1>() + norm1(point)};
    }
    [[nodiscard]] static std::optional<motion::CoarseMotion> coarse() { return std::nullopt; }
    [[nodiscard]] Pose pose_at(double time) const { return whole_.at(time); }
    [[nodiscard]] static Pose fixed_pose_at(double) { return {}; }

    [[nodiscard]] EvenTurnPiece piece(std::size_t index) const {
        return {whole_, index == 0 ? 0 : ends_[index - 1], ends_[index], radius_};
    }
    /// The piece that holds a time.
    [[nodiscard]] EvenTurnPiece piece_of(double time) const {
        std::size_t index = 0;
        while (ends_[index] < time)
            ++index;
        return piece(index);
    }
    [[nodiscard]] const EvenTurn& whole() const { return whole_; }

private:
    EvenTurn whole_;
    std::vector<double> ends_;
    double radius_;
};

inline Motion motion_of(const ConstantVelocity& trajectory) {
    return Motion(std::make_shared<const motion::ErasedTrajectory<ConstantVelocity>>(trajectory));
}

} // namespace chasles::test
