#include "chasles/contact/near_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace chasles::contact {

namespace {

using Eigen::Vector3d;

/// The rounding of a cross product, or of a product with it, over the product of the lengths.
constexpr double rounding = 8 * 0x1p-53;
/// A normal with a larger error gives no plane: the face is a line, up to rounding.
constexpr double no_plane = 0x1p-7;

/// A face in the frame of its body, for distances of points.
class FaceAtRest {
public:
    FaceAtRest(const Body& body, std::uint32_t face) : body_(body), face_(face), normal_(face_normal(body, face)) {
        double area = 0;
        double products = 0;
        const auto corners = body.face(face);
        for (std::size_t i = 1; i < corners.size(); ++i) {
            const Vector3d arm = corner(i) - corner(0);
            diameter_ = std::max(diameter_, arm.norm());
            thickness_ = std::max(thickness_, std::abs(normal_.dot(arm)));
            if (i + 1 < corners.size()) {
                const Vector3d next = corner(i + 1) - corner(0);
                area += normal_.dot(arm.cross(next));
                products += arm.norm() * next.norm();
            }
        }
        error_ = rounding * products / std::max(area, rounding * products);
        if (corners.size() == 3)
            thickness_ = 0;
    }

    /// Whether the foot of a point on the plane is in the face, up to `slack`, and the point is within `reach` of it.
    [[nodiscard]] bool is_below(const Vector3d& point, double reach, double slack) const {
        if (error_ > no_plane)
            return is_near_rim(point, reach);
        const double tolerance = slack + error_ * diameter_;
        return std::abs(normal_.dot(point - corner(0))) <= reach + error_ * diameter_ + thickness_ &&
               is_inside(point, tolerance);
    }

private:
    [[nodiscard]] const Vector3d& corner(std::size_t i) const { return body_.vertices()[body_.face(face_)[i]]; }

    /// Whether a point is to the left of a side, up to the tolerance.
    [[nodiscard]] bool is_left_of(const Vector3d& from, const Vector3d& to, const Vector3d& point,
                                  double tolerance) const {
        const Vector3d along = to - from;
        return normal_.dot(along.cross(point - from)) >= -tolerance * along.norm();
    }
    [[nodiscard]] bool is_inside(const Vector3d& point, double tolerance) const {
        const auto triangles = body_.face_triangles(face_);
        if (triangles.empty()) {
            const std::size_t count = body_.face(face_).size();
            for (std::size_t i = 0; i < count; ++i)
                if (!is_left_of(corner(i), corner(i + 1 == count ? 0 : i + 1), point, tolerance))
                    return false;
            return true;
        }
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            const std::array<Vector3d, 3> corners{corner(triangles[t]), corner(triangles[t + 1]),
                                                  corner(triangles[t + 2])};
            if (is_left_of(corners[0], corners[1], point, tolerance) &&
                is_left_of(corners[1], corners[2], point, tolerance) &&
                is_left_of(corners[2], corners[0], point, tolerance))
                return true;
        }
        return false;
    }
    [[nodiscard]] bool is_near_rim(const Vector3d& point, double reach) const {
        const std::size_t count = body_.face(face_).size();
        for (std::size_t i = 0; i < count; ++i) {
            const Vector3d& from = corner(i);
            const Vector3d along = corner(i + 1 == count ? 0 : i + 1) - from;
            const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
            if ((from + share * along - point).norm() <= reach)
                return true;
        }
        return false;
    }

    const Body& body_;
    std::uint32_t face_;
    Vector3d normal_;
    double diameter_ = 0;
    double thickness_ = 0; ///< the greatest distance of a corner from the plane
    double error_ = 0;     ///< of the direction of the normal
};

/// Whether a point is an end of an edge, up to the slack.
bool is_end_of(const Body& body, const Feature& edge, const Vector3d& point, double slack) {
    return (body.vertices()[edge.first] - point).norm() <= slack || (body.vertices()[edge.second] - point).norm() <= slack;
}

/// Whether the nearest point of an edge is one of its ends. Then the features of the end are as near.
bool is_at_an_end(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest) {
    const RelativeConfiguration& bodies = scene.bodies;
    return (moving_feature_kind(features.kind) == FeatureKind::edge &&
            is_end_of(bodies.moving(), features.moving, bodies.moved_back(nearest.on_moving), scene.slack)) ||
           (fixed_feature_kind(features.kind) == FeatureKind::edge &&
            is_end_of(bodies.fixed(), features.fixed, nearest.on_fixed, scene.slack));
}

bool are_near_at(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest) {
    const RelativeConfiguration& bodies = scene.bodies;
    const double reach = scene.margin + scene.slack;
    if (features.kind == ContactKind::vertex_face)
        return FaceAtRest(bodies.fixed(), features.fixed.first).is_below(nearest.on_moving, reach, scene.slack);
    if (features.kind == ContactKind::face_vertex)
        return FaceAtRest(bodies.moving(), features.moving.first)
            .is_below(bodies.moved_back(nearest.on_fixed), reach, scene.slack);
    const double distance = nearest.apart().norm();
    return distance <= reach && (distance <= scene.slack || !is_at_an_end(scene, features, nearest));
}

} // namespace

bool are_near(const ContactScene& scene, const FeaturePair& features) {
    return are_near_at(scene, features, scene.bodies.nearest(features));
}

bool are_in_contact(const ContactScene& scene, const FeaturePair& features) {
    const NearestPoints nearest = scene.bodies.nearest(features);
    return are_near_at(scene, features, nearest) && (scene.margin <= 0 || is_local_minimum(scene, features, nearest));
}

bool is_local_minimum(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest) {
    const double distance = nearest.apart().norm();
    return distance <= scene.slack || scene.bodies.descent(features, nearest) <= 4 * scene.slack / distance;
}

} // namespace chasles::contact
