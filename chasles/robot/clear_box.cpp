// Grows a box around a configuration while it is proven clear.
// Source: docs/derivations/40-ranges.md, "The clear box".
#include "chasles/base/invalid_input.h"
#include "chasles/base/limit_of_thread.h"
#include "chasles/base/number_text.h"
#include "chasles/robot/range.h"
#include "chasles/robot/range_rounds.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chasles {

namespace {

using robot::RangeRounds;
using robot::RangeSearch;

/// So many cells decide whether a box or a slab is clear; otherwise it is taken as not clear.
constexpr std::size_t cells_of_proof = 4096;

class Growing {
public:
    /// All are kept by reference.
    Growing(const robot::RangeWorld& world, const ConfigurationBox& within, const RangeOptions& options)
        : world_(world), within_(within), options_(options), axes_(RangeSearch(world, within).axes()) {}

    /// From a configuration that is clear. False at a limit.
    bool grow(const Configuration& around);

    [[nodiscard]] const ConfigurationBox& box() const { return box_; }
    [[nodiscard]] std::size_t cells() const { return cells_; }
    /// Of the given box.
    [[nodiscard]] double share() const {
        double product = 1;
        for (const std::size_t axis : axes_) {
            const auto i = Eigen::Index(axis);
            product *= (box_.upper[i] - box_.lower[i]) / (within_.upper[i] - within_.lower[i]);
        }
        return product;
    }

private:
    struct End {
        Eigen::Index variable;
        bool is_upper;
        double step; ///< by which the end may move, as a part of the given box
        bool is_done = false;
    };
    [[nodiscard]] bool goes_on() const {
        return cells_ < options_.most_cells && !is_cancelled() && (!options_.progress || options_.progress(share()));
    }
    bool is_clear(const ConfigurationBox& box);
    void grow_evenly(const Configuration& around);
    bool try_to_move(const End& end);

    const robot::RangeWorld& world_;
    const ConfigurationBox& within_;
    const RangeOptions& options_;
    std::vector<std::size_t> axes_;
    ConfigurationBox box_;
    std::size_t cells_ = 0;
};

/// Whether every cell of a box is proven clear. A witness ends the search.
bool Growing::is_clear(const ConfigurationBox& box) {
    const RangeSearch search(world_, box);
    RangeOptions options = options_;
    options.most_cells = std::min(cells_of_proof, options_.most_cells - cells_);
    options.progress = {};
    RangeRounds rounds(search, options);
    rounds.run([&] { return rounds.witness().has_value(); });
    cells_ += rounds.count();
    return rounds.is_clear();
}

/// The largest box of the shape of the given one, about the configuration, up to the tolerance.
void Growing::grow_evenly(const Configuration& around) {
    double proven = 0;
    for (double step = 1; step >= options_.tolerance && step >= 0x1p-20 && goes_on(); step *= 0.5) {
        const double scale = proven + step;
        if (scale > 1)
            continue;
        const ConfigurationBox larger{(around + scale * (within_.lower - around)).cwiseMax(within_.lower),
                                      (around + scale * (within_.upper - around)).cwiseMin(within_.upper)};
        if (is_clear(larger)) {
            box_ = larger;
            proven = scale;
        }
    }
}

/// The box becomes wider by a slab, if that is proven.
bool Growing::try_to_move(const End& end) {
    const auto i = end.variable;
    const double way = end.step * (within_.upper[i] - within_.lower[i]);
    ConfigurationBox slab = box_;
    double& moved = end.is_upper ? box_.upper[i] : box_.lower[i];
    const double old = moved;
    const double place = end.is_upper ? std::min(within_.upper[i], old + way) : std::max(within_.lower[i], old - way);
    if (place == old)
        return false;
    slab.lower[i] = std::min(old, place);
    slab.upper[i] = std::max(old, place);
    if (!is_clear(slab))
        return false;
    moved = place;
    return true;
}

bool Growing::grow(const Configuration& around) {
    box_ = {around, around};
    grow_evenly(around);
    std::vector<End> ends;
    for (const std::size_t axis : axes_)
        for (const bool is_upper : {false, true})
            ends.push_back({Eigen::Index(axis), is_upper, 0.5});
    const double least = std::max(options_.tolerance, 0x1p-20);
    for (bool has_step = true; has_step;) {
        has_step = false;
        for (End& end : ends) {
            if (end.is_done)
                continue;
            if (!goes_on())
                return false;
            if (!try_to_move(end)) {
                end.is_done = end.step <= least; // it cannot be moved by the tolerance
                end.step *= 0.5;
            }
            has_step = true;
        }
    }
    return true;
}

void require_inside(const RobotChecker::Prepared& prepared, const ConfigurationBox& box, const Configuration& around) {
    const auto& variables = prepared.model().variables;
    if (around.size() != box.lower.size())
        throw InvalidInput("range: around: has " + std::to_string(around.size()) + " values, and the robot has " +
                           std::to_string(variables.size()) + " variables");
    for (Eigen::Index i = 0; i < around.size(); ++i) {
        const double value = around[i], lower = box.lower[i], upper = box.upper[i];
        if (lower <= value && value <= upper)
            continue;
        throw InvalidInput("range: around: " + variables[std::size_t(i)].name + " is " + number_text(value) +
                           (lower == upper
                                ? ", and the box holds it at " + number_text(lower) +
                                      ": box_of_joints(joints, around) makes a box around it"
                                : ", outside of the box, from " + number_text(lower) + " to " + number_text(upper)));
    }
}

} // namespace

ClearBox RobotChecker::clear_box(const ConfigurationBox& within, const Configuration& around) const {
    return clear_box(within, around, {});
}

ClearBox RobotChecker::clear_box(const ConfigurationBox& within, const Configuration& around,
                                 const RangeOptions& options) const {
    robot::check_options(options);
    const Limit limit(options.seconds);
    const robot::RangeWorld world(*prepared_);
    const RangeSearch search(world, within);
    require_inside(*prepared_, within, around);
    ClearBox found;
    found.box = {around, around};
    found.untested = prepared_->untested;
    try {
        const robot::RestAnswer rest = search.at(around);
        found.verdict = rest.is_clear ? RangeVerdict::clear : rest.witness ? RangeVerdict::contact : RangeVerdict::open;
    } catch (const Cancelled&) { // nothing is proven
    }
    if (found.verdict != RangeVerdict::clear)
        return found;
    Growing growing(world, within, options);
    found.is_maximal = growing.grow(around);
    found.box = growing.box();
    found.share = growing.share();
    found.cells = growing.cells();
    return found;
}

} // namespace chasles
