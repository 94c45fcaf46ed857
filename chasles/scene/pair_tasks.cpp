#include "chasles/scene/pair_tasks.h"

#include "chasles/base/parallel_for.h"
#include "chasles/motion/screw_path.h"
#include "chasles/scene/box_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace chasles::scene {

namespace {

using Eigen::Vector3d;

/// A ball around a body, whose centre moves near a straight, even way.
struct MovingBall {
    Vector3d start;    ///< of the centre
    Vector3d way;      ///< of the centre until the end of the question
    double radius = 0; ///< of the ball, with how far the centre leaves its way
    double size = 0;   ///< of all lengths that enter
};

/// The way of a body whose rates jump is not even: its ball is everywhere, and the boxes alone decide.
MovingBall ball_of(const WorldBody& body, double until) {
    const Bvh& tree = body.body->bvh();
    const motion::MovingFrame& frame = *body.frame;
    const auto centre = motion::vector_in<double>(tree.centre());
    const auto place = [&](double time) {
        const auto at = placed(frame.at(time), centre);
        return Vector3d(at.x, at.y, at.z);
    };
    MovingBall ball{place(0), Vector3d::Zero(), body.body->vertex_radius(), frame.size() + norm1(centre)};
    std::vector<double> cuts;
    if (!body.rests)
        frame.add_cuts(cuts);
    const double arm = length(centre - frame.reference());
    if (std::ranges::any_of(cuts, [&](double cut) { return 0 < cut && cut < until; }))
        ball.radius = std::numeric_limits<double>::infinity();
    else if (!body.rests) {
        ball.way = place(until) - ball.start;
        ball.radius += deviation_from_straight(frame.rates({0, until}), arm, until);
    }
    return ball;
}

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
        const double earliest = query.until * earliest_meeting(balls[a], balls[b], query.options.margin);
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
