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

/// Of times in [0, 1]: more than the roundings of a time that is counted from the other end.
constexpr double rounding_of_times = 0x1p-48;

// These numbers decide only how cells are divided.

/// Brackets of contacts along a sweep need not be narrower.
constexpr double time_tolerance = 1.0 / 512;
/// Cut ends lie on a grid of this part of the cell, and less than `least_cut` of it is not cut off.
constexpr std::uint64_t cuts_in_cell = 32;
constexpr std::uint64_t least_cut = 8;

bool is_same(const Task& a, const Task& b) {
    return a.kind == b.kind && a.first == b.first && a.second == b.second;
}

} // namespace

/// What holds at the middle of a cell.
struct RangeSearch::Middle {
    Configuration at;
    RestPlaces places;
    /// Of each pair in question, for each axis: what it moves the points of the pair.
    std::vector<std::vector<double>> ways;

    [[nodiscard]] double way(std::size_t pair) const {
        return std::accumulate(ways[pair].begin(), ways[pair].end(), 0.0) * outward_sum;
    }
    /// Of all axes but one.
    [[nodiscard]] double way_without(std::size_t pair, std::size_t axis) const {
        double sum = 0;
        for (std::size_t a = 0; a < ways[pair].size(); ++a)
            sum += a == axis ? 0 : ways[pair][a];
        return sum * outward_sum;
    }
    /// The axis that moves points of some pair farthest, of those that may be taken.
    template <class MayTake>
    [[nodiscard]] std::optional<std::size_t> widest_axis(std::size_t axes, const MayTake& may_take) const {
        std::optional<std::size_t> widest;
        double most = -1;
        for (std::size_t a = 0; a < axes; ++a) {
            double way = 0;
            for (const std::vector<double>& of_pair : ways)
                way = std::max(way, of_pair[a]);
            if (way > most && may_take(a)) {
                widest = a;
                most = way;
            }
        }
        return widest;
    }
};

/// A line through a cell.
struct RangeSearch::Sweep {
    Pairs near;       ///< pairs that are not proven apart
    double first = 1; ///< before this time, all pairs are
    double last = 0;  ///< likewise after this one
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
    std::iota(all.begin(), all.end(), 0U);
    return {std::vector<RangeCell::Side>(axes_.size()), std::make_shared<const Pairs>(std::move(all))};
}

/// Ascends with the place, and is exact at both ends of the box.
double RangeSearch::value(std::size_t axis, std::uint64_t place) const {
    const auto variable = Eigen::Index(axes_[axis]);
    const double lower = box_.lower[variable], upper = box_.upper[variable];
    return place == grid_size ? upper
                              : std::min(upper, lower + (upper - lower) * (double(place) / double(grid_size)));
}

ConfigurationBox RangeSearch::box_of(const RangeCell& cell) const {
    ConfigurationBox box = box_;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
        box.lower[Eigen::Index(axes_[a])] = value(a, cell.sides[a].lower);
        box.upper[Eigen::Index(axes_[a])] = value(a, cell.sides[a].upper);
    }
    return box;
}

/// The half widths count from the rounded middle, and cover the roundings of values along a sweep.
RangeSearch::Middle RangeSearch::middle(const RangeCell& cell, const Pairs& pairs) const {
    const ConfigurationBox box = box_of(cell);
    const Configuration at = box.lower + 0.5 * (box.upper - box.lower);
    std::vector<double> half;
    for (const std::size_t variable : axes_) {
        const auto i = Eigen::Index(variable);
        const double lower = box.lower[i], upper = box.upper[i];
        half.push_back(std::max(at[i] - lower, upper - at[i]) * outward_sum +
                       0x1p-50 * std::max(std::abs(lower), std::abs(upper)));
    }
    Middle middle{at, RestPlaces(prepared_, prepared_.model().motion_of({0, 1, at.transpose()})), {}};
    for (const std::uint32_t p : pairs)
        middle.ways.push_back(pairs_[p].displacements(middle.places, half));
    return middle;
}

