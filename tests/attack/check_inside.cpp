#include "tests/attack/check_inside.h"

#include "tests/support/solid_angle.h"

namespace chasles::attack {

namespace {

Polyhedron solid_copy(const Polyhedron& body) {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        faces.emplace_back(body.face(face).begin(), body.face(face).end());
    return Polyhedron::from_polygons(body.vertices(), faces);
}

/// Whether a point known within an error is inside. Empty next to the surface, and where only some parts are solid.
std::optional<bool> is_inside(const Polyhedron& body, const Eigen::Vector3d& point, double error) {
    constexpr double doubt = 0.01, most_error = 1e-6; // bodies are some units large
    const MeshReport report = body.report();
    const std::size_t closed_parts = report.solid_parts + report.inward_parts;
    if (closed_parts != report.parts)
        return closed_parts == 0 ? std::optional(false) : std::nullopt;
    if (error > most_error)
        return std::nullopt;
    const double winding = std::round(test::winding_by_solid_angles(body, point));
    for (int axis = 0; axis < 3; ++axis)
        for (const double way : {-error, error}) {
            const Eigen::Vector3d beside = point + way * Eigen::Vector3d::Unit(axis);
            if (std::abs(test::winding_by_solid_angles(body, beside) - winding) > doubt)
                return std::nullopt;
        }
    return winding > 0;
}

/// The moving body at the start, as the fixed one sees it.
struct Place {
    Eigen::Isometry3d pose;
    double error;

    Place(const Motion& motion, const Polyhedron& moving_body, const Polyhedron& fixed_body) {
        const auto size = [](const Polyhedron& body) {
            return body.report().lower.norm() + body.report().upper.norm();
        };
        const Eigen::Isometry3d moving = motion.pose_at(0).isometry(), fixed = motion.fixed_pose_at(0).isometry();
        pose = fixed.inverse() * moving;
        error = 1e-11 *
                (1 + moving.translation().norm() + fixed.translation().norm() + size(moving_body) + size(fixed_body));
    }
};

bool has_vertex_inside(const Polyhedron& inner, const Polyhedron& outer, const Eigen::Isometry3d& pose, double error) {
    for (std::size_t face = 0; face < inner.face_count(); ++face)
        for (const std::uint32_t vertex : inner.face(face))
            if (is_inside(outer, pose * inner.vertices()[vertex], error).value_or(false))
                return true;
    return false;
}

} // namespace

std::string check_inside(const FirstContactQuery& surfaces, const FirstContact& found, Tally& tally) {
    FirstContactQuery query = surfaces;
    query.moving = solid_copy(surfaces.moving);
    query.fixed = solid_copy(surfaces.fixed);
    const FirstContact solid = first_contact(query);
    const bool meet = found.verdict == Verdict::contact_at_start && query.options.margin == 0;
    const auto [pose, error] = Place(query.motion, query.moving, query.fixed);
    const auto wrong = [&](const char* why) {
        ++tally.misnamed;
        return std::string(why);
    };
    if (!solid.inside) {
        if (solid.verdict != found.verdict || solid.certain != found.certain || solid.time.lower != found.time.lower ||
            solid.time.upper != found.time.upper)
            return wrong("solid bodies have another answer");
        const bool may_meet = found.verdict == Verdict::contact_at_start ||
                              (query.options.find == Find::any && found.verdict != Verdict::clear);
        if (!may_meet && (has_vertex_inside(query.moving, query.fixed, pose, error) ||
                          has_vertex_inside(query.fixed, query.moving, pose.inverse(), error)))
            return wrong("a body inside of the other one is not named");
        return "";
    }
    ++tally.nested;
    if (meet && found.certain)
        return wrong("a body is called inside though surfaces meet");
    const bool is_moving = solid.inside->moving_is_inside;
    const Polyhedron &inner = is_moving ? query.moving : query.fixed, &outer = is_moving ? query.fixed : query.moving;
    const Eigen::Vector3d point = (is_moving ? pose : pose.inverse()) * inner.vertices()[solid.inside->vertex.first];
    return is_inside(outer, point, error).value_or(true) ? "" : wrong("a body is called inside and is not");
}

} // namespace chasles::attack
