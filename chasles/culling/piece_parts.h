// The control maps of a piece over any part of it, in double, with the bound of their errors.
// Source: docs/derivations/24-enclosures.md, "Parts".
#pragma once

#include "chasles/culling/time_range.h"
#include "chasles/elementary/error_scale.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/control_maps.h"

#include <optional>

namespace chasles::culling {

/// The sizes of two bodies, each with the margin of a search.
struct BodySizes {
    motion::Ball moving;      ///< encloses the moving body
    double moving_extent = 0; ///< the largest coordinate, in the frame of the body
    double fixed_extent = 0;
};

/// How a piece is divided: its maps are restricted or, where they only enclose the true motion, made anew for each
/// part. Kept by value; the maps and the piece are kept by reference.
class PieceParts {
public:
    /// For a piece whose cubic motion is the true one.
    PieceParts(const motion::ControlMaps<double>& whole, const elementary::ErrorScale& scale)
        : whole_(&whole), scale_(scale) {}
    /// For a piece whose parts are enclosed.
    PieceParts(const motion::ControlMaps<double>& whole, const elementary::ErrorScale& scale,
               const motion::AnyPiece& piece, const BodySizes& sizes);

    [[nodiscard]] bool are_enclosed() const { return enclosed_.has_value(); }
    /// The whole piece. Where parts are enclosed, the scale does not count how far the true motion is from the maps.
    [[nodiscard]] const motion::ControlMaps<double>& whole() const { return *whole_; }
    [[nodiscard]] const elementary::ErrorScale& scale() const { return scale_; }

    /// Only where parts are enclosed.
    [[nodiscard]] motion::Enclosure<double> enclosure(const TimeRange& range) const;
    /// How far any point of the moving body may be from its true place. It is counted for a ball of twice the body's
    /// radius, so that the bounds of elementary tests hold (note 24, "Features").
    [[nodiscard]] double deviation_of(const motion::EnclosureBounds& part) const {
        return part.deviation_of(enclosed_->twice);
    }
    /// Whether a shorter part would deviate much less or tell more.
    [[nodiscard]] bool is_worth_shortening(const motion::EnclosureBounds& part) const {
        return deviation_of(part) > 1.5 * rounding_of(part) || !is_short(part);
    }
    /// The share of the deviation that shorter parts do not reduce.
    [[nodiscard]] double rounding_of(const motion::EnclosureBounds& part) const {
        return part.rounding_of(enclosed_->twice);
    }
    /// Whether no point of the moving body moves by more than the body's radius.
    [[nodiscard]] bool is_short(const motion::EnclosureBounds& part) const {
        return part.travel_of(enclosed_->twice) <= 0.5 * enclosed_->twice.radius;
    }
    /// The bound of errors for the maps of an enclosed part.
    [[nodiscard]] elementary::ErrorScale scale_of(const motion::Enclosure<double>& part,
                                                  const motion::ControlMaps<double>& maps) const;
    /// Likewise in double-double.
    [[nodiscard]] elementary::ErrorScale scale_of(const motion::Enclosure<algebra::DoubleDouble>& part,
                                                  const motion::ControlMaps<algebra::DoubleDouble>& maps) const;

private:
    void add_deviations(elementary::ErrorScale& scale, const motion::EnclosureBounds& part) const;

    struct Enclosed {
        const motion::AnyPiece* piece;
        BodySizes sizes;
        motion::Ball twice; ///< a ball of twice the radius around the moving body
    };

    const motion::ControlMaps<double>* whole_;
    elementary::ErrorScale scale_;
    std::optional<Enclosed> enclosed_;
};

/// The control maps over the current part.
class PartMaps {
public:
    explicit PartMaps(const PieceParts& parts) : parts_(parts), scale_(parts.scale()) {}

    /// Changes the part. Returns false if it is the current part. The maps are always made from the whole piece,
    /// therefore rounding errors do not accumulate.
    bool set(const TimeRange& part);
    [[nodiscard]] bool are_enclosed() const { return parts_.are_enclosed(); }
    [[nodiscard]] const motion::ControlMaps<double>& maps() const { return maps_; }
    [[nodiscard]] const elementary::ErrorScale& scale() const { return scale_; }

private:
    PieceParts parts_;
    TimeRange part_{0, 0}; ///< empty before the first call of `set`
    elementary::ErrorScale scale_;
    motion::ControlMaps<double> maps_;
};

} // namespace chasles::culling
