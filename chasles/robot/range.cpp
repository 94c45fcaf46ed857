// Divides a box of configurations into cells, the largest ones first, until few of it is open.
// Source: docs/derivations/40-ranges.md.
#include "chasles/robot/range.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/base/limit_of_thread.h"
#include "chasles/robot/range_rounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace chasles {

using robot::RangeCell;
using robot::RangeRounds;
using robot::RangeSearch;

namespace {

/// Whether each joint that follows a variable is where it was after a whole turn.
bool repeats_after_a_turn(const robot::Model& model, std::size_t variable) {
    return std::ranges::all_of(model.groups,
                               [&](const robot::RigidGroup& group) { return group.repeats_after_a_turn(variable); });
}

/// One variable within its limits.
std::pair<double, double> limits_of(const Robot& robot, std::size_t variable) {
    const auto& [name, lower, upper, is_continuous] = robot.variables()[variable];
    if (std::isfinite(lower) && std::isfinite(upper))
        return {lower, upper};
    if (!std::isinf(lower) || !std::isinf(upper) || !repeats_after_a_turn(robot.model(), variable))
        throw InvalidInput("range: " + name + ": has no limits; give the ends of its range");
    const double half_turn = std::nextafter(std::numbers::pi, 4.0); // so that the ends overlap
    return {-half_turn, half_turn};
}

} // namespace

ConfigurationBox box_of_joints(const Robot& robot, std::span<const std::string> joints,
                               const Configuration& configuration) {
    if (configuration.size() != Eigen::Index(robot.variables().size()))
        throw InvalidInput("range: configuration: has " + std::to_string(configuration.size()) +
                           " values, and the robot has " + std::to_string(robot.variables().size()) + " variables");
    ConfigurationBox box{configuration, configuration};
    std::vector<bool> is_taken(robot.variables().size());
    for (const std::string& joint : joints) {
        const std::size_t variable = robot.variable(joint);
        if (is_taken[variable])
            throw InvalidInput("range: " + joint + ": comes twice");
        is_taken[variable] = true;
        std::tie(box.lower[Eigen::Index(variable)], box.upper[Eigen::Index(variable)]) = limits_of(robot, variable);
    }
    return box;
}

namespace {

/// Joins boxes that have a side in common, axis by axis, until no two have, or once where a limit of time has ended the
/// search. The largest ones come first.
class JoinedCells {
public:
    explicit JoinedCells(std::vector<RangeCell> cells) : cells_(std::move(cells)) {
        const std::size_t axes = cells_.empty() ? 0 : cells_.front().sides.size();
        std::size_t size = 0;
        do {
            size = cells_.size();
            for (std::size_t axis = axes; axis-- > 0;)
                join_along(axis);
        } while (cells_.size() < size && !is_cancelled());
        std::ranges::sort(cells_, [](const RangeCell& a, const RangeCell& b) {
            const double first = a.share(), second = b.share();
            return first != second ? first > second : is_before(a, b, a.sides.size());
        });
    }

    [[nodiscard]] double share() const {
        return std::accumulate(cells_.begin(), cells_.end(), 0.0,
                               [](double sum, const RangeCell& cell) { return sum + cell.share(); });
    }
    [[nodiscard]] std::vector<ConfigurationBox> boxes(const RangeSearch& search) const {
        std::vector<ConfigurationBox> boxes;
        for (const RangeCell& cell : cells_)
            boxes.push_back(search.box_of(cell));
        return boxes;
    }

private:
    using Side = RangeCell::Side;

    /// By all sides but `last`, which comes last.
    static bool is_before(const RangeCell& a, const RangeCell& b, std::size_t last) {
        for (std::size_t i = 0; i < a.sides.size(); ++i)
            if (i != last && !is_same(a.sides[i], b.sides[i]))
                return std::pair(a.sides[i].lower, a.sides[i].upper) < std::pair(b.sides[i].lower, b.sides[i].upper);
        return last < a.sides.size() && a.sides[last].lower < b.sides[last].lower;
    }
    static bool is_same(const Side& a, const Side& b) { return a.lower == b.lower && a.upper == b.upper; }
    static bool continues(const RangeCell& a, const RangeCell& b, std::size_t axis) {
        for (std::size_t i = 0; i < a.sides.size(); ++i)
            if (i != axis && !is_same(a.sides[i], b.sides[i]))
                return false;
        return a.sides[axis].upper == b.sides[axis].lower;
    }
    void join_along(std::size_t axis) {
        std::ranges::sort(cells_, [&](const RangeCell& a, const RangeCell& b) { return is_before(a, b, axis); });
        std::vector<RangeCell> joined;
        for (RangeCell& cell : cells_)
            if (!joined.empty() && continues(joined.back(), cell, axis))
                joined.back().sides[axis].upper = cell.sides[axis].upper;
            else
                joined.push_back(std::move(cell));
        cells_ = std::move(joined);
    }

    std::vector<RangeCell> cells_;
};

RangeVerdict verdict_of(const RangeRounds& rounds) {
    if (rounds.witness())
        return RangeVerdict::contact;
    return rounds.is_clear() ? RangeVerdict::clear : RangeVerdict::open;
}

} // namespace

RobotRange RobotChecker::range(const ConfigurationBox& box) const {
    return range(box, {});
}

RobotRange RobotChecker::range(const ConfigurationBox& box, const RangeOptions& options) const {
    robot::check_options(options);
    const Limit limit(options.seconds);
    const robot::RangeWorld world(*prepared_);
    const RangeSearch search(world, box);
    RangeRounds rounds(search, options);
    rounds.run([&] { return rounds.open_share() <= options.tolerance && rounds.witness(); });
    using Kind = RangeRounds::Kind;
    const JoinedCells clear(rounds.cells(Kind::clear)), contact(rounds.cells(Kind::contact)),
        open(rounds.cells(Kind::open));
    RobotRange found;
    found.verdict = verdict_of(rounds);
    found.joints = search.axes();
    found.clear = clear.boxes(search);
    found.contact = contact.boxes(search);
    found.open = open.boxes(search);
    found.clear_share = clear.share();
    found.contact_share = contact.share();
    found.open_share = open.share();
    found.cells = rounds.count();
    found.untested = prepared_->untested;
    if (rounds.witness()) {
        found.witness = rounds.witness()->configuration;
        found.pair = rounds.witness()->pair;
    }
    return found;
}

} // namespace chasles
