// Turns a plane until it separates the two farthest vertices, again and again. A direction costs a scan of the vertices
// of the fixed body, and two of those of the moving body.
#include "chasles/culling/plane_between.h"

#include "chasles/culling/near_nodes.h"

#include <algorithm>

namespace chasles::culling {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// These numbers decide only when the test gives up. They are measured with scenes_bench, clear_bench and peers_bench.

/// The number of directions.
constexpr int most_directions = 4;
/// Bodies with more vertices than this are not scanned.
constexpr std::size_t most_vertices = 1024;
/// No plane is looked for that would have to keep the bodies farther apart than this part of the smaller one's size.
constexpr double widest_of_size = 0.1;
/// The test gives up if the bodies overlap by more than this part of this size. Each direction halves what is allowed.
constexpr double overlap_of_size = 0.1;
/// A plane is turned this times as far as the two farthest vertices demand.
constexpr double overstep = 1.7;

/// A direction in the frame of a body, and how far the body reaches in it.
struct Reach {
    Reach(const Body& of, const Vector3d& along)
        : body(&of), direction(along.cast<float>()), distance(reach_of(of.vertex_blocks(), direction)) {}

    /// A vertex there.
    [[nodiscard]] Vector3d vertex() const {
        return vertex_at_reach(body->vertex_blocks(), direction, distance).cast<double>();
    }

    const Body* body;
    Vector3f direction;
    float distance;
};

} // namespace

bool have_plane_between(const CoarseScene& scene, const Placement& start, const Placement& end) {
    const Body& mover = scene.moving;
    const Body& target = scene.fixed;
    const double margin = scene.margin;
    if (std::max(mover.vertices().size(), target.vertices().size()) > most_vertices)
        return false;
    const double needed = CoarseBounds(scene).slack({}, start, end).moving + margin;
    const double size = std::min(size_of(mover.bvh()), size_of(target.bvh()));
    if (needed - margin > widest_of_size * size)
        return false;
    Vector3d normal = (start.offset + end.offset).normalized();
    double most_overlap = overlap_of_size * size;
    for (int i = 0; i < most_directions; ++i, most_overlap /= 2) {
        const Reach of_target(target, normal);
        const Reach at_start(mover, -(start.rotation.transpose() * normal));
        const Reach at_end(mover, -(end.rotation.transpose() * normal));
        const auto gap = [&](const Placement& placed, const Reach& of_mover) {
            return normal.dot(placed.offset) - double(of_mover.distance) - double(of_target.distance);
        };
        const double first = gap(start, at_start), last = gap(end, at_end), least = std::min(first, last);
        if (least > needed)
            return true;
        if (least < needed - most_overlap)
            return false;
        const Vector3d nearest = first < last ? start.rotation * at_start.vertex() + start.offset
                                              : end.rotation * at_end.vertex() + end.offset;
        const Vector3d apart = nearest - of_target.vertex();
        const Vector3d across = apart - normal.dot(apart) * normal;
        if (!(across.squaredNorm() > 0))
            return false;
        normal = (normal + overstep * (needed - least) / across.squaredNorm() * across).normalized();
    }
    return false;
}

} // namespace chasles::culling
