#include "chasles/robot/range_rounds.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/base/parallel_for.h"
#include "chasles/query/requirements.h"

#include <algorithm>
#include <utility>

namespace chasles::robot {

namespace {

/// Cells of a round. Which cells are examined together does not depend on the number of threads.
constexpr std::size_t cells_of_round = 64;

} // namespace

void check_options(const RangeOptions& options) {
    query::require(options.tolerance >= 0 && options.tolerance <= 1, "tolerance", "must be in [0, 1]");
    query::require(options.seconds > 0, "seconds", "must be positive");
    query::require(options.most_cells > 0, "most_cells", "must be positive");
}

RangeRounds::RangeRounds(const RangeSearch& search, const RangeOptions& options) : search_(search), options_(options) {
    add(search.whole());
}

void RangeRounds::wait(std::size_t node, RangeCell cell) {
    const double share = cell.share();
    waiting_.push_back({share, node, std::move(cell)});
    std::push_heap(waiting_.begin(), waiting_.end());
}

void RangeRounds::add(RangeCell cell) {
    nodes_.push_back({cell.sides});
    wait(nodes_.size() - 1, std::move(cell));
}

bool RangeRounds::is_clear() const {
    return joined_kinds().front() == Kind::clear;
}

/// Of each node: its own, or that of both halves if they have the same.
std::vector<RangeRounds::Kind> RangeRounds::joined_kinds() const {
    std::vector<Kind> kinds(nodes_.size());
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        const Node& node = nodes_[i];
        kinds[i] = node.kind;
        if (node.kind == Kind::divided && kinds[node.first_half] == kinds[node.first_half + 1])
            kinds[i] = kinds[node.first_half];
    }
    return kinds;
}

std::vector<RangeCell> RangeRounds::cells(Kind kind) const {
    const std::vector<Kind> kinds = joined_kinds();
    std::vector<RangeCell> found;
    std::vector<std::size_t> visited{0};
    while (!visited.empty()) {
        const std::size_t i = visited.back();
        visited.pop_back();
        if (kinds[i] == kind)
            found.push_back({nodes_[i].sides, nullptr});
        else if (kinds[i] == Kind::divided)
            visited.insert(visited.end(), {nodes_[i].first_half + 1, nodes_[i].first_half});
    }
    return found;
}

void RangeRounds::run(const std::function<bool()>& is_enough) {
    while (!waiting_.empty() && !is_enough() && count_ < options_.most_cells)
        if (!run_round() || (options_.progress && !options_.progress(1 - open_share_)))
            return;
}

/// The largest cells. What the limit of the thread leaves unexamined waits again.
bool RangeRounds::run_round() {
    std::vector<Waiting> cells;
    while (cells.size() < std::min(cells_of_round, options_.most_cells - count_) && !waiting_.empty()) {
        std::pop_heap(waiting_.begin(), waiting_.end());
        cells.push_back(std::move(waiting_.back()));
        waiting_.pop_back();
    }
    const bool seeks_witness = !witness_ || !witness_->overlaps;
    std::vector<std::optional<RangeSearch::Outcome>> outcomes(cells.size());
    parallel_for(options_.threads, cells.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            try {
                outcomes[i] = search_.examine(cells[i].cell, seeks_witness);
            } catch (const Cancelled&) { // the cell stays as it is
            }
    });
    bool is_whole = true;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (outcomes[i]) {
            ++count_;
            take(cells[i].node, std::move(*outcomes[i]));
        } else {
            is_whole = false;
            wait(cells[i].node, std::move(cells[i].cell));
        }
    return is_whole && !is_cancelled();
}

/// A cell that cannot be divided stays open.
void RangeRounds::take(std::size_t node, RangeSearch::Outcome outcome) {
    if (outcome.witness && (!witness_ || (!witness_->overlaps && outcome.witness->overlaps)))
        witness_ = std::move(outcome.witness);
    if (outcome.is_clear || outcome.is_in_contact) {
        nodes_[node].kind = outcome.is_clear ? Kind::clear : Kind::contact;
        open_share_ -= RangeCell{nodes_[node].sides, nullptr}.share();
    } else if (!outcome.halves.empty()) {
        nodes_[node].kind = Kind::divided;
        nodes_[node].first_half = nodes_.size();
        for (RangeCell& half : outcome.halves)
            add(std::move(half));
    }
}

} // namespace chasles::robot
