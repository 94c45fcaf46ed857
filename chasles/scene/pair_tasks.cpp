#include "chasles/scene/pair_tasks.h"

#include "chasles/base/parallel_for.h"
#include "chasles/scene/box_pairs.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace chasles::scene {

namespace {

using Eigen::Vector3d;

/// A share of the time of the question before which the balls are farther apart than the margin; 2 if they are so all
/// along. It is the first root of |d + t w|^2 = r^2.
double earliest_meeting(const MovingBall& a, const MovingBall& b, double margin) {
    constexpr double rounding = 1e-12, never = 2;
    const Vector3d apart = a.start - b.start, way = a.way - b.way;
    const double reach = a.radius + b.radius + margin + rounding * (apart.norm() + way.norm() + a.size + b.size);
    const double gap = apart.squaredNorm() - reach * reach;
    if (!(gap > 0))
        return 0;
    const double closing = -apart.dot(way), square = way.squaredNorm();
    if (closing <= 0 || (apart + way * (closing / square)).norm() > reach) // where they are nearest
        return never;
    const double root = std::max(0.0, closing * closing - square * gap);
    return std::min(never, gap / (closing + std::sqrt(root)) * (1 - 1e-6));
}

/// What each body sweeps; the boxes are wide enough for the margin.
std::vector<SweptBody> swept_bodies(const Scene& scene, const SceneQuery& query) {
    std::vector<SweptBody> bodies(scene.bodies().size());
    const Vector3d wider = Vector3d::Constant(query.options.margin);
    parallel_for(query.threads, bodies.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Scene::Placed& placed = scene.placed(i);
            bodies[i] = swept({scene.bodies()[i].shape.body(), *placed.frame, placed.rests}, query.until);
            bodies[i].box.min() -= wider;
            bodies[i].box.max() += wider;
        }
    });
    return bodies;
}

/// The pairs whose balls may meet, in no useful order.
std::vector<PairTask> near_tasks(const Scene& scene, const SceneQuery& query) {
    const std::vector<SweptBody> bodies = swept_bodies(scene, query);
    const std::vector<IndexPair> pairs = BoxTree(bodies).overlapping_pairs(query.threads);
    constexpr std::size_t chunk = 1024;
    std::vector<std::vector<PairTask>> chunks((pairs.size() + chunk - 1) / chunk);
    parallel_chunks(query.threads, pairs.size(), chunk, [&](std::size_t index, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto [a, b] = pairs[i];
            const double share = earliest_meeting(bodies[a].ball, bodies[b].ball, query.options.margin);
            if (share <= 1 && !scene.is_ignored(a, b))
                chunks[index].push_back({query.until * share, a, b});
        }
    });
    std::vector<PairTask> tasks;
    for (const std::vector<PairTask>& part : chunks)
        tasks.insert(tasks.end(), part.begin(), part.end());
    return tasks;
}

} // namespace

std::vector<PairTask> pair_tasks(const Scene& scene, const SceneQuery& query) {
    const auto name = [&](std::uint32_t i) -> const std::string& { return scene.bodies()[i].name; };
    std::vector<PairTask> tasks = near_tasks(scene, query);
    for (PairTask& task : tasks) {
        const bool rests = scene.placed(task.moving).rests;
        if (rests != scene.placed(task.fixed).rests ? rests : name(task.fixed) < name(task.moving))
            std::swap(task.moving, task.fixed);
    }
    std::ranges::sort(tasks, [&](const PairTask& a, const PairTask& b) {
        if (a.earliest != b.earliest)
            return a.earliest < b.earliest;
        return std::tie(name(a.moving), name(a.fixed)) < std::tie(name(b.moving), name(b.fixed));
    });
    return tasks;
}

} // namespace chasles::scene