/// A line in the direction of one axis, which ends at both values exactly.
JointPath RangeSearch::path_along(const Configuration& from, std::size_t axis, double start, double end) const {
    const Model& model = prepared_.model();
    JointPath::Segment segment{0, 1, Eigen::MatrixXd::Zero(2, from.size()), Eigen::MatrixXd::Zero(2, from.size())};
    const auto variable = Eigen::Index(axes_[axis]);
    const algebra::DoubleDouble way = algebra::DoubleDouble(end) - algebra::DoubleDouble(start);
    segment.coefficients.row(0) = from.transpose();
    segment.coefficients(0, variable) = start;
    segment.coefficients(1, variable) = double(way);
    segment.remainders(1, variable) = double(way - algebra::DoubleDouble(double(way)));
    return JointPath::of_parts({segment}, model.quaternions, model.variables_of_paths);
}

namespace {

/// The first time at which a pair comes within a distance, of the whole segment; empty if it does not.
std::optional<double> first_time_within(const SegmentPairs& segment, const Task& task, double distance) {
    const double duration = task.part.upper - task.part.lower;
    QueryOptions options;
    options.margin = distance;
    options.time_tolerance = std::min(time_tolerance / duration, 1.0);
    const auto trajectory = segment.trajectory(task);
    const FirstContact found = segment.naming(task, [&] {
        return query::answer({segment.prepared().moving(task).shape.body(),
                              segment.prepared().fixed_shape(task).body(), trajectory, options});
    });
    if (found.verdict == Verdict::clear)
        return std::nullopt;
    return in_segment({found.clear_until, found.clear_until}, task.part).lower;
}

/// A pair and a part of a sweep, which may be near.
struct NearPart {
    Task task;
    std::size_t pair; ///< in the list of the cell
    double margin;
};

/// Tests the parts that may come first. Takes out those that are clear, and returns the first time of the others.
double first_of(const SegmentPairs& segment, std::vector<NearPart>& parts) {
    std::ranges::stable_sort(parts, {}, [](const NearPart& part) { return part.task.part.lower; });
    double first = 1;
    std::erase_if(parts, [&](const NearPart& part) {
        if (part.task.part.lower >= first)
            return false; // it is not tested
        const std::optional<double> time = first_time_within(segment, part.task, part.margin);
        first = std::min(first, time.value_or(1));
        return !time;
    });
    return first;
}

} // namespace

RangeSearch::Sweep RangeSearch::sweep(const RangeCell& cell, const Middle& middle, std::size_t axis,
                                      const Pairs& pairs) const {
    const double start = value(axis, cell.sides[axis].lower), end = value(axis, cell.sides[axis].upper);
    const JointPath path = path_along(middle.at, axis, start, end);
    const SegmentPairs segment(prepared_, path, 0);
    std::vector<NearPair> asked;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        asked.push_back({pairs_[pairs[i]].task(), pairs_[pairs[i]].margin() + middle.way_without(i, axis)});
    std::vector<NearPart> parts;
    for (const Task& task : near_tasks(prepared_, segment.motion(), asked)) {
        const auto pair = std::size_t(
            std::ranges::find_if(asked, [&](const NearPair& near) { return is_same(near.task, task); }) - asked.begin());
        parts.push_back({task, pair, asked[pair].margin});
    }
    Sweep found;
    found.first = first_of(segment, parts);
    if (parts.empty())
        return found;
    for (NearPart& part : parts)
        part.task.part = {1 - part.task.part.upper, 1 - part.task.part.lower};
    const JointPath back = path_along(middle.at, axis, end, start);
    found.last = 1 - first_of(SegmentPairs(prepared_, back, 0), parts);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (std::ranges::find(parts, i, &NearPart::pair) != parts.end())
            found.near.push_back(pairs[i]);
    return found;
}

/// The last place of a side that a sweep reaches before a time.
std::uint64_t RangeSearch::place_before(const RangeCell::Side& side, std::size_t axis, double time) const {
    const std::uint64_t step = std::max<std::uint64_t>(1, std::bit_floor(side.width() / cuts_in_cell));
    const double start = value(axis, side.lower), way = value(axis, side.upper) - start;
    const double before = time - rounding_of_times;
    if (!(before > 0 && way > 0))
        return side.lower;
    std::uint64_t place = (side.lower + std::uint64_t(before * double(side.width()))) / step * step;
    while (place > side.lower && (value(axis, place) - start) / way >= before)
        place -= std::min(step, place);
    return std::max(place, side.lower);
}

