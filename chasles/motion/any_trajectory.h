// Any trajectory behind one type, so that searches are compiled once. With `MovingFrame` the only virtual functions of
// the library.
#pragma once

#include "chasles/motion/motion_description.h"
#include "chasles/motion/moving_frame.h"
#include "chasles/motion/trajectory.h"

#include <memory>

namespace chasles::motion {

/// A piece of any trajectory.
class AnyPiece {
public:
    virtual ~AnyPiece() = default;

    [[nodiscard]] virtual const RationalMotion<algebra::DoubleDouble>& cubic() const = 0;
    [[nodiscard]] virtual std::optional<ExactMotion> exact() const = 0;
    [[nodiscard]] virtual std::optional<Enclosure<double>> enclosure(const Bracket& part) const = 0;
    [[nodiscard]] virtual std::optional<Enclosure<algebra::DoubleDouble>>
    refined_enclosure(const Bracket& part) const = 0;
    [[nodiscard]] virtual bool is_refined() const = 0;
    [[nodiscard]] virtual Bracket time_of(const Bracket& tau) const = 0;
    [[nodiscard]] virtual Bracket tau_of(const Bracket& tau) const = 0;
    [[nodiscard]] virtual double tau_rate(double tau) const = 0;
    [[nodiscard]] virtual double tau_tolerance(double time_tolerance) const = 0;
    [[nodiscard]] virtual Pose pose_at(double tau) const = 0;
    [[nodiscard]] virtual Pose fixed_pose_at(double tau) const = 0;
};

/// The pieces of any trajectory, in order of time.
class AnyPieces {
public:
    virtual ~AnyPieces() = default;
    [[nodiscard]] virtual std::size_t size() const = 0;
    [[nodiscard]] virtual std::unique_ptr<const AnyPiece> at(std::size_t index) const = 0;
};

class AnyTrajectory;
using SharedTrajectory = std::shared_ptr<const AnyTrajectory>;

class AnyTrajectory {
public:
    virtual ~AnyTrajectory() = default;
    [[nodiscard]] virtual std::unique_ptr<const AnyPieces> pieces() const = 0;
    [[nodiscard]] virtual PathBall ball_around_path(const Vector3<double>& point) const = 0;
    [[nodiscard]] virtual std::size_t coarse_count() const = 0;
    [[nodiscard]] virtual std::optional<CoarseMotion> coarse(std::size_t part = 0) const = 0;
    [[nodiscard]] virtual Pose pose_at(double time) const = 0;
    [[nodiscard]] virtual Pose fixed_pose_at(double time) const = 0;
    /// The moving body in the world as a frame, for products; null if it is none.
    [[nodiscard]] virtual SharedFrame frame() const = 0;
    /// The sum of the sizes of all lengths that enter the poses of a motion of a kind that is enclosed, though this one
    /// may go about or along one axis; mesh unit. 0 for other kinds.
    [[nodiscard]] virtual double size() const = 0;
    /// The ends of a motion in the world that is straight and even, without a turn; null for others.
    [[nodiscard]] virtual const MotionEnds* straight_ends() const = 0;
    /// The motion of the same kind to another goal, whose `pose_at` is the moving body in the world; null if the motion
    /// has no goal. A screw keeps the number of its pieces.
    [[nodiscard]] virtual SharedTrajectory with_goal(const Pose& goal_in_world) const = 0;
    /// The motion back; null for the paper's screw.
    [[nodiscard]] virtual SharedTrajectory reversed() const = 0;
    [[nodiscard]] virtual MotionDescription description() const = 0;
};

/// A piece of a known type as AnyPiece.
template <TrajectoryPiece P>
class ErasedPiece final : public AnyPiece {
public:
    explicit ErasedPiece(P piece) : piece_(std::move(piece)) {}
    /// One piece of a sequence, without a copy.
    template <class Pieces>
    ErasedPiece(const Pieces& pieces, std::size_t index) : piece_(pieces[index]) {}

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const override { return piece_.cubic(); }
    [[nodiscard]] std::optional<ExactMotion> exact() const override { return piece_.exact(); }
    [[nodiscard]] std::optional<Enclosure<double>> enclosure(const Bracket& part) const override {
        return piece_.enclosure(part);
    }
    [[nodiscard]] std::optional<Enclosure<algebra::DoubleDouble>>
    refined_enclosure(const Bracket& part) const override {
        return piece_.refined_enclosure(part);
    }
    [[nodiscard]] bool is_refined() const override { return piece_.is_refined(); }
    [[nodiscard]] Bracket time_of(const Bracket& tau) const override { return piece_.time_of(tau); }
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const override { return piece_.tau_of(tau); }
    [[nodiscard]] double tau_rate(double tau) const override { return piece_.tau_rate(tau); }
    [[nodiscard]] double tau_tolerance(double time_tolerance) const override {
        return piece_.tau_tolerance(time_tolerance);
    }
    [[nodiscard]] Pose pose_at(double tau) const override { return piece_.pose_at(tau); }
    [[nodiscard]] Pose fixed_pose_at(double tau) const override { return piece_.fixed_pose_at(tau); }

private:
    P piece_;
};

/// A trajectory of a known type as AnyTrajectory. To be held by a shared pointer: `Motion` does.
template <Trajectory T>
class ErasedTrajectory final : public AnyTrajectory {
public:
    explicit ErasedTrajectory(T trajectory) : trajectory_(std::move(trajectory)) {}

