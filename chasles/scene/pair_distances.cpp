// How near do each two bodies of a scene come? Source: docs/derivations/27-scenes.md, "All pairs".
#include "chasles/base/limit_of_thread.h"
#include "chasles/base/parallel_for.h"
#include "chasles/base/sort.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/scene/pair_question.h"
#include "chasles/scene/pair_tasks.h"
#include "chasles/scene/swept_body.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

namespace chasles {

namespace {

using Eigen::Vector3d;

/// A body at the start.
struct Placed {
    const Body& body;
    Eigen::Isometry3d pose;

    /// One of at most some hundred vertices, in the world.
    [[nodiscard]] Vector3d vertex_near(const Vector3d& point) const {
        constexpr std::size_t most = 128;
        const auto vertices = body.vertices();
        Vector3d nearest = pose * vertices.front();
        for (std::size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / most)
            if (const Vector3d vertex = pose * vertices[i]; (vertex - point).norm() < (nearest - point).norm())
                nearest = vertex;
        return nearest;
    }
};

/// Of two vertices at the start that are near each other. A position in double has an error below 2^-46 of all sizes
/// (docs/derivations/24-enclosures.md).
double distance_of_vertices(const Placed& moving, const Placed& fixed) {
    constexpr double rounding = 1e-12;
    const Vector3d p = moving.vertex_near(fixed.pose * fixed.body.vertices().front());
    const Vector3d q = fixed.vertex_near(p);
    const double size = p.norm() + moving.pose.translation().norm() + q.norm() + fixed.pose.translation().norm();
    return std::max(0.0, (p - q).norm() - distance_of_polyhedra(moving.body, fixed.body, 0) + rounding * size);
}

/// The boxes that the bodies sweep.
std::vector<scene::Box> swept_boxes(const Scene& world, unsigned threads) {
    std::vector<scene::Box> boxes(world.bodies().size());
    parallel_for(threads, boxes.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const scene::WorldMotion& motion = world.motion_of(i);
            boxes[i] = scene::swept({world.bodies()[i].shape.body(), *motion.frame, motion.rests}, 1).box;
        }
    });
    return boxes;
}

/// The pairs of a scene with what is proven of them before they are asked.
class MatrixSearch {
public:
    MatrixSearch(const Scene& world, const LeastDistanceOptions& options, const BatchOptions& batch);

    std::vector<PairDistance> run();

private:
    void ask_all(const std::vector<std::size_t>& order, double seconds_of_pair);
    [[nodiscard]] LeastDistance ask(std::size_t pair) const;
    [[nodiscard]] LeastDistance without_search(std::size_t pair) const;
    void report_progress();

    const Scene& scene_;
    const LeastDistanceOptions& options_;
    const BatchOptions& batch_;
    std::vector<PairDistance> pairs_;
    std::vector<double> bounds_; ///< of each pair: the distance of the boxes that both bodies sweep
    std::vector<char> is_done_;  ///< of each pair: its answer is not cut by a limit
    Mutex reporting_;
    std::size_t done_ = 0;
};

MatrixSearch::MatrixSearch(const Scene& world, const LeastDistanceOptions& options, const BatchOptions& batch)
    : scene_(world), options_(options), batch_(batch) {
    constexpr double rounding = 1e-14; // as in pairs_by_distance.cpp
    const std::vector<scene::Box> boxes = swept_boxes(world, batch.threads);
    for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = a + 1; b < boxes.size(); ++b) {
            if (world.is_ignored(a, b) || (world.rests(a) && world.rests(b)))
                continue;
            const auto [moving, fixed] = scene::in_their_roles(world, {std::uint32_t(a), std::uint32_t(b)});
            pairs_.push_back({moving, fixed, {}});
            pairs_.back().nearest.distance.upper = std::numeric_limits<double>::infinity();
            bounds_.push_back(boxes[a].exteriorDistance(boxes[b]) * (1 - rounding));
        }
    is_done_.resize(pairs_.size());
}

/// A search that the limit ends has a lower end of 0 at least.
LeastDistance MatrixSearch::ask(std::size_t pair) const {
    if (is_cancelled())
        return without_search(pair);
    const scene::Mover moving = scene::mover(scene_, pairs_[pair].moving),
                       fixed = scene::mover(scene_, pairs_[pair].fixed);
    LeastDistance found = scene::along(moving, fixed, [&](const motion::AnyTrajectory& trajectory) {
        return query::answer(query::LeastPairQuery{moving.shape.body(), fixed.shape.body(), trajectory, options_});
    });
    if (!found.certain)
        found.distance.lower = std::clamp(bounds_[pair], found.distance.lower, found.distance.upper);
    return found;
}

LeastDistance MatrixSearch::without_search(std::size_t pair) const {
    const SceneBody &moving = scene_.bodies()[pairs_[pair].moving], &fixed = scene_.bodies()[pairs_[pair].fixed];
    LeastDistance known;
    known.pose = moving.motion.pose_at(0);
    known.fixed_pose = fixed.motion.pose_at(0);
    known.distance.upper = distance_of_vertices({moving.shape.body(), known.pose.isometry()},
                                                {fixed.shape.body(), known.fixed_pose.isometry()});
    known.distance.lower = std::min(bounds_[pair], known.distance.upper);
    return known;
}

void MatrixSearch::report_progress() {
    if (!batch_.progress)
        return;
    const Lock lock(reporting_);
    batch_.progress(++done_);
}

/// Of two answers about one pair, with the work of both.
LeastDistance narrower(LeastDistance known, LeastDistance found) {
    Work work = known.work;
    work += found.work;
    LeastDistance& nearer = found.certain || found.distance.upper <= known.distance.upper ? found : known;
    if (!found.certain)
        nearer.distance.lower = std::min(std::max(known.distance.lower, found.distance.lower), nearer.distance.upper);
    nearer.work = work;
    return nearer;
}

/// Threads take one pair after another, each for so long. A pair that takes longer is not done.
void MatrixSearch::ask_all(const std::vector<std::size_t>& order, double seconds_of_pair) {
    std::atomic<std::size_t> taken = 0;
    parallel_for(batch_.threads, order.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t pair = order[taken++];
            const Limit limit(seconds_of_pair);
            LeastDistance& nearest = pairs_[pair].nearest;
            nearest = narrower(std::move(nearest), ask(pair));
            is_done_[pair] = !limit.is_over();
            if (is_done_[pair])
                report_progress();
        }
    });
}

/// The nearest boxes first: a limit leaves pairs that are proven to be far apart. Where the time is limited, pairs that
/// take long are asked again after all others, for a longer time.
std::vector<PairDistance> MatrixSearch::run() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double first_seconds = 0.1, growth = 4; // all attempts but the last one take a third of its time
    std::vector<std::size_t> order(pairs_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    chasles::sort(order, {}, [&](std::size_t i) { return std::pair(bounds_[i], i); });
    const Limit* const limit = LimitOfThread::get();
    const bool is_limited = limit && limit->has_end();
    for (double seconds = is_limited ? first_seconds : infinity; !order.empty(); seconds *= growth) {
        ask_all(order, seconds);
        if (!is_limited || is_cancelled())
            break;
        std::erase_if(order, [&](std::size_t i) { return is_done_[i] != 0; });
    }
    return std::move(pairs_);
}

} // namespace

DistanceMatrix Scene::least_distances(const LeastDistanceOptions& options, const BatchOptions& batch) const {
    query::check_options(options);
    return {MatrixSearch(*this, options, batch).run(), numbers_of_untested({})};
}

} // namespace chasles
