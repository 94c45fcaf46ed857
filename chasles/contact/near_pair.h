// Whether two features are within a distance of each other at one moment, and whether they are a contact.
// Source: docs/derivations/18-contact-set.md, "Which pairs".
#pragma once

#include "chasles/contact/contact_frame.h"

#include <optional>
#include <span>

namespace chasles::contact {

/// A face in the frame of its body, for distances of points.
class FaceAtRest {
public:
    FaceAtRest(const Body& body, std::uint32_t face);

    [[nodiscard]] std::uint32_t face() const { return face_; }
    /// Whether a point is within `reach` of the face, and its foot on the plane is in the face up to `slack`.
    [[nodiscard]] bool is_below(const Eigen::Vector3d& point, double reach, double slack) const;

private:
    [[nodiscard]] const Eigen::Vector3d& corner(std::size_t i) const { return body_->vertices()[corners_[i]]; }
    [[nodiscard]] bool is_left_of(std::size_t from, std::size_t to, const Eigen::Vector3d& point,
                                  double tolerance) const;
    [[nodiscard]] bool is_inside(const Eigen::Vector3d& point, double tolerance) const;
    [[nodiscard]] bool is_near_rim(const Eigen::Vector3d& point, double reach) const;

    const Body* body_;
    std::uint32_t face_;
    std::span<const std::uint32_t> corners_;
    Eigen::Vector3d normal_;
    double diameter_ = 0;
    double thickness_ = 0; ///< the greatest distance of a corner from the plane
    double error_ = 0;     ///< of the direction of the normal
};

/// The tests of one scene. Keeps what it knows of the last face of each body.
class NearTest {
public:
    /// The scene is kept by reference.
    explicit NearTest(const ContactScene& scene) : scene_(scene) {}

    /// Whether the distance of two features is at most the margin, up to the slack. The nearest points must be in the
    /// relative interiors of both features, up to the slack; those of edges that touch need not. Other features are
    /// nearer, or as near, where they are not.
    bool are_near(const FeaturePair& features);

    /// Whether the features are near, and touch or are at a local minimum of the distance of both surfaces.
    bool are_in_contact(const FeaturePair& features);

private:
    const FaceAtRest& face_of(const Body& body, std::uint32_t face, std::optional<FaceAtRest>& last);

    const ContactScene& scene_;
    std::optional<FaceAtRest> moving_face_;
    std::optional<FaceAtRest> fixed_face_;
};

/// Whether the distance of features at these points is a local minimum, up to the slack.
bool is_local_minimum(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest);

} // namespace chasles::contact