    [[nodiscard]] const T& get() const { return trajectory_; }

    [[nodiscard]] std::unique_ptr<const AnyPieces> pieces() const override {
        TypedPieces pieces = trajectory_.pieces();
        if constexpr (may_be_enclosed)
            if (std::unique_ptr<const AnyPieces> axis_pieces = pieces.axis_pieces())
                return axis_pieces;
        return std::make_unique<Pieces>(std::move(pieces));
    }
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const override {
        return trajectory_.ball_around_path(point);
    }
    [[nodiscard]] std::size_t coarse_count() const override { return trajectory_.coarse_count(); }
    [[nodiscard]] std::optional<CoarseMotion> coarse(std::size_t part) const override {
        return trajectory_.coarse(part);
    }
    [[nodiscard]] Pose pose_at(double time) const override { return trajectory_.pose_at(time); }
    [[nodiscard]] Pose fixed_pose_at(double time) const override { return trajectory_.fixed_pose_at(time); }
    [[nodiscard]] SharedFrame frame() const override {
        if constexpr (requires { trajectory_.frame(); })
            return trajectory_.frame();
        else
            return nullptr;
    }
    [[nodiscard]] double size() const override {
        if constexpr (may_be_enclosed)
            return trajectory_.size();
        else
            return 0;
    }
    [[nodiscard]] const MotionEnds* straight_ends() const override {
        if constexpr (requires { trajectory_.straight_ends(); })
            return trajectory_.straight_ends();
        else
            return nullptr;
    }
    [[nodiscard]] SharedTrajectory with_goal(const Pose& goal_in_world) const override {
        if constexpr (requires { trajectory_.with_goal(goal_in_world); })
            return trajectory_.with_goal(goal_in_world);
        else
            return nullptr;
    }
    [[nodiscard]] SharedTrajectory reversed() const override { return trajectory_.reversed(); }
    [[nodiscard]] MotionDescription description() const override { return trajectory_.description(); }

private:
    using TypedPieces = decltype(std::declval<const T&>().pieces());
    using TypedPiece = std::remove_cvref_t<decltype(std::declval<const TypedPieces&>()[0])>;
    static constexpr bool may_be_enclosed = requires(const TypedPieces& pieces) { pieces.axis_pieces(); };

    class Pieces final : public AnyPieces {
    public:
        explicit Pieces(TypedPieces pieces) : pieces_(std::move(pieces)) {}
        [[nodiscard]] std::size_t size() const override { return pieces_.size(); }
        [[nodiscard]] std::unique_ptr<const AnyPiece> at(std::size_t index) const override {
            return std::make_unique<ErasedPiece<TypedPiece>>(pieces_, index);
        }

    private:
        TypedPieces pieces_;
    };

    T trajectory_;
};

} // namespace chasles::motion
