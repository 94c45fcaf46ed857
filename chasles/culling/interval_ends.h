// The places of the moving body at both ends of an interval of time, from its control maps.
#pragma once

#include "chasles/motion/control_maps.h"

#include <Eigen/Core>

namespace chasles::culling {

using algebra::Vector3;

/// The map of points of the moving body to the frame of the fixed body.
struct RigidMap {
    Vector3<double> rows[3];
    Vector3<double> offset;

    [[nodiscard]] Vector3<double> turned(const Vector3<double>& direction) const {
        return {dot(rows[0], direction), dot(rows[1], direction), dot(rows[2], direction)};
    }
    [[nodiscard]] Vector3<double> turned_back(const Vector3<double>& direction) const {
        return scale(rows[0], direction.x) + scale(rows[1], direction.y) + scale(rows[2], direction.z);
    }
    [[nodiscard]] Vector3<double> operator()(const Vector3<double>& point) const { return turned(point) + offset; }
};

struct IntervalEnds {
    RigidMap start;
    RigidMap end;

    IntervalEnds() = default;

    /// The ends of the interval of these maps.
    explicit IntervalEnds(const motion::ControlMaps<double>& maps) {
        for (const auto& [map, lane] : {std::pair(&start, 0), std::pair(&end, 3)}) {
            const double share = 1 / maps.weight[lane];
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j)
                    map->rows[i][j] = maps.rotation.row[i][j][lane] * share;
                map->offset[i] = maps.translation[i][lane] * share;
            }
        }
    }

    /// A body at rest: rotation * point + offset.
    IntervalEnds(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& offset) {
        for (int i = 0; i < 3; ++i)
            start.rows[i] = {rotation(i, 0), rotation(i, 1), rotation(i, 2)};
        start.offset = {offset.x(), offset.y(), offset.z()};
        end = start;
    }

    /// On the chords, at a time in [0, 1] of the interval.
    [[nodiscard]] RigidMap at(double time) const {
        RigidMap map;
        for (int i = 0; i < 3; ++i)
            map.rows[i] = start.rows[i] + scale(end.rows[i] - start.rows[i], time);
        map.offset = start.offset + scale(end.offset - start.offset, time);
        return map;
    }
};

} // namespace chasles::culling
