// The last culling stage before feature tests: it culls a pair of faces if a plane separates them in the time window.
// Source: docs/derivations/13-face-sides.md.
#pragma once

#include "chasles/culling/bvh_traversal.h"
#include "chasles/culling/face_planes.h"

namespace chasles::culling {

/// A part of an interval in which two faces may meet. `moving` and `fixed` tell which corners may come to the other
/// face's plane. Valid until the next pair is culled.
struct MeetingFaces {
    TimeRange part;
    CornerSides moving;
    CornerSides fixed;
};

/// The culler of one search.
class FaceCuller {
public:
    /// Keeps all references. Points within `margin` of a plane count as touching the plane.
    FaceCuller(const Body& moving, const Body& fixed, const PieceParts& parts, double margin)
        : planes_(moving, fixed, margin), maps_(parts) {}

    /// The features of two faces that may meet up to `best`; empty if a plane separates the faces until then. The
    /// answer of a search does not depend on what is culled (note 13). Planes are computed once for the interval.
    std::optional<MeetingFaces> cull(const FacePair& pair, double best) {
        const TimeRange& interval = pair.interval;
        if (maps_.set(interval))
            planes_.use(maps_.maps(), maps_.scale());
        Window when = until(pair.when, (best - interval.lower) / interval.width());
        if (planes_.have_margin() || ++pairs_ > pairs_of_a_brief_search) {
            when = planes_.without_apart_on_chords(pair.moving, pair.fixed, when, pair.deviation);
            if (when.is_empty())
                return std::nullopt;
        }
        const double first = interval.at(when.lower);
        const TimeRange needed{first, std::max(first, std::min(best, interval.at(when.upper)))};
        const TimeRange part = part_around(interval, needed, least_part(interval));
        const FacePlanes::Restriction in_interval((part.lower - interval.lower) / interval.width(),
                                                  (part.upper - interval.lower) / interval.width());
        const CornerSides moving_sides = planes_.sides_of_moving(pair.moving, pair.fixed, in_interval);
        if (moving_sides.all_on_one_side())
            return std::nullopt;
        const CornerSides fixed_sides = planes_.sides_of_fixed(pair.moving, pair.fixed, in_interval);
        if (fixed_sides.all_on_one_side())
            return std::nullopt;
        return MeetingFaces{part, moving_sides, fixed_sides};
    }

private:
    /// A search that meets few pairs of faces does without the test on chords: most of these faces are near a contact.
    /// From the first pair on, the test makes queries of a triangle soup take 4.5 % more instructions, and saves other
    /// meshes half a percent. It saves two fifths for a nut that is pulled along its bolt.
    static constexpr std::uint64_t pairs_of_a_brief_search = 32;

    /// Where parts are enclosed, faces share few parts: the maps of each cost as much as some tests of features.
    [[nodiscard]] double least_part(const TimeRange& interval) const {
        constexpr double share = 0.5;
        return maps_.are_enclosed() ? share * interval.width() : shortest_interval;
    }

    FacePlanes planes_;
    PartMaps maps_;
    std::uint64_t pairs_ = 0;
};

} // namespace chasles::culling
