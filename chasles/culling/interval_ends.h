// The positions of the moving body at both ends of an interval of time.
#pragma once

#include "chasles/motion/control_maps.h"
#include "chasles/motion/matrix_pose.h"

#include <utility>

namespace chasles::culling {

using algebra::Vector3;
using motion::MatrixPose;

struct IntervalEnds {
    MatrixPose start;
    MatrixPose end;

    IntervalEnds() = default;

    /// The ends of the interval of these maps.
    explicit IntervalEnds(const motion::ControlMaps<double>& maps) {
        for (const auto& [pose, lane] : {std::pair(&start, 0), std::pair(&end, 3)}) {
            const double share = 1 / maps.weight[lane];
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j)
                    pose->rotation.row[i][j] = maps.rotation.row[i][j][lane] * share;
                pose->translation[i] = maps.translation[i][lane] * share;
            }
        }
    }

    /// A body at rest.
    explicit IntervalEnds(const MatrixPose& pose) : start(pose), end(pose) {}

    /// On the chords, at a time in [0, 1] of the interval.
    [[nodiscard]] MatrixPose at(double time) const {
        MatrixPose pose;
        for (int i = 0; i < 3; ++i)
            pose.rotation.row[i] = start.rotation.row[i] + scale(end.rotation.row[i] - start.rotation.row[i], time);
        pose.translation = start.translation + scale(end.translation - start.translation, time);
        return pose;
    }
};

} // namespace chasles::culling
