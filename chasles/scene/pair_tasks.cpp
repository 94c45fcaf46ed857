#include "chasles/scene/pair_tasks.h"

#include "chasles/base/parallel_for.h"
#include "chasles/motion/screw_path.h"
#include "chasles/scene/box_pairs.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace chasles::scene {

namespace {

using Eigen::Vector3d;

/// A ball around a body at the start, and how fast its centre moves at most.
struct MovingBall {
    Vector3d centre;
    double radius = 0;
    double speed = 0;
    double size = 0; ///< of all lengths that enter
};

MovingBall ball_of(const WorldBody& body, double until) {
    const Bvh& tree = body.body->bvh();
    const motion::MovingFrame& frame = *body.frame;
    const auto centre = motion::vector_in<double>(tree.centre());
    const auto start = frame.at(0);
    const auto place = rotated(start.rotation, centre) + start.translation;
    MovingBall ball{{place.x, place.y, place.z}, tree.radius(), 0, frame.size() + norm1(centre)};
    std::vector<double> cuts;
    if (!body.rests)
        frame.add_cuts(cuts);
    std::ranges::sort(cuts);
    const double arm = length(centre - frame.reference());
    for (Bracket times{0, 0}; times.upper < until && !body.rests;) {
        const auto next = std::ranges::upper_bound(cuts, times.upper);
        times = {times.upper, next == cuts.end() ? 1 : *next};
        const motion::RateBounds rates = frame.rates(times);
        ball.speed = std::max(ball.speed, rates.speed + rates.turn_rate * arm);
    }
    return ball;
}

/// A time before which the balls are farther apart than the margin.
double earliest_meeting(const MovingBall& a, const MovingBall& b, double margin) {
    constexpr double rounding = 1e-12;
    const double distance = (a.centre - b.centre).norm();
    const double gap = distance - a.radius - b.radius - margin - rounding * (distance + a.size + b.size);
    const double speed = a.speed + b.speed;
    return gap > 0 && speed > 0 ? gap / speed * (1 - rounding) : 0;
}

std::vector<WorldBody> world_bodies(const Scene& scene) {
    std::vector<WorldBody> bodies;
    for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
        const Scene::Placed& placed = scene.placed(i);
        bodies.push_back({&scene.bodies()[i].shape.body(), placed.frame, placed.rests});
    }
    return bodies;
}

/// The pairs whose swept boxes overlap.
std::vector<IndexPair> near_pairs(const std::vector<WorldBody>& bodies, const SceneQuery& query) {
    std::vector<Box> boxes(bodies.size());
    const Vector3d wider = Vector3d::Constant(query.options.margin);
    parallel_for(query.threads, bodies.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            boxes[i] = swept_box(bodies[i], {0, query.until});
            boxes[i].min() -= wider;
            boxes[i].max() += wider;
        }
    });
    return BoxTree(boxes).overlapping_pairs(query.threads);
}

} // namespace

std::vector<PairTask> pair_tasks(const Scene& scene, const SceneQuery& query) {
    const std::vector<WorldBody> bodies = world_bodies(scene);
    std::vector<MovingBall> balls(bodies.size());
    parallel_for(query.threads, bodies.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            balls[i] = ball_of(bodies[i], query.until);
    });
    std::vector<std::uint32_t> rank(bodies.size());
    const std::vector<std::size_t> names = scene.in_order_of_names();
    for (std::size_t i = 0; i < names.size(); ++i)
        rank[names[i]] = std::uint32_t(i);

    std::vector<PairTask> tasks;
    for (const auto& [a, b] : near_pairs(bodies, query)) {
        if (scene.is_ignored(a, b))
            continue;
        const double earliest = earliest_meeting(balls[a], balls[b], query.options.margin);
        const bool swaps = bodies[a].rests != bodies[b].rests ? bodies[a].rests : rank[b] < rank[a];
        if (earliest <= query.until)
            tasks.push_back({earliest, swaps ? b : a, swaps ? a : b});
    }
    std::ranges::sort(tasks, {}, [&](const PairTask& task) {
        return std::tuple(task.earliest, rank[task.moving], rank[task.fixed]);
    });
    return tasks;
}

} // namespace chasles::scene
