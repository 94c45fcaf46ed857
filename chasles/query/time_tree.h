// The dyadic intervals of tau that a traversal visits, each with its control maps, made when first asked for.
#pragma once

#include "chasles/query/swept_boxes.h"

#include <deque>

namespace chasles::query {

/// One interval. Its maps are restricted from those of the whole motion, so that rounding does not build up.
struct TimeInterval {
    double lower;
    double upper;
    motion::ControlMaps<double> maps;
    SweptBoxes boxes;
};

/// Makes intervals of one motion.
class TimeTree {
public:
    TimeTree(const motion::ControlMaps<double>& whole, const Eigen::Vector3d& moving_centre,
             const Eigen::Vector3d& fixed_centre, const elementary::ErrorScale& scale)
        : whole_(whole), moving_centre_(moving_centre), fixed_centre_(fixed_centre), scale_(scale) {}

    [[nodiscard]] TimeInterval interval(double lower, double upper) const {
        const motion::ControlMaps<double> maps =
            lower <= 0 && upper >= 1 ? whole_ : motion::restricted(whole_, lower, upper);
        return {lower, upper, maps, SweptBoxes(maps, moving_centre_, fixed_centre_, scale_)};
    }

private:
    motion::ControlMaps<double> whole_;
    Eigen::Vector3d moving_centre_;
    Eigen::Vector3d fixed_centre_;
    elementary::ErrorScale scale_;
};

} // namespace chasles::query
