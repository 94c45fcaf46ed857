// What every search of one piece of a motion uses, computed once for the piece.
#pragma once

#include "chasles/contact/relative_configuration.h"
#include "chasles/culling/time_tree.h"
#include "chasles/elementary/error_scale.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/any_trajectory.h"

#include <memory>
#include <optional>

namespace chasles::search {

/// The start of an enclosed motion in double-double, with the bound of its errors.
struct RefinedStart {
    motion::ControlMaps<algebra::DoubleDouble> maps;
    elementary::ErrorScale scale;
};

/// Two bodies and one piece of motion. Bodies are kept by reference. For one thread.
class PieceContext {
public:
    PieceContext(const Body& moving, const Body& fixed, std::unique_ptr<const motion::AnyPiece> piece);

    [[nodiscard]] const Body& moving() const { return moving_; }
    [[nodiscard]] const Body& fixed() const { return fixed_; }
    [[nodiscard]] const motion::AnyPiece& piece() const { return *piece_; }

    /// Maps over the whole piece, in double.
    [[nodiscard]] const motion::ControlMaps<double>& maps() const { return maps_; }
    /// The bound of rounding errors, for distances up to `margin`.
    [[nodiscard]] elementary::ErrorScale error_scale(double margin) const;
    /// The maps over parts of the piece, for distances up to `margin`.
    [[nodiscard]] culling::PieceParts parts(double margin) const;
    /// The intervals of a traversal in which points within `margin` of each other count as meeting; `parts` is
    /// parts(margin).
    [[nodiscard]] culling::TimeTree time_tree(double margin, const culling::PieceParts& parts) const;
    /// One of its intervals, for a single use.
    [[nodiscard]] culling::TimeInterval interval(double margin, const culling::TimeRange& range) const;
    /// How far points that come within `margin` of each other leave their chords in a range of tau, in the length unit.
    [[nodiscard]] double deviation(double margin, const culling::TimeRange& range) const;
    /// Whether the maps only enclose the true motion.
    [[nodiscard]] bool is_enclosed() const { return start_.has_value(); }
    /// The bodies at one tau.
    [[nodiscard]] contact::RelativeConfiguration configuration_at(double tau) const;
    /// Their pose alone: of the moving body in the frame of the fixed one.
    [[nodiscard]] motion::MatrixPose pose_at(double tau) const;

    /// Of an enclosed motion, by the enclosure of a short part: its start is known far better than that of the whole.
    /// Empty where the maps are the true motion, and where there is none in double-double.
    [[nodiscard]] std::optional<RefinedStart> refined_start() const;

    /// Maps over the whole piece in double-double, and without rounding where the piece has such (null if not).
    /// Computed on the first call: most searches need neither.
    [[nodiscard]] const motion::ControlMaps<algebra::DoubleDouble>& refined_maps();
    [[nodiscard]] const motion::ControlMaps<algebra::ExactNumber>* exact_maps();

private:
    const Body& moving_;
    const Body& fixed_;
    std::unique_ptr<const motion::AnyPiece> piece_;
    std::optional<motion::EnclosureBounds>
        start_; ///< of the enclosure of the start; empty if the maps are the true motion
    motion::ControlMaps<double> maps_;
    elementary::MapNorms norms_;
    std::unique_ptr<const motion::ControlMaps<algebra::DoubleDouble>> refined_maps_;
    std::optional<motion::ExactMotion> exact_;
    bool exact_is_computed_ = false;
};

} // namespace chasles::search
