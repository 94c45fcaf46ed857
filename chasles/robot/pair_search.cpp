#include "chasles/robot/pair_search.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/base/parallel_for.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/query/pair_query.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace chasles::robot {

namespace {

/// This many random lines are searched first. Most pairs that can touch do touch on one of these lines.
constexpr int random_lines = 400;
/// Cells that are examined together.
constexpr std::size_t cells_together = 256;

} // namespace

PairSearch::PairSearch(const Robot& given, std::size_t first, std::size_t second, const PairProofOptions& options)
    : model_(given.model()), options_(options), neutral_(given.neutral()) {
    for (const Element& element : model_.elements) {
        if (element.owner == first)
            first_.push_back(&element);
        if (element.owner == second)
            second_.push_back(&element);
    }
    const PairAxes found = axes_between(model_, first_, second_);
    axes_ = found.axes;
    has_limits_ = found.have_limits;
}

/// `values` are those of all axes.
Configuration PairSearch::configuration(const std::vector<double>& values) const {
    Configuration q = neutral_;
    for (std::size_t i = 0; i < values.size(); ++i)
        q[Eigen::Index(axes_[i].variable)] = values[i];
    return q;
}

/// `values` are those of the axes without the last one, whose value is `swept`.
Configuration PairSearch::configuration(const std::vector<double>& values, double swept) const {
    Configuration q = configuration(values);
    if (!axes_.empty())
        q[Eigen::Index(axes_.back().variable)] = swept;
    return q;
}

/// Along the whole range of the swept variable.
JointPath::Segment PairSearch::line(const std::vector<double>& values) const {
    const double lower = axes_.empty() ? 0 : axes_.back().lower, upper = axes_.empty() ? 0 : axes_.back().upper;
    JointPath::Segment segment{0, 1, Eigen::MatrixXd::Zero(2, neutral_.size())};
    segment.coefficients.row(0) = configuration(values, lower).transpose();
    if (axes_.empty())
        return segment;
    const auto swept = Eigen::Index(axes_.back().variable);
    const algebra::DoubleDouble way = algebra::DoubleDouble(upper) - algebra::DoubleDouble(lower);
    segment.coefficients(1, swept) = double(way);
    segment.remainders = Eigen::MatrixXd::Zero(2, neutral_.size());
    segment.remainders(1, swept) = double(way - algebra::DoubleDouble(double(way))); // so it ends at the limit exactly
    return segment;
}

/// Calls `use` with the answer for each pair of shapes along a segment, until it returns false.
template <class Use>
void PairSearch::for_each_answer(const JointPath::Segment& segment, const QueryOptions& options, const Use& use) const {
    const SegmentMotion motion = model_.motion_of(segment);
    for (const Element* moving : first_)
        for (const Element* fixed : second_) {
            const motion::SharedFrame frame = motion::chain_frame(model_.chain_between(motion, *fixed, *moving));
            const motion::ErasedTrajectory trajectory{motion::SmoothTrajectory(motion::SmoothMotion::of_one(frame))};
            if (!use(query::answer({moving->shape.body(), fixed->shape.body(), trajectory, options})))
                return;
        }
}

/// Whether the links come within the margin on a line.
bool PairSearch::come_near(const std::vector<double>& values, double margin) const {
    QueryOptions options;
    options.margin = margin;
    options.find = Find::any;
    bool is_near = false;
    for_each_answer(line(values), options, [&](const FirstContact& found) {
        is_near = found.verdict != Verdict::clear;
        return !is_near;
    });
    return is_near;
}

/// When the links first touch on a line, and whether they do not at its start.
PairSearch::LineContact PairSearch::first_contact_on(const std::vector<double>& values) const {
    LineContact contact;
    for_each_answer(line(values), {}, [&](const FirstContact& found) {
        contact.starts_clear = contact.starts_clear && found.verdict != Verdict::contact_at_start;
        if (found.verdict != Verdict::clear && found.time.upper <= contact.when.value_or(1)) {
            contact.when = found.time.upper;
            contact.is_certain = found.certain;
        }
        return true;
    });
    return contact;
}

