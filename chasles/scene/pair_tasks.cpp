#include "chasles/scene/pair_tasks.h"

#include "chasles/base/parallel_for.h"
#include "chasles/scene/pair_question.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace chasles::scene {

std::vector<SweptBody> swept_bodies(const Scene& scene, const SceneQuery& query) {
    std::vector<SweptBody> bodies(scene.bodies().size());
    const double margin = scene.largest_margin(query.options.margin);
    parallel_for(query.threads, bodies.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const WorldMotion& motion = scene.motion_of(i);
            bodies[i] = swept({scene.bodies()[i].shape.body(), *motion.frame, motion.rests}, query.until);
            bodies[i].box = widened(bodies[i].box, margin);
        }
    });
    return bodies;
}

IndexPair in_their_roles(const Scene& scene, const IndexPair& pair) {
    const auto [a, b] = pair;
    const auto name = [&](std::uint32_t i) -> const std::string& { return scene.bodies()[i].name; };
    const bool rests = scene.motion_of(a).rests;
    const bool swaps = rests != scene.motion_of(b).rests ? rests : name(b) < name(a);
    return swaps ? IndexPair(b, a) : pair;
}

std::vector<PairTask> near_pairs(const Scene& scene, const SceneQuery& query, const std::vector<SweptBody>& bodies,
                                 const BoxTree& tree) {
    const std::vector<IndexPair> pairs = tree.overlapping_pairs(query.threads);
    constexpr std::size_t chunk = 1024;
    std::vector<std::vector<PairTask>> chunks((pairs.size() + chunk - 1) / chunk);
    parallel_chunks(query.threads, pairs.size(), chunk, [&](std::size_t index, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto [a, b] = pairs[i];
            const double margin = scene.margin_of(a, b, query.options.margin);
            const double share = earliest_meeting(bodies[a].ball, bodies[b].ball, margin);
            if (share <= 1 && !scene.is_ignored(a, b))
                chunks[index].push_back({query.until * share, in_their_roles(scene, pairs[i])});
        }
    });
    std::vector<PairTask> tasks;
    for (const std::vector<PairTask>& part : chunks)
        tasks.insert(tasks.end(), part.begin(), part.end());
    return tasks;
}

std::vector<PairTask> pair_tasks(const Scene& scene, const SceneQuery& query) {
    const std::vector<SweptBody> bodies = swept_bodies(scene, query);
    std::vector<PairTask> tasks = near_pairs(scene, query, bodies, BoxTree(bodies));
    const auto name = [&](std::uint32_t i) -> const std::string& { return scene.bodies()[i].name; };
    std::ranges::sort(tasks, [&](const PairTask& a, const PairTask& b) {
        if (a.earliest != b.earliest)
            return a.earliest < b.earliest;
        return std::tie(name(a.pair.first), name(a.pair.second)) < std::tie(name(b.pair.first), name(b.pair.second));
    });
    return tasks;
}

} // namespace chasles::scene
