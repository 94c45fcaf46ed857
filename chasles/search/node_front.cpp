#include "chasles/search/node_front.h"

#include "chasles/culling/split_nodes.h"

#include <algorithm>
#include <limits>

namespace chasles::search {

void NodeFront::restart() {
    nodes_.clear();
    limits_.clear();
    free_.clear();
    tested_.clear();
    nodes_.push_back({0, 0});
    limits_.push_back(-std::numeric_limits<double>::infinity());
}

void NodeFront::split(const Question& question, std::vector<TwoFaces>& faces, Work& work) {
    tested_.clear();
    // what a pair is split into has its limits from now, and is not taken again
    for (const auto& [place, limit] : limits_.take_up_to(question.bound)) {
        free_.push_back(place);
        stack_.push_back(nodes_[place]);
        while (!stack_.empty()) {
            if (size() + faces.size() > question.most)
                return stack_.clear();
            const PairOfNodes pair = stack_.back();
            stack_.pop_back();
            split(pair, question, faces, work);
        }
    }
}

/// A pair stays as it is if its children are apart.
void NodeFront::split(const PairOfNodes& pair, const Question& question, std::vector<TwoFaces>& faces, Work& work) {
    const auto moving = moving_.nodes(), fixed = fixed_.nodes();
    if (moving[pair.moving].is_bare() && fixed[pair.fixed].is_bare())
        return;
    const auto [a, b] = culling::split_nodes(moving, pair.moving, fixed, pair.fixed);
    const culling::SweptBoxes::Gaps gaps = question.boxes.widest_gaps(a.of(moving), b.of(fixed));
    work.node_pairs += std::uint64_t(a.count) * b.count;
    if (*std::ranges::min_element(gaps.on_way) > question.margin)
        return keep(pair, question.travelled + *std::ranges::min_element(gaps.start),
                    *std::ranges::min_element(gaps.end));
    if (moving[pair.moving].is_leaf() && fixed[pair.fixed].is_leaf()) {
        faces.push_back({moving[pair.moving].first, fixed[pair.fixed].first});
        return;
    }
    for (std::uint32_t i = 0; i < a.count; ++i)
        for (std::uint32_t j = 0; j < b.count; ++j) {
            const PairOfNodes child{a.first + i, b.first + j};
            const std::size_t lane = 2 * i + j;
            if (gaps.on_way[lane] > question.margin)
                keep(child, question.travelled + gaps.start[lane], gaps.end[lane]);
            else
                stack_.push_back(child);
        }
}

void NodeFront::keep(const PairOfNodes& pair, double limit, double gap_at_end) {
    std::size_t place = nodes_.size();
    if (free_.empty()) {
        nodes_.push_back(pair);
        limits_.push_back(limit);
    } else {
        place = free_.back();
        free_.pop_back();
        nodes_[place] = pair;
        limits_.set(place, limit);
    }
    tested_.push_back({place, gap_at_end});
}

/// The gaps at both ends may be along different directions, so they say nothing about places between them.
void NodeFront::arrive(const Arrival& arrival) {
    for (const auto& [place, gap_at_end] : tested_)
        limits_.raise(place, gap_at_end - arrival.from_end + arrival.travelled);
    tested_.clear();
}

} // namespace chasles::search
