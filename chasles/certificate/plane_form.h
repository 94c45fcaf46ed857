// How far corners are above a plane during a part of a motion. Source: docs/certificate.md, "Proof".
#pragma once

#include "chasles/algebra/double_double.h"
#include "chasles/algebra/vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace chasles::certificate {

using algebra::DoubleDouble;
using algebra::Matrix3;
using algebra::Vector3;

using Corner = Vector3<double>;
using Wide = Vector3<DoubleDouble>;

inline Wide widened(const Corner& v) {
    return algebra::cast<DoubleDouble>(v);
}

/// Part of a piece, in tau.
struct Cell {
    DoubleDouble lower;
    DoubleDouble upper;
};

/// Around the corners of a node.
struct Ball {
    Corner centre;
    double radius = 0;
};

/// The distances of corners b of the moving body from a plane, times positive numbers: in a cell none is below the
/// least of the row[j] . b + shift[j].
template <class S>
struct PlaneForm {
    std::array<Vector3<S>, 4> row;
    std::array<S, 4> shift;

    [[nodiscard]] S least(const Corner& corner) const {
        return std::min(std::min(at(corner, 0), at(corner, 1)), std::min(at(corner, 2), at(corner, 3)));
    }
    /// No corner of a box has a lesser one, up to rounding.
    [[nodiscard]] double least_in(const Corner& centre, const Corner& half) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < 4; ++j) {
            double way = 0;
            for (int axis = 0; axis < 3; ++axis)
                way += std::abs(double(row[j][axis])) * half[axis];
            least = std::min(least, double(at(centre, j)) - way);
        }
        return least;
    }

private:
    [[nodiscard]] S at(const Corner& corner, std::size_t j) const {
        return S(row[j].x * S(corner.x) + row[j].y * S(corner.y)) + S(row[j].z * S(corner.z) + shift[j]);
    }
};

} // namespace chasles::certificate
