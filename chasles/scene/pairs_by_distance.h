// The pairs of two lists of bodies, the nearest boxes first: best-first search over pairs of nodes of two trees of
// boxes. Source: docs/derivations/27-scenes.md, "Nearest".
#pragma once

#include "chasles/scene/pair_question.h"
#include "chasles/scene/scene.h"
#include "chasles/scene/swept_body.h"

#include <compare>
#include <optional>
#include <queue>
#include <tuple>
#include <vector>

namespace chasles::scene {

/// A tree of the boxes that bodies sweep. The boxes lie along a curve that fills space; four that follow each other are
/// a node. Boxes are in double precision, because their distances are proven bounds.
class SweptTree {
public:
    struct Node {
        std::size_t level = 0; ///< 0: the boxes of bodies
        std::size_t index = 0;

        friend auto operator<=>(const Node&, const Node&) = default;
    };

    /// Throws InvalidInput for an unknown index.
    SweptTree(const Scene& scene, const std::vector<std::size_t>& bodies);

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
    static constexpr std::size_t arity = 4; ///< children of a node

    void add_level();

    std::vector<std::size_t> bodies_; ///< along the curve
    std::vector<std::vector<Box>> levels_;
};

/// Which pairs: one body of each list makes a pair, and the first one moves. Indices are those of Scene::bodies().
struct PairLists {
    std::vector<std::size_t> first;
    /// Without it, all pairs of bodies of the first list, in the roles of a scene.
    std::optional<std::vector<std::size_t>> second = {};
    bool rests = true; ///< two bodies that never move are a pair, too
};

/// All pairs that a question about a scene tests.
PairLists all_pairs(const Scene& scene);

class PairsByDistance {
public:
    /// The scene is kept by reference. Throws InvalidInput for an unknown index.
    PairsByDistance(const Scene& scene, const PairLists& lists);

    struct Pair {
        std::size_t moving = 0;
        std::size_t fixed = 0;
        double bound = 0; ///< the bodies are never nearer, nor are those of pairs that are still to come
    };
    /// The next pair whose boxes come nearer than a distance, which never grows. Ignored pairs are left out.
    std::optional<Pair> next(double distance);

private:
    /// Two nodes and a proven lower bound of the distance of their bodies.
    struct NodePair {
        double bound = 0;
        SweptTree::Node first, second;

        /// The queue takes the nearest pair first. Equal bounds are taken in the order of nodes, nearer to bodies
        /// first.
        friend bool operator<(const NodePair& a, const NodePair& b) {
            return std::tie(a.bound, a.first, a.second) > std::tie(b.bound, b.first, b.second);
        }
    };

    [[nodiscard]] const SweptTree& second() const { return is_within_ ? first_ : second_; }
    void push(const SweptTree::Node& first, const SweptTree::Node& second, double distance);
    void split(const NodePair& nodes, double distance);
    [[nodiscard]] std::optional<Pair> pair_of(const NodePair& leaves) const;

    const Scene& scene_;
    bool is_within_; ///< all pairs of one list
    bool rests_;
    SweptTree first_, second_;
    std::priority_queue<NodePair> queue_;
};

} // namespace chasles::scene
