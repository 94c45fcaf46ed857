// Two kernels for any type of four lanes: all compared forms run the same code. Sources: the rejection by signs of
// chasles/elementary/vertex_face.h, and the box test that the library used before note 14, with four lanes per axis.
#pragma once

#include "chasles/algebra/vector.h"
#include "chasles/motion/control_maps.h"

namespace chasles::bench {

using algebra::Matrix3;
using algebra::Vector3;

/// Control maps, packed as in a query.
template <class Pack>
struct PackedMaps {
    Matrix3<Pack> rotation;
    Matrix3<Pack> rotation_size; ///< magnitudes
    Vector3<Pack> translation;
    Vector3<Pack> inverse_translation;
    Pack weight;
    Pack slack;
};

/// A moving vertex and the plane of a fixed face.
struct VertexAndPlane {
    double vertex[3];
    double normal[3];
    double anchor[3]; ///< a point of the plane
    double error;     ///< error bound of the height over the plane, times |normal|
};

/// One box of each body.
struct BoxPair {
    double moving_centre[3];
    double moving_half[3];
    double fixed_centre[3];
    double fixed_half[3];
};

template <class Pack>
Pack load_lanes(const motion::Bernstein<3, double>& p) {
    return Pack::of({p[0], p[1], p[2], p[3]});
}

template <class Pack>
PackedMaps<Pack> packed(const motion::ControlMaps<double>& maps, double slack) {
    PackedMaps<Pack> result;
    result.weight = load_lanes<Pack>(maps.weight);
    result.slack = result.weight * Pack::all(slack);
    for (int i = 0; i < 3; ++i) {
        result.translation[i] = load_lanes<Pack>(maps.translation[i]);
        result.inverse_translation[i] = load_lanes<Pack>(maps.inverse_translation[i]);
        for (int j = 0; j < 3; ++j) {
            result.rotation.row[i][j] = load_lanes<Pack>(maps.rotation.row[i][j]);
            result.rotation_size.row[i][j] = magnitude(result.rotation.row[i][j]);
        }
    }
    return result;
}

template <class Pack>
Pack combined(const Vector3<Pack>& row, const double* by) {
    return row.x * Pack::all(by[0]) + row.y * Pack::all(by[1]) + row.z * Pack::all(by[2]);
}

template <class Pack>
bool is_apart(const Pack& distance, const Pack& half_extent) {
    return all_above(distance, half_extent) || all_above(Pack::all(0) - distance, half_extent);
}

/// W times the height of the moving vertex over the plane.
template <class Pack>
Pack height(const PackedMaps<Pack>& maps, const VertexAndPlane& pair) {
    Vector3<Pack> arm;
    for (int i = 0; i < 3; ++i)
        arm[i] =
            combined(maps.rotation.row[i], pair.vertex) + maps.translation[i] - maps.weight * Pack::all(pair.anchor[i]);
    return combined(arm, pair.normal);
}

/// Whether the vertex stays on one side of the plane.
template <class Pack>
bool is_rejected(const PackedMaps<Pack>& maps, const VertexAndPlane& pair) {
    return is_apart(height(maps, pair), maps.weight * Pack::all(pair.error));
}

/// Whether one face normal of either box separates the boxes during the whole motion.
template <class Pack>
bool is_rejected(const PackedMaps<Pack>& maps, const BoxPair& pair) {
    const auto separates = [&](const Vector3<Pack>& row, const Vector3<Pack>& size, const Pack& offset,
                               const double* turned, const double* turned_half, double still, double still_half) {
        const Pack half_extent = combined(size, turned_half) + maps.weight * Pack::all(still_half) + maps.slack;
        return is_apart(combined(row, turned) + offset - maps.weight * Pack::all(still), half_extent);
    };
    for (int i = 0; i < 3; ++i)
        if (separates(maps.rotation.row[i], maps.rotation_size.row[i], maps.translation[i], pair.moving_centre,
                      pair.moving_half, pair.fixed_centre[i], pair.fixed_half[i]))
            return true;
    for (int i = 0; i < 3; ++i) {
        const Vector3<Pack> column{maps.rotation.row[0][i], maps.rotation.row[1][i], maps.rotation.row[2][i]};
        const Vector3<Pack> size{maps.rotation_size.row[0][i], maps.rotation_size.row[1][i],
                                 maps.rotation_size.row[2][i]};
        if (separates(column, size, Pack::all(0) - maps.inverse_translation[i], pair.fixed_centre, pair.fixed_half,
                      pair.moving_centre[i], pair.moving_half[i]))
            return true;
    }
    return false;
}

} // namespace chasles::bench
