// The plane of a face, seen by the other body, whose points move on chords over an interval of time.
// Source: docs/derivations/13-face-sides.md, "On chords".
#pragma once

#include "chasles/culling/cached_face.h"
#include "chasles/culling/swept_boxes.h"

#include <limits>

namespace chasles::culling {

/// Heights of points of the other body at one time: normal . point + offset.
struct SeenPlane {
    Vector3<double> normal;
    double offset = 0;
};

class ChordPlane {
public:
    ChordPlane() = default;

    /// The plane at both ends of the interval. Points within `band` of it may be on the face.
    ChordPlane(const SeenPlane& start, const SeenPlane& end, double band)
        : start_(start), change_{end.normal - start.normal, end.offset - start.offset}, band_(band) {}

    /// The window without its beginning in which all corners of a face of the other body stay on one side; empty if
    /// they do all along.
    [[nodiscard]] Window without_apart(const Body& body, std::uint32_t face, const Window& when) const {
        const Heights heights = heights_of(body, face, when);
        return after(heights.lowest[0] > band_ ? heights.lowest : BothEnds(-heights.highest), when);
    }
    /// Likewise, in which they stay above the plane.
    [[nodiscard]] Window without_above(const Body& body, std::uint32_t face, const Window& when) const {
        return after(heights_of(body, face, when).lowest, when);
    }

private:
    using BothEnds = Eigen::Array2d; ///< of the window

    struct Heights {
        BothEnds lowest;
        BothEnds highest;
    };
    [[nodiscard]] Heights heights_of(const Body& body, std::uint32_t face, const Window& when) const {
        const BothEnds share(double(when.lower), double(when.upper));
        const BothEnds x = start_.normal.x + change_.normal.x * share;
        const BothEnds y = start_.normal.y + change_.normal.y * share;
        const BothEnds z = start_.normal.z + change_.normal.z * share;
        const BothEnds offset = start_.offset + change_.offset * share;
        BothEnds lowest = BothEnds::Constant(std::numeric_limits<double>::infinity());
        BothEnds highest = -lowest;
        for (const std::uint32_t corner : body.face(face)) {
            const Eigen::Vector3d& point = body.vertices()[corner];
            const BothEnds height = x * point.x() + y * point.y() + z * point.z() + offset;
            lowest = lowest.min(height);
            highest = highest.max(height);
        }
        return {lowest, highest};
    }

    /// The window without its beginning in which the lowest of some heights is beyond the band. On chords heights are
    /// linear in time. So the lowest one is, at any time, above the line between its values at both ends of the window.
    [[nodiscard]] Window after(const BothEnds& lowest, const Window& when) const {
        const BothEnds gap = lowest - band_;
        if (!(gap[0] > 0))
            return when;
        return gap[1] > 0 ? empty_window : from_share(when, gap[0] / (gap[0] - gap[1]));
    }

    SeenPlane start_;
    SeenPlane change_;
    double band_ = 0;
};

} // namespace chasles::culling
