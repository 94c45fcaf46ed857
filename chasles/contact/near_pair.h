// Whether two features are within a distance of each other at one moment, and whether they are a contact.
// Source: docs/derivations/18-contact-set.md, "Which pairs".
#pragma once

#include "chasles/contact/contact_frame.h"
#include "chasles/mesh/face_normal.h"

#include <optional>
#include <span>

namespace chasles::contact {

/// A face in the frame of its body, for distances of points.
class FaceAtRest {
public:
    FaceAtRest(const Body& body, std::uint32_t face);

    [[nodiscard]] std::uint32_t face() const { return face_; }
    /// 1 or -1 for a point farther than `reach` from the plane, by its side; 0 for a nearer one.
    [[nodiscard]] int side_of(const Eigen::Vector3d& point, double reach) const;
    /// Whether a point is within `reach` of the face, and its foot on the plane is in the face up to `slack`.
    [[nodiscard]] bool is_below(const Eigen::Vector3d& point, double reach, double slack) const;
    /// The point of the face that is nearest to a point. A face that is not planar is as thick as its corners are apart
    /// along the normal.
    [[nodiscard]] Eigen::Vector3d nearest(const Eigen::Vector3d& point) const;
    /// A bound of the distance of `nearest` from the face, by the error of the normal.
    [[nodiscard]] double nearest_error() const { return 2 * normal_.error * diameter_; }

private:
    [[nodiscard]] const Eigen::Vector3d& corner(std::size_t i) const { return body_->vertices()[corners_[i]]; }
    [[nodiscard]] bool is_left_of(std::size_t from, std::size_t to, const Eigen::Vector3d& point,
                                  double tolerance) const;
    [[nodiscard]] bool is_inside(const Eigen::Vector3d& point, double tolerance) const;
    [[nodiscard]] double height_of(const Eigen::Vector3d& point) const;

    const Body* body_;
    std::uint32_t face_;
    std::span<const std::uint32_t> corners_;
    FaceNormal normal_;
    double diameter_ = 0;
    double lowest_ = 0;  ///< of the corners, along the normal from the first corner
    double highest_ = 0; ///< likewise
};

/// The last face that was asked for. Consecutive questions often share a face.
class LastFaceAtRest {
public:
    /// Valid until another face is asked for.
    const FaceAtRest& of(const Body& body, std::uint32_t face) {
        if (!face_ || face_->face() != face)
            face_.emplace(body, face);
        return *face_;
    }

private:
    std::optional<FaceAtRest> face_;
};

/// The tests of one scene. Keeps what it knows of the last face of each body.
class NearTest {
public:
    /// The scene is kept by reference.
    explicit NearTest(const ContactScene& scene) : scene_(scene) {}

    /// The side of a face's plane on which a vertex of the other body is; 0 if it may be within the margin of the
    /// plane.
    int side_on_fixed_face(std::uint32_t face, std::uint32_t vertex);
    int side_on_moving_face(std::uint32_t face, std::uint32_t vertex);

    /// Whether the distance of two features is at most the margin, up to the slack. The nearest points must be in the
    /// relative interiors of both features, up to the slack; those of edges that touch need not. Other features are
    /// nearer, or as near, where they are not.
    bool are_near(const FeaturePair& features);

    /// Whether the features are near, and touch or are at a local minimum of the distance of both surfaces.
    bool are_in_contact(const FeaturePair& features);

private:
    const FaceAtRest& moving_face(std::uint32_t face) { return moving_face_.of(scene_.bodies.moving(), face); }
    const FaceAtRest& fixed_face(std::uint32_t face) { return fixed_face_.of(scene_.bodies.fixed(), face); }
    [[nodiscard]] Eigen::Vector3d moving_vertex(std::uint32_t vertex) const;
    [[nodiscard]] Eigen::Vector3d fixed_vertex(std::uint32_t vertex) const;
    [[nodiscard]] double reach() const { return scene_.margin + scene_.slack; }

    const ContactScene& scene_;
    LastFaceAtRest moving_face_;
    LastFaceAtRest fixed_face_;
};

/// Whether the distance of features at these points is a local minimum, up to the slack and the slopes.
bool is_local_minimum(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest);

} // namespace chasles::contact
