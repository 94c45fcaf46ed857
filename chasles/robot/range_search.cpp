#include "chasles/robot/range_search.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/motion/screw_path.h"
#include "chasles/query/pair_query.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace chasles::robot {

namespace {

using Prepared = RobotChecker::Prepared;

} // namespace

/// What holds at the middle of a cell.
struct RangeSearch::Middle {
    Configuration at;
    RestPlaces places;
    Pairs pairs;                   ///< that are not proven apart
    std::vector<PairInCell> cells; ///< of each pair
};

RangeSearch::RangeSearch(const RangeWorld& world, const ConfigurationBox& box)
    : world_(world), prepared_(world.prepared), box_(box), axes_(checked_axes(prepared_.model(), box)) {
    std::vector<std::size_t> axis_of(prepared_.model().variables.size(), RangePair::none);
    for (std::size_t a = 0; a < axes_.size(); ++a)
        axis_of[axes_[a]] = a;
    pairs_ = pairs_of_box(prepared_, axis_of);
}

RangeCell RangeSearch::whole() const {
    Pairs all(pairs_.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].index = std::uint32_t(i);
    return {std::vector<RangeCell::Side>(axes_.size()), std::make_shared<const Pairs>(std::move(all))};
}

/// Ascends with the place, and is exact at both ends of the box.
double RangeSearch::value(std::size_t axis, std::uint64_t place) const {
    const auto variable = Eigen::Index(axes_[axis]);
    const double lower = box_.lower[variable], upper = box_.upper[variable];
    return place == grid_size ? upper : std::min(upper, lower + (upper - lower) * (double(place) / double(grid_size)));
}

ConfigurationBox RangeSearch::box_of(const RangeCell& cell) const {
    ConfigurationBox box = box_;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
        box.lower[Eigen::Index(axes_[a])] = value(a, cell.sides[a].lower);
        box.upper[Eigen::Index(axes_[a])] = value(a, cell.sides[a].upper);
    }
    return box;
}

/// The half widths count from the rounded middle. Pairs that balls or faces prove apart are left out.
RangeSearch::Middle RangeSearch::middle_of(const RangeCell& cell) const {
    const ConfigurationBox box = box_of(cell);
    const Configuration at = box.lower + 0.5 * (box.upper - box.lower);
    std::vector<double> half;
    for (const std::size_t variable : axes_) {
        const auto i = Eigen::Index(variable);
        const double lower = box.lower[i], upper = box.upper[i];
        half.push_back(std::max(at[i] - lower, upper - at[i]) * outward_sum +
                       0x1p-50 * std::max(std::abs(lower), std::abs(upper)));
    }
    Middle middle{at, RestPlaces(prepared_, prepared_.model().motion_of({0, 1, at.transpose()})), {}, {}};
    for (const RangeCell::NearPair& near : *cell.pairs) {
        const RangePair& pair = pairs_[near.index];
        PairInCell in_cell = pair.in_cell(middle.places, half);
        if (pair.is_far_apart(middle.places, in_cell))
            continue;
        const auto faces = near_faces(at_middle(pair, in_cell, middle), near.faces);
        const bool is_nearer_than_rounding = faces && in_cell.way() == 0 && at_rest(at, {near}).is_clear;
        if (faces && !is_nearer_than_rounding) {
            middle.pairs.push_back({near.index, faces});
            middle.cells.push_back(std::move(in_cell));
        }
    }
    return middle;
}

PairAtRest RangeSearch::at_middle(const RangePair& pair, const PairInCell& cell, const Middle& middle) const {
    return {moving_surface(pair), fixed_surface(pair), pair.relative(middle.places),
            cell.motion,          pair.margin(),       middle.places.size()};
}

const OverlapSurface& RangeSearch::moving_surface(const RangePair& pair) const {
    return world_.of_elements[prepared_.moving_index(pair.task())];
}

