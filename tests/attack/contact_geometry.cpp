#include "tests/attack/contact_geometry.h"

#include "tests/support/segment_distance.h"

#include <cstdio>

namespace chasles::attack {

namespace {

using Points = std::vector<Eigen::Vector3d>;

/// The corners of a feature in the world.
Points corners_of(const Polyhedron& body, FeatureKind kind, const Feature& feature, const Eigen::Isometry3d& pose) {
    Points result;
    const auto add = [&](std::uint32_t vertex) { result.push_back(pose * body.vertices()[vertex]); };
    if (kind == FeatureKind::vertex)
        add(feature.first);
    if (kind == FeatureKind::edge) {
        add(feature.first);
        add(feature.second);
    }
    if (kind == FeatureKind::face)
        for (std::size_t face = 0; face < body.face_count(); ++face)
            if (body.source_face(face) == feature.first)
                for (const std::uint32_t vertex : body.face(face))
                    add(vertex);
    return result;
}

/// The distance from a point to a vertex, an edge or a convex face.
double distance_to(const Points& feature, const Eigen::Vector3d& p) {
    if (feature.size() == 1)
        return (p - feature[0]).norm();
    if (feature.size() == 2)
        return test::distance_to_segment(p, {feature[0], feature[1]});
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < feature.size(); ++i)
        least = std::min(least, test::distance_to_triangle(p, {feature[0], feature[i], feature[i + 1]}));
    return least;
}

std::string wrong(const char* what, double value) {
    char buffer[120];
    std::snprintf(buffer, sizeof buffer, "a contact whose %s is off by %.3g", what, value);
    return buffer;
}

} // namespace

std::string misplaced(const FirstContactQuery& query, const FirstContact& found, double scene_size) {
    const Eigen::Isometry3d moving = found.pose.isometry();
    const Eigen::Isometry3d fixed = query.motion.fixed_pose_at(found.time.lower).isometry();
    if (found.verdict == Verdict::contact && found.contacts.empty())
        return "a contact without features";
    for (const Contact& contact : found.contacts) {
        const Points a = corners_of(query.moving, moving_feature_kind(contact.kind), contact.moving, moving);
        const Points b = corners_of(query.fixed, fixed_feature_kind(contact.kind), contact.fixed, fixed);
        if (a.empty() || b.empty())
            return "a contact of no feature";
        // The tolerance covers the rounding of doubles and the motion within the bracket.
        const double width = found.time.upper - found.time.lower;
        const double slack = 1e-13 * scene_size + 2 * width * (std::abs(contact.approach_speed) + scene_size);
        if (const double off = distance_to(b, contact.point); off > slack)
            return wrong("point", off);
        if (const double off = std::abs(contact.normal.norm() - 1); off > 1e-12)
            return wrong("normal's length", off);
        if (const double off = distance_to(a, contact.point + contact.gap * contact.normal); off > slack)
            return wrong("other point", off);
        if (const double off = std::abs(contact.gap - query.options.margin);
            found.verdict == Verdict::contact && off > slack)
            return wrong("gap", off);
        if (found.verdict == Verdict::contact_at_start && contact.gap > query.options.margin + slack)
            return wrong("gap at the start", contact.gap - query.options.margin);
        if (found.verdict == Verdict::contact && contact.approach_speed < -1e-6 * scene_size)
            return wrong("approach speed", contact.approach_speed);
    }
    return "";
}

} // namespace chasles::attack
