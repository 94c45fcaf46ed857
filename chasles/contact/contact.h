// A contact of two bodies: which features, where, and how.
#pragma once

#include "chasles/base/export.h"

#include <Eigen/Core>
#include <compare>
#include <cstdint>

namespace chasles {

/// The kinds of contact. The first named feature belongs to the moving body, the second to the fixed body. The last
/// three occur at the rims of faces and at the ends of edges; their features allow many normals, and the contact
/// reports one of them.
enum class ContactKind : std::uint8_t { vertex_face, face_vertex, edge_edge, vertex_edge, edge_vertex, vertex_vertex };
enum class FeatureKind : std::uint8_t { vertex, edge, face };

/// The kind of the first named feature, and of the second.
CHASLES_EXPORT FeatureKind moving_feature_kind(ContactKind kind);
CHASLES_EXPORT FeatureKind fixed_feature_kind(ContactKind kind);

/// The kind of the same contact after the bodies have swapped their roles.
CHASLES_EXPORT ContactKind swapped(ContactKind kind);

/// A vertex, a face or an edge of a body. The ids are those of the input mesh, from 0. An edge is named by its two
/// vertices; any other feature has one id, and `second` equals `first`.
struct Feature {
    std::uint32_t first = 0;
    std::uint32_t second = 0;

    friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// One feature pair in contact, in the world frame at the lower end of the bracket.
struct Contact {
    ContactKind kind = ContactKind::vertex_face;
    Feature moving;
    Feature fixed;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on the fixed feature, mesh unit; the moving feature is at
                                                      ///< point + gap * normal
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit, from the fixed body to the moving body
    double gap = 0;            ///< distance of the two features, mesh unit; 0 up to rounding where they touch
    double approach_speed = 0; ///< -d(gap)/dtime, mesh unit per motion; positive while the bodies approach. Negative
                               ///< only at the start, for bodies that touch there and separate

    /// The same contact after the bodies have swapped their roles.
    [[nodiscard]] CHASLES_EXPORT Contact swapped() const;
};

/// An edge of one body that passes through a face of the other body at time 0.
struct Overlap {
    bool edge_is_moving = true; ///< the moving body has the edge and the fixed body the face, or the reverse
    Feature edge;
    Feature face;
    Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< in the world frame
    bool certain = true;                             ///< false if the edge may just miss the rim of the face
};

/// A vertex of one body inside of the other one, which is solid, at time 0. Its whole part of the surface is inside.
struct Inside {
    bool moving_is_inside =
        true; ///< the vertex is one of the moving body, which is inside of the fixed one; or the reverse
    Feature vertex;
    Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< its place in the world frame
};

} // namespace chasles