/// Up to rounding.
bool PairSearch::meet(const Configuration& values) const {
    bool they_meet = false;
    for_each_answer({0, 1, values.transpose()}, {}, [&](const FirstContact& found) {
        they_meet = found.verdict == Verdict::contact_at_start;
        return !they_meet;
    });
    return they_meet;
}

/// Whether the links are proven apart.
bool PairSearch::are_clear(const Configuration& values) const {
    bool are_clear = true;
    for_each_answer({0, 1, values.transpose()}, {}, [&](const FirstContact& found) {
        are_clear = found.verdict == Verdict::clear;
        return are_clear;
    });
    return are_clear;
}

void PairSearch::try_clear(const Configuration& values, PairProof& proof) {
    const bool is_clear = are_clear(values);
    was_clear_ = was_clear_ || is_clear;
    ++proof.tried;
    proof.touching += is_clear ? 0 : 1;
}

/// A line that starts in contact may be clear farther on: at its end, in the middle, and in between.
void PairSearch::look_for_clear(const std::vector<double>& values, PairProof& proof) {
    if (axes_.empty())
        return;
    const double lower = axes_.back().lower, way = axes_.back().upper - lower;
    for (const double share : {1.0, 0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875})
        if (!was_clear_)
            try_clear(configuration(values, lower + share * way), proof);
}

/// Past the first touch the links overlap.
void PairSearch::find_witness(const std::vector<double>& values, const LineContact& contact, PairProof& proof) {
    const double lower = axes_.empty() ? 0 : axes_.back().lower, upper = axes_.empty() ? 0 : axes_.back().upper;
    const auto at = [&](double time) { return configuration(values, lower + std::min(time, 1.0) * (upper - lower)); };
    if (contact.is_certain)
        proof.witness = at(*contact.when);
    for (const double deeper : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2})
        if (meet(at(*contact.when + deeper))) {
            proof.witness = at(*contact.when + deeper);
            break;
        }
    has_witness_ = proof.witness.has_value();
}

/// Searches a line. It may show a configuration in which the links touch, and another one in which they are apart.
void PairSearch::note(const std::vector<double>& values, PairProof& proof) {
    const LineContact contact = first_contact_on(values);
    was_clear_ = was_clear_ || contact.starts_clear;
    may_touch_ = may_touch_ || contact.when;
    ++proof.tried; // its start
    proof.touching += contact.starts_clear ? 0 : 1;
    if (contact.when && !proof.witness)
        find_witness(values, contact, proof);
    if (contact.when && !contact.starts_clear)
        look_for_clear(values, proof);
}

/// Random lines, the first one in the middle. True if the pair is decided.
bool PairSearch::sample(PairProof& proof) {
    std::mt19937_64 random(1);
    std::vector<double> values(axes_.empty() ? 0 : axes_.size() - 1);
    const int lines = axes_.size() < 2 ? 1 : random_lines;
    for (int i = 0; i < lines && !(was_clear_ && proof.witness); ++i, ++proof.cells) {
        throw_if_cancelled();
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double share = i == 0 ? 0.5 : std::ldexp(double(random() >> 11), -53);
            values[k] = axes_[k].lower + share * (axes_[k].upper - axes_[k].lower);
        }
        note(values, proof);
    }
    return decide(proof);
}

/// With at most one joint between the links, one line decides all that it never meets.
bool PairSearch::decide(PairProof& proof) const {
    if (was_clear_ && proof.witness)
        proof.reason = PairReason::sometimes;
    else if (axes_.size() < 2 && was_clear_ && !may_touch_)
        proof.reason = PairReason::never;
    else if (axes_.empty() && proof.witness)
        proof.reason = PairReason::always;
    return proof.reason != PairReason::open;
}

