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

    /// Whether all corners of a face of the other body stay on one side during the window. On chords heights are linear
    /// in time, so both ends of the window tell.
    [[nodiscard]] bool keeps_on_one_side(const Body& body, std::uint32_t face, const Window& when) const {
        const BothEnds share(double(when.lower), double(when.upper));
        const BothEnds x = start_.normal.x + change_.normal.x * share;
        const BothEnds y = start_.normal.y + change_.normal.y * share;
        const BothEnds z = start_.normal.z + change_.normal.z * share;
        const BothEnds offset = start_.offset + change_.offset * share;
        const auto outline = body.face(face);
        BothEnds lowest = BothEnds::Constant(std::numeric_limits<double>::infinity());
        BothEnds highest = -lowest;
        for (const std::uint32_t corner : outline) {
            const Eigen::Vector3d& point = body.vertices()[corner];
            const BothEnds height = x * point.x() + y * point.y() + z * point.z() + offset;
            lowest = lowest.min(height);
            highest = highest.max(height);
        }
        return lowest.minCoeff() > band_ || highest.maxCoeff() < -band_;
    }

private:
    using BothEnds = Eigen::Array2d; ///< of the window

    SeenPlane start_;
    SeenPlane change_;
    double band_ = 0;
};

} // namespace chasles::culling