const OverlapSurface& RangeSearch::fixed_surface(const RangePair& pair) const {
    const Task& task = pair.task();
    return task.kind == Task::Kind::self ? world_.of_elements[prepared_.self_pairs[task.first].fixed]
                                         : world_.of_obstacles[task.second];
}

/// Bodies that overlap come first.
RestAnswer RangeSearch::at_rest(const Configuration& at, const Pairs& pairs) const {
    const Model& model = prepared_.model();
    const JointPath path = JointPath::of_parts({{0, 1, at.transpose()}}, model.quaternions, model.variables_of_paths);
    const SegmentPairs rest(prepared_, path, 0);
    RestAnswer answer;
    for (const RangeCell::NearPair& near : pairs) {
        Task task = pairs_[near.index].task();
        task.part = {0, 1};
        QueryOptions options;
        options.margin = pairs_[near.index].margin();
        const Body &moving = prepared_.moving(task).shape.body(), &fixed = prepared_.fixed_shape(task).body();
        const auto trajectory = rest.trajectory(task);
        const FirstContact found = rest.naming(task, [&] {
            return query::answer({moving, fixed, trajectory, options});
        });
        answer.is_clear = answer.is_clear && found.verdict == Verdict::clear;
        if (found.verdict != Verdict::contact_at_start || !found.certain)
            continue;
        const bool is_within = options.margin + moving.radius() + fixed.radius() > 0;
        const bool overlaps = found.overlap || found.inside || is_within;
        if (!answer.witness || overlaps)
            answer.witness = RangeWitness{at, name_of(prepared_, task), overlaps};
        if (overlaps)
            break;
    }
    return answer;
}

RestAnswer RangeSearch::at(const Configuration& configuration) const {
    return at_rest(configuration, *whole().pairs);
}

/// Whether one pair touches in each configuration of the cell.
bool RangeSearch::is_in_contact(const Middle& middle, std::optional<RangeWitness>& found) const {
    for (std::size_t i = 0; i < middle.pairs.size(); ++i) {
        const RangePair& pair = pairs_[middle.pairs[i].index];
        if (stay_in_touch(at_middle(pair, middle.cells[i], middle))) {
            found = RangeWitness{middle.at, name_of(prepared_, pair.task()), true};
            return true;
        }
        if (middle.cells[i].way() == 0) // nothing moves, so one configuration stands for all
            if (const RestAnswer rest = at_rest(middle.at, {middle.pairs[i]}); rest.witness) {
                found = rest.witness;
                return true;
            }
    }
    return false;
}

/// Halves of the side that moves points of some pair farthest; none if all sides are as narrow as the grid.
std::vector<RangeCell> RangeSearch::halves(const RangeCell& cell, const Middle& middle) const {
    std::size_t widest = axes_.size();
    double most = -1;
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
        double way = 0;
        for (const PairInCell& pair : middle.cells)
            way = std::max(way, pair.ways[axis]);
        if (way > most && cell.sides[axis].width() > 1) {
            widest = axis;
            most = way;
        }
    }
    if (widest == axes_.size())
        return {};
    const auto pairs = std::make_shared<const Pairs>(middle.pairs);
    std::vector<RangeCell> both{{cell.sides, pairs}, {cell.sides, pairs}};
    RangeCell::Side &first = both[0].sides[widest], &second = both[1].sides[widest];
    first.upper = second.lower = first.lower + first.width() / 2;
    return both;
}

RangeSearch::Outcome RangeSearch::examine(const RangeCell& cell, bool seeks_witness) const {
    throw_if_cancelled();
    const Middle middle = middle_of(cell);
    if (middle.pairs.empty())
        return {.is_clear = true};
    Outcome outcome;
    outcome.is_in_contact = is_in_contact(middle, outcome.witness);
    if (outcome.is_in_contact)
        return outcome;
    if (seeks_witness)
        outcome.witness = at_rest(middle.at, middle.pairs).witness;
    outcome.halves = halves(cell, middle);
    return outcome;
}

} // namespace chasles::robot