/// The first place of a side that a sweep reaches after a time.
std::uint64_t RangeSearch::place_after(const RangeCell::Side& side, std::size_t axis, double time) const {
    const std::uint64_t step = std::max<std::uint64_t>(1, std::bit_floor(side.width() / cuts_in_cell));
    const double start = value(axis, side.lower), way = value(axis, side.upper) - start;
    const double after = time + rounding_of_times;
    if (!(after < 1 && way > 0))
        return side.upper;
    std::uint64_t place = (side.lower + std::uint64_t(after * double(side.width())) + step) / step * step;
    while (place < side.upper && (value(axis, place) - start) / way <= after)
        place += step;
    return std::min(place, side.upper);
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
    const JointPath path = path_along(at, 0, at[Eigen::Index(axes_[0])], at[Eigen::Index(axes_[0])]);
    const SegmentPairs rest(prepared_, path, 0);
    RestAnswer answer;
    for (const std::uint32_t p : pairs) {
        Task task = pairs_[p].task();
        task.part = {0, 1};
        QueryOptions options;
        options.margin = pairs_[p].margin();
        const Body &moving = prepared_.moving(task).shape.body(), &fixed = prepared_.fixed_shape(task).body();
        const auto trajectory = rest.trajectory(task);
        const FirstContact found =
            rest.naming(task, [&] { return query::answer({moving, fixed, trajectory, options}); });
        answer.is_clear = answer.is_clear && found.verdict == Verdict::clear;
        if (found.verdict != Verdict::contact_at_start || !found.certain)
            continue;
        const bool is_within = pairs_[p].margin() + moving.radius() + fixed.radius() > 0;
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

/// Whether one pair touches wherever no axis is farther from the middle than in the cell.
bool RangeSearch::is_in_contact(const Middle& middle, const Pairs& pairs, std::optional<RangeWitness>& found) const {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const RangePair& pair = pairs_[pairs[i]];
        const double way = middle.way(i);
        if (way > pair.greatest_depth())
            continue;
        const Eigen::Isometry3d relative = pair.relative(middle.places);
        if (overlap_within(moving_surface(pair), fixed_surface(pair), relative,
                           {way, pair.margin(), middle.places.size()})) {
            found = RangeWitness{middle.at, name_of(prepared_, pair.task()), true};
            return true;
        }
        if (way == 0) // nothing moves, so one configuration stands for all
            if (const RestAnswer rest = at_rest(middle.at, {pairs[i]}); rest.witness) {
                found = rest.witness;
                return true;
            }
    }
    return false;
}

RangeSearch::Outcome RangeSearch::examine(const RangeCell& cell, bool seeks_witness) const {
    throw_if_cancelled();
    Outcome outcome;
    const auto any = [](std::size_t) { return true; };
    const Middle whole_middle = middle(cell, *cell.pairs);
    const std::size_t axis = *whole_middle.widest_axis(axes_.size(), any);
    const Sweep found = sweep(cell, whole_middle, axis, *cell.pairs);
    if (found.near.empty()) {
        outcome.clear.push_back(cell);
        return outcome;
    }
    RangeCell rest{cell.sides, std::make_shared<const Pairs>(found.near)};
    const RangeCell::Side side = cell.sides[axis];
    const std::uint64_t lower = place_before(side, axis, found.first), upper = place_after(side, axis, found.last);
    const auto cut_off = [&](std::uint64_t from, std::uint64_t to) {
        outcome.clear.push_back(cell);
        outcome.clear.back().sides[axis] = {from, to};
    };
    if (lower < upper && (lower - side.lower) >= std::max<std::uint64_t>(1, side.width() / least_cut)) {
        cut_off(side.lower, lower);
        rest.sides[axis].lower = lower;
    }
    if (lower < upper && (side.upper - upper) >= std::max<std::uint64_t>(1, side.width() / least_cut)) {
        cut_off(upper, side.upper);
        rest.sides[axis].upper = upper;
    }
    const Middle at = middle(rest, found.near);
    if (is_in_contact(at, found.near, outcome.witness)) {
        outcome.contact = std::move(rest);
        return outcome;
    }
    if (seeks_witness)
        outcome.witness = at_rest(at.at, found.near).witness;
    const std::optional<std::size_t> widest =
        at.widest_axis(axes_.size(), [&](std::size_t a) { return rest.sides[a].width() > 1; });
    outcome.open.push_back(std::move(rest));
    if (widest) {
        outcome.open.push_back(outcome.open.front());
        RangeCell::Side &first = outcome.open[0].sides[*widest], &second = outcome.open[1].sides[*widest];
        first.upper = second.lower = first.lower + first.width() / 2;
    }
    return outcome;
}

} // namespace chasles::robot
