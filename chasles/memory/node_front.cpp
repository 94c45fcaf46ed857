#include "chasles/memory/node_front.h"

#include "chasles/culling/split_nodes.h"

#include <limits>

namespace chasles::memory {

namespace {

using algebra::Vector3;

constexpr std::size_t pairs_of_children = Separations::block_size;
/// A direction of single precision is off by less than this (note 31, "Rounding").
constexpr double error_of_directions = 0x1p-19;

} // namespace

void NodeFront::restart() {
    parents_.clear();
    apart_.clear();
    free_.clear();
    new_.clear();
    add({0, 0});
}

/// Returns the place.
std::size_t NodeFront::add(const PairOfNodes& parent) {
    std::size_t place = parents_.size();
    if (free_.empty()) {
        parents_.push_back(parent);
        apart_.append_block();
    } else {
        place = free_.back();
        free_.pop_back();
        parents_[place] = parent;
    }
    const auto [a, b] = culling::split_nodes(moving_.nodes(), parent.moving, fixed_.nodes(), parent.fixed);
    for (std::uint32_t i = 0; i < a.count; ++i)
        for (std::uint32_t j = 0; j < b.count; ++j)
            apart_.put(place * pairs_of_children + 2 * i + j, moving_.nodes()[a.first + i]);
    return place;
}

void NodeFront::split(const Question& question, std::vector<PairOfNodes>& leaves, Work& work) {
    std::size_t next = 0; // the first place that is not tested yet
    for (const std::size_t index : apart_.due(question.way, question.bound)) {
        const std::size_t place = index / pairs_of_children;
        if (place < next)
            continue;
        next = place + 1;
        test(place, question, leaves, work);
        while (!new_.empty()) {
            if (size() + leaves.size() > question.most)
                return;
            const std::size_t child = new_.back();
            new_.pop_back();
            test(child, question, leaves, work);
        }
    }
}

/// Tests the pairs of children that are in the front.
void NodeFront::test(std::size_t place, const Question& question, std::vector<PairOfNodes>& leaves, Work& work) {
    const auto moving = moving_.nodes(), fixed = fixed_.nodes();
    const PairOfNodes parent = parents_[place];
    const auto [a, b] = culling::split_nodes(moving, parent.moving, fixed, parent.fixed);
    const culling::SweptBoxes::Gaps gaps = question.boxes.widest_gaps(a.of(moving), b.of(fixed));
    work.node_pairs += std::uint64_t(a.count) * b.count;
    const double error = error_of_directions * farthest(parent, question.way.ends.start);
    bool is_empty = true;
    for (std::uint32_t lane = 0; lane < pairs_of_children; ++lane) {
        const std::size_t index = place * pairs_of_children + lane;
        const PairOfNodes pair{a.first + lane / 2, b.first + lane % 2};
        if (!apart_.holds(index))
            continue;
        if (double(gaps.on_way[lane]) > question.way.margin) {
            apart_.put_apart(index, {gaps.along[0][lane], gaps.along[1][lane], gaps.along[2][lane]},
                             double(gaps.start[lane]) - error);
            is_empty = false;
            continue;
        }
        apart_.remove(index);
        if (moving[pair.moving].is_bare() && fixed[pair.fixed].is_bare())
            continue;
        if (moving[pair.moving].is_leaf() && fixed[pair.fixed].is_leaf())
            leaves.push_back(pair);
        else
            new_.push_back(add(pair));
    }
    if (is_empty)
        free_.push_back(place);
}

/// No point of the moving node is farther from a point of the fixed node.
double NodeFront::farthest(const PairOfNodes& pair, const culling::MatrixPose& pose) const {
    const BoxMiddle moving = middle_of(moving_.nodes()[pair.moving]), fixed = middle_of(fixed_.nodes()[pair.fixed]);
    const Vector3<double> centre = pose(motion::vector_in<double>(moving_.centre() + moving.centre.cast<double>()));
    const Vector3<double> apart = centre - motion::vector_in<double>(fixed_.centre() + fixed.centre.cast<double>());
    return length(apart) + double(moving.half.norm()) + double(fixed.half.norm());
}

} // namespace chasles::memory
