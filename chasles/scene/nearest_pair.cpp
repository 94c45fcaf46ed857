#include "chasles/scene/nearest_pair.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/query/nearest_of.h"
#include "chasles/query/requirements.h"
#include "chasles/scene/curve_order.h"
#include "chasles/scene/pair_question.h"
#include "chasles/scene/pair_tasks.h"
#include "chasles/scene/swept_body.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

namespace chasles::scene {

namespace {

/// Children of a node.
constexpr std::size_t arity = 4;

struct Node {
    std::size_t level = 0; ///< 0: the boxes of bodies
    std::size_t index = 0;

    friend auto operator<=>(const Node&, const Node&) = default;
};

/// A tree of the boxes that bodies sweep. The boxes lie along a curve that fills space; four that follow each other are
/// a node. Boxes are in double precision, because their distances are proven bounds.
class SweptTree {
public:
    SweptTree(const Scene& scene, const std::vector<std::size_t>& bodies) {
        std::vector<Box> boxes;
        std::vector<Eigen::Vector3d> middles;
        for (const std::size_t body : bodies) {
            require_body(scene, body);
            const WorldMotion& motion = scene.motion_of(body);
            boxes.push_back(swept({scene.bodies()[body].shape.body(), *motion.frame, motion.rests}, 1).box);
            middles.emplace_back(0.5 * boxes.back().min() + 0.5 * boxes.back().max());
        }
        levels_.emplace_back();
        for (const std::uint32_t i : curve_order(middles, 1)) {
            bodies_.push_back(bodies[i]);
            levels_[0].push_back(boxes[i]);
        }
        while (levels_.back().size() > 1)
            add_level();
    }

    [[nodiscard]] bool is_empty() const { return bodies_.empty(); }
    [[nodiscard]] Node root() const { return {levels_.size() - 1, 0}; }
    [[nodiscard]] const Box& box(const Node& node) const { return levels_[node.level][node.index]; }
    [[nodiscard]] std::size_t body(const Node& leaf) const { return bodies_[leaf.index]; }

    template <class Visit>
    void for_each_child(const Node& node, const Visit& visit) const {
        const std::size_t end = std::min((node.index + 1) * arity, levels_[node.level - 1].size());
        for (std::size_t child = node.index * arity; child < end; ++child)
            visit(Node{node.level - 1, child});
    }

private:
    void add_level() {
        const std::vector<Box>& below = levels_.back();
        std::vector<Box> level((below.size() + arity - 1) / arity);
        for (std::size_t i = 0; i < below.size(); ++i)
            level[i / arity].extend(below[i]);
        levels_.push_back(std::move(level));
    }

    std::vector<std::size_t> bodies_; ///< along the curve
    std::vector<std::vector<Box>> levels_;
};

/// Two nodes and a proven lower bound of the distance of their bodies.
struct NodePair {
    double bound = 0;
    Node first, second;

    /// The queue takes the nearest pair first. Equal bounds are taken in the order of nodes, nearer to bodies first.
    friend bool operator<(const NodePair& a, const NodePair& b) {
        return std::tie(a.bound, a.first, a.second) > std::tie(b.bound, b.first, b.second);
    }
};

class NearestPairSearch {
public:
    NearestPairSearch(const Scene& scene, const NearestPairQuery& query)
        : scene_(scene), query_(query), is_within_(!query.second), first_(scene, query.first),
          second_(scene, query.second.value_or(std::vector<std::size_t>())), nearest_(query.options) {}

    SceneDistance run();

private:
    [[nodiscard]] const SweptTree& second() const { return is_within_ ? first_ : second_; }
    void search();
    void push(const Node& first, const Node& second);
    void split(const NodePair& nodes);
    void compare(const NodePair& leaves);

    const Scene& scene_;
    const NearestPairQuery& query_;
    bool is_within_; ///< all pairs of one list
    SweptTree first_, second_;
    std::priority_queue<NodePair> queue_;
    query::NearestOf nearest_;
    SceneDistance found_;
};

/// The boxes hold their bodies, so their distance is a lower bound. Its own rounding is below 4 units in the last
/// place.
void NearestPairSearch::push(const Node& first, const Node& second) {
    constexpr double rounding = 1e-14;
    const double bound = first_.box(first).exteriorDistance(this->second().box(second)) * (1 - rounding);
    if (bound < nearest_.upper())
        queue_.push({bound, first, second});
}

/// Splits the higher node, or both. A node with itself gives each pair of children once.
void NearestPairSearch::split(const NodePair& nodes) {
    const auto& [bound, first, second] = nodes;
    if (is_within_ && first == second)
        first_.for_each_child(first, [&](const Node& a) {
            first_.for_each_child(first, [&](const Node& b) {
                if (a.index < b.index || (a.index == b.index && a.level > 0))
                    push(a, b);
            });
        });
    else if (first.level > second.level)
        first_.for_each_child(first, [&](const Node& a) { push(a, nodes.second); });
    else if (first.level < second.level)
        this->second().for_each_child(second, [&](const Node& b) { push(nodes.first, b); });
    else
        first_.for_each_child(first, [&](const Node& a) {
            this->second().for_each_child(nodes.second, [&](const Node& b) { push(a, b); });
        });
}

void NearestPairSearch::compare(const NodePair& leaves) {
    const std::size_t first = first_.body(leaves.first), other = second().body(leaves.second);
    const bool never_move = scene_.rests(first) && scene_.rests(other);
    if (first == other || scene_.is_ignored(first, other) || (never_move && !query_.rests))
        return;
    const IndexPair pair{std::uint32_t(first), std::uint32_t(other)};
    const auto [moving, fixed] = is_within_ ? in_their_roles(scene_, pair) : pair;
    ++found_.pairs;
    const Mover a = mover(scene_, moving), b = mover(scene_, fixed);
    auto distance = along(a, b, [&](const motion::AnyTrajectory& trajectory) {
        return nearest_.ask(a.shape.body(), b.shape.body(), trajectory);
    });
    if (distance && nearest_.take(std::move(*distance)))
        found_.pair = {moving, fixed};
}

SceneDistance NearestPairSearch::run() {
    if (!first_.is_empty() && !second().is_empty())
        push(first_.root(), second().root());
    try {
        search();
    } catch (const Cancelled&) { // pairs that are left are in the queue
        nearest_.leave(queue_.top().bound);
    }
    found_.nearest = nearest_.result();
    return std::move(found_);
}

/// A pair leaves the queue when it is done.
void NearestPairSearch::search() {
    while (!queue_.empty()) {
        const NodePair nodes = queue_.top();
        if (nodes.bound >= nearest_.upper())
            break;
        if (nodes.bound > Pose::largest_length)
            throw InvalidInput("distance: all objects are farther apart than 1e+30");
        if (nodes.first.level == 0 && nodes.second.level == 0)
            compare(nodes);
        queue_.pop();
        if (nodes.first.level > 0 || nodes.second.level > 0)
            split(nodes);
    }
}

} // namespace

SceneDistance nearest_pair(const Scene& scene, const NearestPairQuery& query) {
    query::check_options(query.options);
    return NearestPairSearch(scene, query).run();
}

} // namespace chasles::scene

namespace chasles {

SceneDistance Scene::least_distance(const LeastDistanceOptions& options) const {
    std::vector<std::size_t> all(bodies_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    SceneDistance found = scene::nearest_pair(*this, {.first = std::move(all), .options = options, .rests = false});
    found.untested = numbers_of_untested({});
    return found;
}

} // namespace chasles
