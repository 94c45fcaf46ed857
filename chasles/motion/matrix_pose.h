// A position with a matrix, in double.
#pragma once

#include "chasles/algebra/vector.h"

namespace chasles::motion {

/// The position x -> rotation x + translation of body points in the frame of the fixed body.
struct MatrixPose {
    algebra::Matrix3<double> rotation;
    algebra::Vector3<double> translation;

    [[nodiscard]] algebra::Vector3<double> operator()(const algebra::Vector3<double>& point) const {
        return rotation * point + translation;
    }
};

} // namespace chasles::motion
