// A motion that does not say how its pieces enclose it must not count as a motion that follows them exactly.
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion.h"

namespace {

using namespace chasles;

struct Piece {
    [[nodiscard]] const motion::RationalMotion<algebra::DoubleDouble>& cubic() const { return path; }
    [[nodiscard]] static std::optional<motion::ExactMotion> exact() { return std::nullopt; }
#ifndef MISUSE
    [[nodiscard]] static std::optional<motion::Enclosure<double>> enclosure(const Bracket&) { return std::nullopt; }
#endif
    [[nodiscard]] static std::optional<motion::Enclosure<algebra::DoubleDouble>> refined_enclosure(const Bracket&) {
        return std::nullopt;
    }
    [[nodiscard]] static bool is_refined() { return false; }
    [[nodiscard]] static Bracket time_of(const Bracket& tau) { return tau; }
    [[nodiscard]] static Bracket tau_of(const Bracket& tau) { return tau; }
    [[nodiscard]] static double tau_rate(double) { return 1; }
    [[nodiscard]] static double tau_tolerance(double time_tolerance) { return time_tolerance; }
    [[nodiscard]] static Pose pose_at(double) { return {}; }
    [[nodiscard]] static Pose fixed_pose_at(double) { return {}; }

    motion::RationalMotion<algebra::DoubleDouble> path;
};

struct Trajectory {
    struct Pieces {
        [[nodiscard]] static std::size_t size() { return 1; }
        [[nodiscard]] Piece operator[](std::size_t) const { return {}; }
    };
    [[nodiscard]] static Pieces pieces() { return {}; }
    [[nodiscard]] static motion::PathBall ball_around_path(const motion::Vector3<double>& point) { return {point}; }
    [[nodiscard]] static std::size_t coarse_count() { return 1; }
    [[nodiscard]] static std::optional<motion::CoarseMotion> coarse(std::size_t) { return std::nullopt; }
    [[nodiscard]] static Pose pose_at(double) { return {}; }
    [[nodiscard]] static Pose fixed_pose_at(double) { return {}; }
    [[nodiscard]] static motion::SharedTrajectory reversed() { return nullptr; }
};

} // namespace

Motion motion_of(const Trajectory& trajectory) {
    return Motion(std::make_shared<const motion::ErasedTrajectory<Trajectory>>(trajectory));
}
