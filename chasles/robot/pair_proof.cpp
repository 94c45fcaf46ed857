// Branch and bound over the joints between two links. One joint is swept exactly; the others make boxes of
// configurations, in which no point of a link is farther from its place in the middle than a bound.
// Source: docs/derivations/29-robots.md, "Pairs that never touch".
#include "chasles/robot/pair_proof.h"

#include "chasles/base/parallel_for.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/query/pair_query.h"
#include "chasles/robot/pair_axes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <random>

namespace chasles {

namespace {

using robot::Axis;
using robot::Element;
using robot::Model;

/// This many random lines are searched first. Most pairs that can touch do touch on one of these lines.
constexpr int random_lines = 400;
/// Cells that are examined together.
constexpr std::size_t cells_together = 256;
constexpr double outward_reach = 1 + 1e-9;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A box of configurations, without the variable that is swept.
struct ConfigurationCell {
    std::vector<double> middle; ///< of each axis
    std::vector<double> half;
};

class PairSearch {
public:
    PairSearch(const Robot& given, std::size_t first, std::size_t second, const PairProofOptions& options)
        : model_(given.model()), options_(options), neutral_(given.neutral()) {
        for (const Element& element : model_.elements) {
            if (element.owner == first)
                first_.push_back(&element);
            if (element.owner == second)
                second_.push_back(&element);
        }
        const robot::PairAxes found = robot::axes_between(model_, first_, second_);
        axes_ = found.axes;
        has_limits_ = found.have_limits;
    }

    /// The number of joints between the links: pairs with few are decided fast.
    [[nodiscard]] std::size_t dimension() const { return axes_.size(); }
    /// Whether more time may decide an open pair.
    [[nodiscard]] bool is_unfinished() const { return has_limits_ && !may_touch_; }
    void run(PairProof& proof, double seconds);

private:
    [[nodiscard]] Configuration configuration(const std::vector<double>& values, double swept) const;
    [[nodiscard]] JointPath::Segment line(const std::vector<double>& values) const;
    struct LineContact {
        std::optional<double> when = {};
        bool is_certain = false;
        bool starts_clear = true;
    };
    template <class Use>
    void for_each_answer(const JointPath::Segment& segment, const QueryOptions& options, const Use& use) const;
    [[nodiscard]] bool come_near(const std::vector<double>& values, double margin) const;
    [[nodiscard]] LineContact first_contact_on(const std::vector<double>& values) const;
    [[nodiscard]] bool overlap(const Configuration& values) const;
    void note(const std::vector<double>& values, PairProof& proof);
    bool sample(PairProof& proof);
    bool decide(PairProof& proof) const;
    void branch(PairProof& proof, double seconds, std::chrono::steady_clock::time_point start);
    [[nodiscard]] ConfigurationCell whole() const;
    bool examine(std::deque<ConfigurationCell>& cells, PairProof& proof);
    [[nodiscard]] double margin_of(const ConfigurationCell& cell) const;
    static void split(const std::vector<Axis>& axes, const ConfigurationCell& cell,
                      std::deque<ConfigurationCell>& cells);

    const Model& model_;
    const PairProofOptions& options_;
    Configuration neutral_;
    std::vector<const Element*> first_, second_;
    std::vector<Axis> axes_; ///< the swept one last
    bool has_limits_ = true;
    bool was_clear_ = false; ///< in some configuration
    bool may_touch_ = false; ///< in some configuration, if only by rounding
};

/// `values` are those of the axes without the last one, whose value is `swept`.
Configuration PairSearch::configuration(const std::vector<double>& values, double swept) const {
    Configuration q = neutral_;
    for (std::size_t i = 0; i < values.size(); ++i)
        q[Eigen::Index(axes_[i].variable)] = values[i];
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
    const robot::SegmentMotion motion = model_.motion_of(segment);
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

bool PairSearch::overlap(const Configuration& values) const {
    bool overlaps = false;
    for_each_answer({0, 1, values.transpose()}, {}, [&](const FirstContact& found) {
        overlaps = found.verdict == Verdict::contact_at_start && found.overlap;
        return !overlaps;
    });
    return overlaps;
}

/// Searches a line. It may show a configuration in which the links touch, and another one in which they are apart.
void PairSearch::note(const std::vector<double>& values, PairProof& proof) {
    const LineContact contact = first_contact_on(values);
    was_clear_ = was_clear_ || contact.starts_clear;
    may_touch_ = may_touch_ || contact.when;
    if (!contact.when || proof.witness)
        return;
    const double lower = axes_.empty() ? 0 : axes_.back().lower, upper = axes_.empty() ? 0 : axes_.back().upper;
    const auto at = [&](double time) { return configuration(values, lower + std::min(time, 1.0) * (upper - lower)); };
    if (contact.is_certain)
        proof.witness = at(*contact.when);
    for (const double deeper : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) // past the first touch they overlap
        if (overlap(at(*contact.when + deeper))) {
            proof.witness = at(*contact.when + deeper);
            return;
        }
}

/// Random lines, the first one in the middle. True if the pair is decided.
bool PairSearch::sample(PairProof& proof) {
    std::mt19937_64 random(1);
    std::vector<double> values(axes_.empty() ? 0 : axes_.size() - 1);
    const int lines = axes_.size() < 2 ? 1 : random_lines;
    for (int i = 0; i < lines && !(was_clear_ && proof.witness); ++i, ++proof.cells) {
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double share = i == 0 ? 0.5 : std::ldexp(double(random() >> 11), -53);
            values[k] = axes_[k].lower + share * (axes_[k].upper - axes_[k].lower);
        }
        note(values, proof);
    }
    return decide(proof);
}

/// With at most one joint between the links, one line decides all.
bool PairSearch::decide(PairProof& proof) const {
    if (was_clear_ && proof.witness)
        proof.reason = PairReason::sometimes;
    else if (axes_.size() < 2 && !may_touch_)
        proof.reason = PairReason::never;
    else if (axes_.empty() && proof.witness)
        proof.reason = PairReason::always;
    return proof.reason != PairReason::open;
}

/// How far any point of the links is, in any configuration of the cell, from its place on the line in the middle.
double PairSearch::margin_of(const ConfigurationCell& cell) const {
    double margin = 0;
    for (std::size_t i = 0; i < cell.half.size(); ++i)
        margin += cell.half[i] * axes_[i].reach;
    return margin * outward_reach;
}

/// Into halves of the axis that moves points farthest.
void PairSearch::split(const std::vector<Axis>& axes, const ConfigurationCell& cell,
                       std::deque<ConfigurationCell>& cells) {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < cell.half.size(); ++i)
        if (cell.half[i] * axes[i].reach > cell.half[widest] * axes[widest].reach)
            widest = i;
    for (const double side : {-0.5, 0.5}) {
        ConfigurationCell half = cell;
        half.middle[widest] += side * cell.half[widest];
        half.half[widest] = 0.5 * cell.half[widest] * outward_reach;
        cells.push_back(std::move(half));
    }
}

ConfigurationCell PairSearch::whole() const {
    ConfigurationCell cell;
    for (std::size_t i = 0; i + 1 < axes_.size(); ++i) {
        cell.middle.push_back(0.5 * (axes_[i].lower + axes_[i].upper));
        cell.half.push_back(0.5 * (axes_[i].upper - axes_[i].lower) * outward_reach);
    }
    return cell;
}

/// Examines the first cells, and replaces them by the halves of those that are not proven clear. True once the pair is
/// known to touch.
bool PairSearch::examine(std::deque<ConfigurationCell>& cells, PairProof& proof) {
    const std::size_t count = std::min(cells.size(), cells_together);
    std::vector<char> are_near(count);
    parallel_for(options_.threads, count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            are_near[i] = come_near(cells[i].middle, margin_of(cells[i])) ? 1 : 0;
    });
    proof.cells += count;
    for (const char is_near : are_near) {
        if (is_near) {
            note(cells.front().middle, proof);
            if (decide(proof))
                return true;
            split(axes_, cells.front(), cells);
        }
        cells.pop_front();
    }
    return false;
}

