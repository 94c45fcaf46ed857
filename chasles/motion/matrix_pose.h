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

/// The square of the Frobenius norm of the difference of both matrices.
inline double squared_turn(const MatrixPose& a, const MatrixPose& b) {
    double squares = 0;
    for (int i = 0; i < 3; ++i) {
        const algebra::Vector3<double> row = a.rotation.row[i] - b.rotation.row[i];
        squares += dot(row, row);
    }
    return squares;
}

/// A bound of the distance between the places of any point of a ball. The Frobenius norm of the difference of two
/// rotations is sqrt(2) times its spectral norm. Source: docs/derivations/31-neighbour-lists.md.
inline double distance(const MatrixPose& a, const MatrixPose& b, const algebra::Vector3<double>& centre,
                       double radius) {
    return length(a(centre) - b(centre)) + std::sqrt(squared_turn(a, b) / 2) * radius;
}

/// Likewise if a matrix is no rotation: the Frobenius norm is at least the spectral norm.
inline double distance_of_maps(const MatrixPose& a, const MatrixPose& b, const algebra::Vector3<double>& centre,
                               double radius) {
    return length(a(centre) - b(centre)) + std::sqrt(squared_turn(a, b)) * radius;
}

} // namespace chasles::motion
