// Where the shapes of a robot are during a segment, in double. Source: docs/derivations/29-robots.md, "Culling".
#pragma once

#include "chasles/motion/screw_path.h"
#include "chasles/robot/group_motion.h"
#include "chasles/robot/prepared.h"

#include <cstddef>
#include <vector>

namespace chasles::robot {

/// The middle of the box of an element, where the element has this pose.
inline Eigen::Vector3d centre_at(const RobotChecker::Prepared::Extent& extent,
                                 const motion::GeneralPose<double>& pose) {
    const auto [x, y, z] = placed(pose, motion::vector_in<double>(extent.centre));
    return {x, y, z};
}

/// The elements of a robot in the world at even times, computed when they are needed.
class ElementPlaces {
public:
    /// From time 0 to time 1, in so many intervals.
    ElementPlaces(const RobotChecker::Prepared& prepared, const SegmentMotion& motion, std::size_t intervals)
        : prepared_(prepared), groups_(prepared.model(), motion, intervals), places_(intervals + 1) {}

    struct Place {
        motion::GeneralPose<double> pose;
        Eigen::Vector3d centre; ///< of the box
        bool is_made = false;
    };

    /// References stay valid.
    const Place& operator()(std::size_t time, std::size_t element) {
        std::vector<Place>& places = places_[time];
        if (places.empty())
            places.resize(prepared_.extents.size());
        if (Place& place = places[element]; !place.is_made) {
            const RobotChecker::Prepared::Extent& extent = prepared_.extents[element];
            place.pose = product(groups_(time, prepared_.model().elements[element].group), extent.place);
            place.centre = centre_at(extent, place.pose);
            place.is_made = true;
        }
        return places[element];
    }

private:
    const RobotChecker::Prepared& prepared_;
    Placements groups_;
    std::vector<std::vector<Place>> places_; ///< at each time, of each element; empty until needed
};

} // namespace chasles::robot
