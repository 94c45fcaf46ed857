// What VAMP uses of the library nigh, whose source no package registry has: nearest nodes, here by a linear search. Trees
// of VAMP's planner for these problems have some hundreds of nodes at most.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace unc::robotics::nigh {

namespace metric {
template <int p>
struct LP {};
template <class Type, class Metric>
struct Space;
} // namespace metric

struct NoThreadSafety {};
template <std::size_t batch>
struct KDTreeBatch {};

template <class Node, class Space, class Key, class Threads, class Strategy>
class Nigh {
public:
    void insert(const Node& node) { nodes_.push_back(node); }
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    [[nodiscard]] std::optional<std::pair<Node, float>> nearest(const typename Space::Type& place) const {
        std::optional<std::pair<Node, float>> found;
        for (const Node& node : nodes_)
            if (const float distance = Space::distance(Key{}(node), place); !found || distance < found->second)
                found.emplace(node, distance);
        return found;
    }

private:
    std::vector<Node> nodes_;
};

} // namespace unc::robotics::nigh
