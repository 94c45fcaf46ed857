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
    EvenTurnPiece(const EvenTurn& whole, double from, double to)
        : whole_(whole), from_(from), to_(to),
          sweep_(motion::MotionEnds::between(whole.at(from), whole.at(to)), Eigen::Vector3d::Zero()) {}

    [[nodiscard]] const motion::RationalMotion<algebra::DoubleDouble>& cubic() const { return sweep_.cubic(); }
    [[nodiscard]] std::optional<motion::ExactMotion> exact() const { return std::nullopt; }

    /// Two paths with the same ends over a duration h, with accelerations of at most A and B, are h^2 / 8 (A + B) apart
    /// at most: so far each may leave the common chord. Let the part turn by phi. The truth turns evenly about an
    /// origin that runs evenly: at a distance of 1, h^2 A = phi^2. The origin of the sweep runs just so; its angle is
    /// 2 atan(s k) and a constant, with k = tan(phi / 4) and s = 2 tau - 1. The rate of the angle is at most 4 k and
    /// that rate's at most 16 k^3, so h^2 B <= 16 k^2 + 16 k^3. The other terms cover the rounding of poses.
    [[nodiscard]] std::optional<motion::Enclosure<double>> enclosure(const Bracket& part) const {
        const Pose start = whole_.at(time_at(part.lower));
        const Pose goal = whole_.at(time_at(part.upper));
        const double share = (time_at(part.upper) - time_at(part.lower)) + 1e-15;
        const double phi = whole_.angle() * share;
        const double k = std::tan(phi / 4);
        const double size = whole_.start.translation.norm() + whole_.goal.translation.norm();
        motion::EnclosureBounds bounds;
        bounds.turn = phi;
        bounds.travel = (whole_.goal.translation - whole_.start.translation).norm() * share;
        bounds.rounding = 1e-14 * size;
        bounds.turn_rounding = 1e-14;
        bounds.deviation = bounds.rounding;
        bounds.turn_deviation = (phi * phi + 16 * k * k + 16 * k * k * k) / 8 + bounds.turn_rounding;
        const motion::SweepPiece sweep(motion::MotionEnds::between(start, goal), Eigen::Vector3d::Zero());
        return motion::Enclosure<double>{rounded(sweep.cubic()), bounds};
    }
    [[nodiscard]] static std::optional<motion::Enclosure<algebra::DoubleDouble>> refined_enclosure(const Bracket&) {
        return std::nullopt;
    }
    [[nodiscard]] static bool is_refined() { return false; }

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
    motion::SweepPiece sweep_;
};

/// An even turn in pieces that end at given times.
class EvenTurnMotion {
public:
    /// `ends`: the ends of the pieces in ascending order, the last one 1.
    EvenTurnMotion(const EvenTurn& whole, std::vector<double> ends) : whole_(whole), ends_(std::move(ends)) {}

    class Pieces {
    public:
        explicit Pieces(const EvenTurnMotion& motion) : motion_(motion) {}
        [[nodiscard]] std::size_t size() const { return motion_.ends_.size(); }
        [[nodiscard]] EvenTurnPiece operator[](std::size_t index) const { return motion_.piece(index); }

    private:
        const EvenTurnMotion& motion_;
    };

    [[nodiscard]] Pieces pieces() const { return Pieces(*this); }
    [[nodiscard]] motion::PathBall ball_around_path(const motion::Vector3<double>& point) const {
        const Eigen::Vector3d& from = whole_.start.translation;
        const Eigen::Vector3d& to = whole_.goal.translation;
        return {motion::vector_in<double>((from + to) / 2), (to - from).norm() / 2 + length(point),
                from.lpNorm<1>() + to.lpNorm<1>() + norm1(point)};
    }
    [[nodiscard]] static std::size_t coarse_count() { return 1; }
    [[nodiscard]] static std::optional<motion::CoarseMotion> coarse(std::size_t) { return std::nullopt; }
    [[nodiscard]] Pose pose_at(double time) const { return whole_.at(time); }
    [[nodiscard]] static Pose fixed_pose_at(double) { return {}; }
    [[nodiscard]] static motion::SharedTrajectory reversed() { return nullptr; } // no test asks for it
    [[nodiscard]] static motion::MotionDescription description() { return {}; }

    [[nodiscard]] EvenTurnPiece piece(std::size_t index) const {
        return {whole_, index == 0 ? 0 : ends_[index - 1], ends_[index]};
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
};

inline Motion motion_of(const EvenTurnMotion& trajectory) {
    return Motion(std::make_shared<const motion::ErasedTrajectory<EvenTurnMotion>>(trajectory));
}

} // namespace chasles::test
