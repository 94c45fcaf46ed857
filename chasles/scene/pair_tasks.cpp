#include "chasles/scene/pair_tasks.h"

#include "chasles/base/parallel_for.h"
#include "chasles/base/sort.h"
#include "chasles/scene/pair_question.h"

#include <algorithm>

namespace chasles::scene {

std::vector<SweptBody> swept_bodies(const Scene& scene, const SceneQuery& query) {
    std::vector<SweptBody> bodies(scene.bodies().size());
    const double margin = scene.margins(query.options.margin).upper;
    constexpr std::size_t chunk = 64;
    parallel_chunks(query.threads, bodies.size(), chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const WorldMotion& motion = scene.motion_of(i);
            bodies[i] = swept({scene.bodies()[i].shape.body(), *motion.frame, motion.rests}, query.until);
            bodies[i].box = widened(bodies[i].box, margin);
        }
    });
    return bodies;
}

PairNames names_of(const Scene& scene, const IndexPair& pair) {
    return {scene.bodies()[pair.first].name, scene.bodies()[pair.second].name};
}

IndexPair in_their_roles(const Scene& scene, const IndexPair& pair) {
    const auto [a, b] = pair;
    const bool rests = scene.motion_of(a).rests;
    const auto [name, other] = names_of(scene, pair);
    const bool swaps = rests != scene.motion_of(b).rests ? rests : other < name;
    return swaps ? IndexPair(b, a) : pair;
}

std::vector<PairTask> near_pairs(const Scene& scene, const SceneQuery& query, const std::vector<SweptBody>& bodies,
                                 const BoxTree& tree) {
    const std::vector<IndexPair> pairs = tree.overlapping_pairs(query.threads);
    const auto never_move = [&](std::size_t a, std::size_t b) { return scene.rests(a) && scene.rests(b); };
    constexpr std::size_t chunk = 1024;
    return joined_chunks<PairTask>(
        query.threads, pairs.size(), chunk, [&](std::size_t begin, std::size_t end, std::vector<PairTask>& tasks) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto [a, b] = pairs[i];
                if (query.until > 0 && never_move(a, b))
                    continue;
                const double margin = scene.margin_of(a, b, query.options.margin);
                const double share = earliest_meeting(bodies[a].ball, bodies[b].ball, margin);
                if (share <= 1 && !scene.is_ignored(a, b))
                    tasks.push_back({query.until * share, in_their_roles(scene, pairs[i])});
            }
        });
}

std::vector<PairTask> pair_tasks(const Scene& scene, const SceneQuery& query) {
    const std::vector<SweptBody> bodies = swept_bodies(scene, query);
    std::vector<PairTask> tasks = near_pairs(scene, query, bodies, BoxTree(bodies, query.threads));
    chasles::sort(tasks, [&](const PairTask& a, const PairTask& b) { // names are compared only if they count
        return a.earliest != b.earliest ? a.earliest < b.earliest : names_of(scene, a.pair) < names_of(scene, b.pair);
    });
    return tasks;
}

} // namespace chasles::scene
