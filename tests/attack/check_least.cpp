#include "tests/attack/check_least.h"

#include "chasles/base/invalid_input.h"
#include "chasles/query/least_distance.h"
#include "tests/attack/check_margin.h"
#include "tests/attack/two_bodies.h"
#include "tests/support/margin_reference.h"

#include <chrono>

namespace chasles::attack {

namespace {

using reference::Surface;

/// How far brackets may be wider than asked for, and what counts as touching, relative to the size of the scene.
constexpr double resolution = 8e-12;

/// What exact arithmetic can say about one case.
class ExactDistance {
public:
    explicit ExactDistance(const MeshCase& mesh)
        : moving_(Surface::from_convex_faces(mesh.moving.vertices, mesh.moving.faces)),
          fixed_(Surface::from_convex_faces(mesh.fixed.vertices, mesh.fixed.faces)), paths_(mesh.posed.paths()) {}

    /// Whether the surfaces come within a distance greater than 0.
    [[nodiscard]] bool falls_to(double distance) const {
        return std::ranges::any_of(paths_, [&](const MotionPath<Rational>& path) {
            return reference::MarginScene(moving_, fixed_, path, distance).first_time().has_value();
        });
    }

private:
    Surface moving_;
    Surface fixed_;
    std::vector<MotionPath<Rational>> paths_;
};

double size_of(const MeshCase& mesh) {
    double size = 0;
    for (const Shape* shape : {&mesh.moving, &mesh.fixed})
        for (const Eigen::Vector3d& v : shape->vertices)
            size = std::max(size, v.norm());
    const PosedMotion& motion = mesh.posed;
    for (const Pose* pose : {&motion.moving_start, &motion.moving_goal, &motion.fixed_start, &motion.fixed_goal})
        size = std::max(size, pose->translation.norm());
    return size;
}

std::string judged(const MeshCase& mesh, const LeastDistance& found, Tally& tally) {
    const ExactDistance exact(mesh);
    if (found.distance.lower > 0 && exact.falls_to(found.distance.lower)) {
        ++tally.missed;
        return "the surfaces come nearer than the lower end";
    }
    if (!exact.falls_to(std::max(found.distance.upper, resolution * size_of(mesh)))) {
        ++tally.false_alarms;
        return "the surfaces do not come within the upper end";
    }
    ++tally.touches;
    const double excess = found.distance.upper - found.distance.lower - 1e-6 * found.distance.upper;
    if (found.certain && excess > 0) {
        ++tally.outside;
        return "certain of a wide bracket";
    }
    if (excess > resolution * size_of(mesh)) {
        ++tally.loose;
        return "a wide bracket";
    }
    return "";
}

} // namespace

std::vector<LeastFamily> least_families() {
    std::vector<LeastFamily> families;
    for (const MarginFamily& family : margin_families())
        families.push_back({family.name, family.share, family.make});
    return families;
}

std::string check(const LeastCase& posed, Tally& tally) {
    using Clock = std::chrono::steady_clock;
    const MeshCase& mesh = posed.posed.mesh;
    const auto bodies = bodies_of(mesh.moving, mesh.fixed, tally);
    if (!bodies)
        return "";
    const auto& [moving, fixed] = *bodies;
    const auto start = Clock::now();
    const LeastDistance found =
        least_distance({.moving = moving, .fixed = fixed, .motion = mesh.posed.motion(), .options = {}});
    const auto end = Clock::now();
    ++tally.queries;
    tally.uncertain += found.certain ? 0 : 1;
    tally.tests += found.work.elementary_tests;
    tally.refined += found.work.refined;
    tally.exact += found.work.exact;
    tally.seconds += std::chrono::duration<double>(end - start).count();
    const std::string wrong = judged(mesh, found, tally);
    tally.reference_seconds += std::chrono::duration<double>(Clock::now() - end).count();
    if (wrong.empty())
        return "";
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, ": [%.17g, %.17g] at time %.17g%s", found.distance.lower, found.distance.upper,
                  found.time.lower, found.certain ? ", certain" : "");
    return wrong + buffer;
}

std::string described(const LeastCase& posed) {
    return described(posed.posed);
}

} // namespace chasles::attack
