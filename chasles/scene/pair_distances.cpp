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
#include <cmath>
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
    enum class Round : std::uint8_t { only, brief, last };
    static constexpr double seconds_of_brief_round = 0.1; ///< for one pair

    void ask_all(const std::vector<std::size_t>& order, Round round);
    [[nodiscard]] LeastDistance ask(std::size_t pair) const;
    [[nodiscard]] LeastDistance without_search(std::size_t pair) const;
    void report_progress();

    const Scene& scene_;
    const LeastDistanceOptions& options_;
    const BatchOptions& batch_;
    std::vector<PairDistance> pairs_;
    std::vector<double> bounds_; ///< of each pair: the distance of the boxes that both bodies sweep
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
            bounds_.push_back(boxes[a].exteriorDistance(boxes[b]) * (1 - rounding));
        }
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

/// Of two answers about one pair.
LeastDistance narrower(LeastDistance known, LeastDistance found) {
    found.work += known.work;
    if (found.certain)
        return found;
    LeastDistance& nearer = known.distance.upper < found.distance.upper ? known : found;
    nearer.distance.lower = std::min(std::max(known.distance.lower, found.distance.lower), nearer.distance.upper);
    nearer.work = found.work;
    return nearer;
}

/// Threads take one pair after another. Pairs that are not answered in the first round get a second one.
void MatrixSearch::ask_all(const std::vector<std::size_t>& order, Round round) {
    std::atomic<std::size_t> taken = 0;
    parallel_for(batch_.threads, order.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t pair = order[taken++];
            LeastDistance& nearest = pairs_[pair].nearest;
            if (round == Round::brief) {
                const Limit brief(seconds_of_brief_round);
                nearest = ask(pair);
            } else {
                nearest = round == Round::only ? ask(pair) : narrower(std::move(nearest), ask(pair));
            }
            if (round != Round::brief || nearest.certain)
                report_progress();
        }
    });
}

/// The nearest boxes first: a limit leaves pairs that are proven to be far apart. Where the time is limited, pairs that
/// take long wait for the others.
std::vector<PairDistance> MatrixSearch::run() {
    std::vector<std::size_t> order(pairs_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    chasles::sort(order, {}, [&](std::size_t i) { return std::pair(bounds_[i], i); });
    const Limit* const limit = LimitOfThread::get();
    if (!limit || !limit->has_end()) {
        ask_all(order, Round::only);
        return std::move(pairs_);
    }
    ask_all(order, Round::brief);
    std::erase_if(order, [&](std::size_t i) { return pairs_[i].nearest.certain; });
    ask_all(order, Round::last);
    return std::move(pairs_);
}

} // namespace

DistanceMatrix Scene::least_distances(const LeastDistanceOptions& options, const BatchOptions& batch) const {
    query::check_options(options);
    return {MatrixSearch(*this, options, batch).run(), numbers_of_untested({})};
}

} // namespace chasles
