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

void RangeRounds::add(RangeCell cell) {
    const double share = cell.share();
    waiting_.push_back({share, made_++, std::move(cell)});
    std::push_heap(waiting_.begin(), waiting_.end());
}

std::vector<RangeCell> RangeRounds::open() const {
    std::vector<RangeCell> cells = indivisible_;
    for (const Waiting& waiting : waiting_)
        cells.push_back(waiting.cell);
    return cells;
}

bool RangeRounds::run(const std::function<bool()>& is_enough) {
    while (!waiting_.empty() && !is_enough() && cells_ < options_.most_cells) {
        if (!run_round())
            return false;
        if (options_.progress && !options_.progress(1 - open_share_))
            return false;
    }
    return true;
}

/// The largest cells. What the limit of the thread leaves unexamined waits again.
bool RangeRounds::run_round() {
    std::vector<RangeCell> cells;
    while (cells.size() < std::min(cells_of_round, options_.most_cells - cells_) && !waiting_.empty()) {
        std::pop_heap(waiting_.begin(), waiting_.end());
        cells.push_back(std::move(waiting_.back().cell));
        waiting_.pop_back();
    }
    const bool seeks_witness = !witness_ || !witness_->overlaps;
    std::vector<std::optional<RangeSearch::Outcome>> outcomes(cells.size());
    parallel_for(options_.threads, cells.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            try {
                outcomes[i] = search_.examine(cells[i], seeks_witness);
            } catch (const Cancelled&) { // the cell stays as it is
            }
    });
    bool is_whole = true;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (outcomes[i]) {
            ++cells_;
            take(std::move(cells[i]), std::move(*outcomes[i]));
        } else {
            is_whole = false;
            add(std::move(cells[i]));
        }
    return is_whole && !is_cancelled();
}

void RangeRounds::take(RangeCell cell, RangeSearch::Outcome outcome) {
    if (outcome.witness && (!witness_ || (!witness_->overlaps && outcome.witness->overlaps)))
        witness_ = std::move(outcome.witness);
    if (outcome.is_clear || outcome.is_in_contact) {
        cell.pairs.reset();
        open_share_ -= cell.share();
        (outcome.is_clear ? clear_ : contact_).push_back(std::move(cell));
        return;
    }
    if (outcome.open.size() == 1)
        indivisible_.push_back(std::move(outcome.open.front()));
    else
        for (RangeCell& half : outcome.open)
            add(std::move(half));
}

} // namespace chasles::robot
