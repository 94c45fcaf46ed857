// The trajectory of any moving frame: pieces that turn little, each enclosed by sweeps.
// Source: docs/derivations/24-enclosures.md.
#pragma once

#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/axis_way.h"
#include "chasles/motion/moving_frame.h"

#include <array>
#include <mutex>

namespace chasles::motion {

/// The moving body seen from the fixed body, and both in the world.
struct SmoothMotion {
    SharedFrame relative;
    SharedFrame moving; ///< in the world; `relative` if the fixed body stands still
    SharedFrame fixed;  ///< in the world; null if the fixed body's frame is the world

    /// For a fixed body that stands still.
    static SmoothMotion of_one(const SharedFrame& frame) { return {frame, frame, nullptr}; }
};

/// A part of a motion without a cut inside.
struct Section {
    Bracket times;
    RateBounds rates;
    PartEnds<double> ends;
};

/// The latest poses of a frame: the parts of a piece share their ends. For one thread.
class LatestPoses {
public:
    explicit LatestPoses(const Section& section)
        : poses_{{{section.times.lower, section.ends.start}, {section.times.upper, section.ends.goal}}} {}

    GeneralPose<double> at(const MovingFrame& frame, double time) {
        for (const auto& [known, pose] : poses_)
            if (known == time)
                return pose;
        next_ = (next_ + 1) % poses_.size();
        poses_[next_] = {time, frame.at(time)};
        return poses_[next_].pose;
    }

private:
    struct PoseAt {
        double time = -1; ///< none yet
        GeneralPose<double> pose{};
    };
    std::array<PoseAt, 4> poses_;
    std::size_t next_ = 1;
};

/// A section of a smooth motion that turns little. For one thread.
class SmoothPiece {
public:
    SmoothPiece(SmoothMotion motion, const Section& section);

    [[nodiscard]] const RationalMotion<algebra::DoubleDouble>& cubic() const { return cubic_; }
    [[nodiscard]] static std::optional<ExactMotion> exact() { return std::nullopt; }
    [[nodiscard]] std::optional<Enclosure<double>> enclosure(const Bracket& part) const {
        return part.lower == 0 && part.upper == 1 ? whole_ : enclosed(part);
    }
    [[nodiscard]] std::optional<Enclosure<algebra::DoubleDouble>> refined_enclosure(const Bracket& part) const;
    [[nodiscard]] bool is_refined() const { return motion_.relative->is_refined(); }

    [[nodiscard]] Bracket time_of(const Bracket& tau) const;
    [[nodiscard]] Bracket tau_of(const Bracket& tau) const { return time_of(tau); }
    [[nodiscard]] double tau_rate(double) const { return 1 / (times_.upper - times_.lower); }
    [[nodiscard]] double tau_tolerance(double time_tolerance) const;
    [[nodiscard]] Pose pose_at(double tau) const;
    [[nodiscard]] Pose fixed_pose_at(double tau) const;

    [[nodiscard]] const Bracket& times() const { return times_; } ///< of the whole motion

private:
    [[nodiscard]] double time_at(double tau) const;
    [[nodiscard]] Enclosure<double> enclosed(const Bracket& part) const;
    struct Axis {
        Vector3<algebra::DoubleDouble> direction;
        AxisRates across;
    };
    struct Rates {
        RateBounds bounds;
        std::optional<Axis> axis; ///< about which the body all but turns, as far as the frame knows
    };
    void find_axis(const PartEnds<double>& ends);
    [[nodiscard]] Rates rates_of(const Bracket& times) const;
    [[nodiscard]] Rates refined_rates_of(const Bracket& times) const;
    template <class S>
    [[nodiscard]] EnclosureBounds bounds_by(const Rates& all, const Bracket& part) const;
    template <class S>
    [[nodiscard]] EnclosureBounds bounds(const Bracket& part) const;

    SmoothMotion motion_;
    Bracket times_;
    Rates rates_; ///< of the whole piece
    Vector3<double> reference_;
    Enclosure<double> whole_;
    RationalMotion<algebra::DoubleDouble> cubic_;
    mutable LatestPoses latest_; ///< of the relative motion
};

/// The sections of a frame, made on the first use. From several threads at once, too.
class Sections {
public:
    explicit Sections(SharedFrame frame) : frame_(std::move(frame)) {}

    /// In order of time; the body turns little in each. Throws InvalidInput where the motion turns so fast, by its
    /// bounds, that they would be too many.
    [[nodiscard]] const std::vector<Section>& all() const;
    /// In order of time, where the frame goes about or along one axis after another; none otherwise.
    [[nodiscard]] std::shared_ptr<const std::vector<AxisSpan>> axis_spans() const;

private:
    void make() const;

    SharedFrame frame_;
    mutable std::once_flag axis_is_known_;
    mutable std::shared_ptr<const std::vector<AxisSpan>> axis_spans_;
    mutable std::once_flag is_made_;
    mutable std::vector<Section> sections_;
};

/// The pieces of a smooth motion, in order of time: its sections.
class SmoothPieces {
public:
    SmoothPieces(SmoothMotion motion, std::shared_ptr<const Sections> sections)
        : motion_(std::move(motion)), sections_(std::move(sections)) {}

    [[nodiscard]] std::size_t size() const { return sections_->all().size(); }
    [[nodiscard]] SmoothPiece operator[](std::size_t index) const { return {motion_, sections_->all()[index]}; }
    /// Pieces without enclosures in the place of these, where the motion goes about or along one axis after another;
    /// null for others.
    [[nodiscard]] std::unique_ptr<const AnyPieces> axis_pieces() const;

private:
    SmoothMotion motion_;
    std::shared_ptr<const Sections> sections_;
};

/// A smooth motion as a trajectory.
class SmoothTrajectory {
public:
    explicit SmoothTrajectory(SmoothMotion motion)
        : motion_(std::move(motion)), sections_(std::make_shared<const Sections>(motion_.relative)) {}

    [[nodiscard]] SmoothPieces pieces() const { return {motion_, sections_}; }
    [[nodiscard]] PathBall ball_around_path(const Vector3<double>& point) const;
    [[nodiscard]] std::size_t coarse_count() const;
    [[nodiscard]] std::optional<CoarseMotion> coarse(std::size_t part) const;
    [[nodiscard]] Pose pose_at(double time) const;
    [[nodiscard]] Pose fixed_pose_at(double time) const;
    [[nodiscard]] SharedTrajectory reversed() const;
    [[nodiscard]] MotionDescription description() const { return MotionDescription::of_frame(*motion_.relative); }

    [[nodiscard]] double size() const { return motion_.relative->size(); }
    [[nodiscard]] SharedFrame frame() const { return motion_.fixed ? nullptr : motion_.moving; }

private:
    [[nodiscard]] std::optional<CoarseMotion> coarse_over(const Section& section) const;

    SmoothMotion motion_;
    std::shared_ptr<const Sections> sections_;
};

/// A pose with a quaternion of any length, as a public pose.
Pose public_pose(const GeneralPose<double>& pose);

} // namespace chasles::motion