void PairSearch::branch(PairProof& proof, double seconds, std::chrono::steady_clock::time_point start) {
    std::deque<ConfigurationCell> cells{whole()};
    while (!cells.empty())
        if (seconds_since(start) > seconds || examine(cells, proof))
            return;
    proof.reason = PairReason::never;
}

void PairSearch::run(PairProof& proof, double seconds) {
    const auto start = std::chrono::steady_clock::now();
    if (has_limits_ && !sample(proof) && !may_touch_)
        branch(proof, seconds, start);
    proof.seconds += seconds_since(start);
}

/// A pair of links, and how to examine it; neighbours are not examined.
struct Examined {
    PairProof proof;
    std::optional<PairSearch> search = {};
};

std::vector<Examined> pairs_of(const Robot& robot, const PairProofOptions& options) {
    const auto& links = robot.description().links;
    std::vector<Examined> pairs;
    for (std::size_t i = 0; i < links.size(); ++i)
        for (std::size_t j = i + 1; j < links.size(); ++j) {
            if (links[i].collisions.empty() || links[j].collisions.empty())
                continue;
            pairs.push_back({{links[i].name, links[j].name}});
            if (robot.model().neighbours.contains({i, j}))
                pairs.back().proof.reason = PairReason::adjacent;
            else
                pairs.back().search.emplace(robot, i, j, options);
        }
    return pairs;
}

/// The pairs that more time may decide. Pairs with few joints between them come first, and leave their time to the
/// others.
std::vector<std::size_t> in_order_of_effort(const std::vector<Examined>& pairs) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].search && pairs[i].proof.reason == PairReason::open && pairs[i].search->is_unfinished())
            order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return pairs[i].search->dimension(); });
    return order;
}

/// Each pair has an equal share of the time that is left. False if the user ends it.
bool examine_in_turn(std::vector<Examined>& pairs, const std::vector<std::size_t>& order,
                     const PairProofOptions& options, std::chrono::steady_clock::time_point start) {
    for (std::size_t k = 0; k < order.size(); ++k) {
        auto& [proof, search] = pairs[order[k]];
        if (options.progress && !options.progress(pairs.size() - (order.size() - k), pairs.size()))
            return false;
        const double left = options.seconds - seconds_since(start);
        search->run(proof, std::max(0.0, left / double(order.size() - k)));
    }
    return true;
}

} // namespace

std::vector<PairProof> prove_pairs(const Robot& robot, const PairProofOptions& options) {
    query::require(options.seconds > 0, "seconds", "must be positive");
    const auto start = std::chrono::steady_clock::now();
    std::vector<Examined> pairs = pairs_of(robot, options);
    // Pairs that their share of the time left open share what the others have not used.
    for (std::vector<std::size_t> order = in_order_of_effort(pairs); !order.empty(); order = in_order_of_effort(pairs))
        if (!examine_in_turn(pairs, order, options, start) || seconds_since(start) >= options.seconds)
            break;
    if (options.progress)
        options.progress(pairs.size(), pairs.size());
    std::vector<PairProof> proofs;
    proofs.reserve(pairs.size());
    for (Examined& pair : pairs)
        proofs.push_back(std::move(pair.proof));
    return proofs;
}

} // namespace chasles
