// The last culling stage before feature tests: it culls a pair of faces if a plane separates them in the time window.
// Source: docs/derivations/13-face-sides.md.
#pragma once

#include "chasles/culling/bvh_traversal.h"
#include "chasles/culling/face_planes.h"

namespace chasles::culling {

/// The culler of one search.
class FaceCuller {
public:
    /// Keeps all references. Points within `margin` of a plane count as touching the plane.
    FaceCuller(const Body& moving, const Body& fixed, const motion::ControlMaps<double>& whole,
               const elementary::ErrorScale& scale, double margin)
        : planes_(moving, fixed, scale, margin), maps_(whole) {}

    /// Calls `visit(part, sides of the moving corners, sides of the fixed corners)` unless a plane proves that the
    /// faces do not touch up to tau = `best`. `part` is the part of the interval to be tested. Culling changes no
    /// answer (note 13). Planes are computed once per interval.
    template <class Visit>
    void cull(const FacePair& pair, double best, Visit visit) {
        const TimeRange& interval = pair.interval;
        const double first = interval.at(pair.when.lower);
        const TimeRange part =
            part_around(interval, {first, std::max(first, std::min(best, interval.at(pair.when.upper)))});
        if (maps_.set(interval))
            planes_.use(maps_.maps());
        const FacePlanes::Restriction restriction((part.lower - interval.lower) / interval.width(),
                                                  (part.upper - interval.lower) / interval.width());
        if (planes_.are_separated(pair.moving, pair.fixed, restriction, pair.when.lower))
            return;
        const CornerSides moving_sides = planes_.sides_of_moving(pair.moving, pair.fixed, restriction);
        if (moving_sides.all_on_one_side())
            return;
        const CornerSides fixed_sides = planes_.sides_of_fixed(pair.moving, pair.fixed, restriction);
        if (!fixed_sides.all_on_one_side())
            visit(part, moving_sides, fixed_sides);
    }

private:
    FacePlanes planes_;
    RangeMaps maps_;
};

} // namespace chasles::culling
