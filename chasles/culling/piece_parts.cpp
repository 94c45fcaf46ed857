// Restricts the maps of a piece, or encloses the true motion over a part of it.
// Source: docs/derivations/24-enclosures.md, "Parts".
#include "chasles/culling/piece_parts.h"

#include <algorithm>
#include <cmath>

namespace chasles::culling {

PieceParts::PieceParts(const motion::ControlMaps<double>& whole, const elementary::ErrorScale& scale,
                       const motion::AnyPiece& piece, const BodySizes& sizes)
    : whole_(&whole), scale_(scale), enclosed_{{&piece, sizes, {sizes.moving.centre, 2 * sizes.moving.radius}}} {}

motion::Enclosure<double> PieceParts::enclosure(const TimeRange& range) const {
    return *enclosed_->piece->enclosure({range.lower, range.upper});
}

void PieceParts::add_deviations(elementary::ErrorScale& scale, const motion::EnclosureBounds& part) const {
    scale.deviation = deviation_of(part);
    scale.turn_deviation = part.turn_deviation;
    scale.axis_deviation = part.deviation_along_axis(enclosed_->twice);
    scale.axis = part.along.axis;
}

elementary::ErrorScale PieceParts::scale_of(const motion::Enclosure<double>& part,
                                            const motion::ControlMaps<double>& maps) const {
    const double size = norm1(part.cubic.moment) + norm1(part.cubic.displacement);
    const double moving_extent = std::max(enclosed_->sizes.moving_extent, part.cubic.reference_extent) + size;
    elementary::ErrorScale scale = elementary::error_scale(maps, moving_extent, enclosed_->sizes.fixed_extent);
    add_deviations(scale, part.bounds);
    return scale;
}

/// The maps of a part are within the deviation of those of the whole piece, whose norms bound them.
elementary::ErrorScale PieceParts::scale_of(const motion::Enclosure<algebra::DoubleDouble>& part,
                                            const motion::ControlMaps<algebra::DoubleDouble>& /*maps*/) const {
    elementary::ErrorScale scale = scale_;
    scale.length *= 2;
    scale.norm_bound *= 2;
    add_deviations(scale, part.bounds);
    return scale;
}

bool PartMaps::set(const TimeRange& part) {
    if (part == part_)
        return false;
    part_ = part;
    if (parts_.are_enclosed()) {
        const motion::Enclosure<double> enclosure = parts_.enclosure(part);
        maps_ = motion::double_maps(enclosure.cubic);
        scale_ = parts_.scale_of(enclosure, maps_);
    } else {
        maps_ = part == TimeRange() ? parts_.whole() : motion::restricted(parts_.whole(), part.lower, part.upper);
    }
    return true;
}

TimeRange part_around(const TimeRange& interval, const TimeRange& needed, double least) {
    int exponent = 0;
    std::frexp(std::max(least, needed.width()), &exponent);
    double width = std::ldexp(1.0, exponent);
    while (width < interval.width()) {
        const double grid = 0.25 * width;
        const double lower = std::clamp(std::floor(needed.lower / grid) * grid, interval.lower, interval.upper - width);
        if (lower + width >= needed.upper)
            return {lower, lower + width};
        width *= 2;
    }
    return interval;
}

} // namespace chasles::culling