/// How far any point of the links is, in any configuration of the cell, from its place in the middle: on the line, or
/// at the configuration.
double PairSearch::margin_of(const Cell& cell) const {
    double margin = 0;
    for (std::size_t i = 0; i < cell.half.size(); ++i)
        margin += cell.half[i] * axes_[i].reach;
    return margin * outward_sum;
}

/// Into halves of the axis that moves points farthest.
void PairSearch::split(const std::vector<Axis>& axes, const Cell& cell, std::deque<Cell>& cells) {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < cell.half.size(); ++i)
        if (cell.half[i] * axes[i].reach > cell.half[widest] * axes[widest].reach)
            widest = i;
    for (const double side : {-0.5, 0.5}) {
        Cell half = cell;
        half.middle[widest] += side * cell.half[widest];
        half.half[widest] = 0.5 * cell.half[widest] * outward_sum;
        cells.push_back(std::move(half));
    }
}

PairSearch::Cell PairSearch::whole(std::size_t axes) const {
    Cell cell;
    for (std::size_t i = 0; i < axes; ++i) {
        cell.middle.push_back(0.5 * (axes_[i].lower + axes_[i].upper));
        cell.half.push_back(0.5 * (axes_[i].upper - axes_[i].lower) * outward_sum);
    }
    return cell;
}

/// Of the first cells, several at a time.
std::vector<char> PairSearch::flags_of(const std::deque<Cell>& cells,
                                       const std::function<bool(const Cell&)>& is_flagged) const {
    std::vector<char> flags(std::min(cells.size(), cells_together));
    parallel_for(options_.threads, flags.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            flags[i] = is_flagged(cells[i]) ? 1 : 0;
    });
    return flags;
}

/// Examines the first cells, and replaces the open ones by their halves. True once the pair is decided.
bool PairSearch::examine(std::deque<Cell>& cells, PairProof& proof, const Claim& claim) {
    const std::vector<char> are_open = flags_of(cells, claim.is_open);
    proof.cells += are_open.size();
    for (const char is_open : are_open) {
        throw_if_cancelled();
        if (is_open) {
            claim.look_at(cells.front());
            if (decide(proof))
                return true;
            split(axes_, cells.front(), cells);
        }
        cells.pop_front();
    }
    return false;
}

/// Proves a claim by boxes of so many axes.
void PairSearch::branch(PairProof& proof, std::size_t axes, const Claim& claim) {
    std::deque<Cell> cells{whole(axes)};
    while (!cells.empty())
        if (examine(cells, proof, claim))
            return;
    proof.reason = claim.reason;
}

/// The links are apart wherever no line of a cell comes near; a line that does may touch.
void PairSearch::prove_never(PairProof& proof) {
    branch(proof, axes_.size() - 1,
           {.reason = PairReason::never,
            .is_open = [&](const Cell& cell) { return come_near(cell.middle, margin_of(cell)); },
            .look_at = [&](const Cell& cell) { note(cell.middle, proof); }});
}

/// The links touch wherever a cell is proven to overlap; in the middle of another cell they may be apart.
void PairSearch::prove_always(PairProof& proof) {
    const OverlapProof overlaps(model_, first_, second_);
    branch(proof, axes_.size(),
           {.reason = PairReason::always,
            .is_open =
                [&](const Cell& cell) { return !overlaps.touch_within(margin_of(cell), configuration(cell.middle)); },
            .look_at = [&](const Cell& cell) { try_clear(configuration(cell.middle), proof); }});
}

void PairSearch::search(PairProof& proof) {
    if (!has_limits_ || sample(proof))
        return;
    if (!may_touch_)
        prove_never(proof);
    else if (may_be_always())
        prove_always(proof);
}

void PairSearch::run(PairProof& proof, double seconds, const std::function<bool()>& goes_on) {
    const Clock::time_point start = Clock::now();
    const Limit limit(seconds, goes_on);
    try {
        search(proof);
    } catch (const Cancelled&) { // what is known so far stays
    }
    proof.seconds += seconds_since(start);
}

} // namespace chasles::robot
