// Branch and bound over the joints between two links. One joint is swept exactly; the others make boxes of
// configurations, in which no point of a link is farther from its place in the middle than a bound.
// Source: docs/derivations/29-robots.md, "Pairs that never touch".
#include "chasles/robot/pair_proof.h"

#include "chasles/base/parallel_for.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/smooth_trajectory.h"
#include "chasles/query/pair_query.h"
#include "chasles/robot/model.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <numbers>
#include <random>

namespace chasles {

namespace {

using robot::Element;
using robot::Model;

/// Lines of random configurations that are asked first: most pairs that touch at all touch on one of them.
constexpr int random_lines = 400;
/// Cells that are examined together.
constexpr std::size_t cells_together = 256;
constexpr double outward_reach = 1 + 1e-9;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A variable between two links.
struct Axis {
    std::size_t variable = 0;
    double lower = 0;
    double upper = 0;
    double reach = 0; ///< a point of the links moves by at most this for each unit of the variable
};

/// A box of configurations, without the variable that is swept.
struct ConfigurationCell {
    std::vector<double> middle; ///< of each axis
    std::vector<double> half;
};

/// What is found about one line of configurations.
enum class LineFinding : std::uint8_t { apart, near, touching };

class PairSearch {
public:
    PairSearch(const Robot& given, std::size_t first, std::size_t second, const PairProofOptions& options)
        : robot_(given), model_(given.model()), options_(options), neutral_(given.neutral()) {
        for (const Element& element : model_.elements) {
            if (element.owner == first)
                first_.push_back(&element);
            if (element.owner == second)
                second_.push_back(&element);
        }
        find_axes();
    }

    /// The number of joints between the links: pairs with few are decided fast.
    [[nodiscard]] std::size_t dimension() const { return axes_.size(); }
    void run(PairProof& proof, double seconds);

private:
    void find_axes();
    [[nodiscard]] double reach_of(const Element& element) const;
    [[nodiscard]] Configuration configuration(const std::vector<double>& values, double swept) const;
    [[nodiscard]] JointPath::Segment line(const std::vector<double>& values) const;
    [[nodiscard]] LineFinding ask(const std::vector<double>& values, double margin, std::optional<double>* when,
                                  bool* starts_clear) const;
    [[nodiscard]] bool overlap(const Configuration& values) const;
    void note(const std::vector<double>& values, PairProof& proof);
    bool sample(PairProof& proof);
    void branch(PairProof& proof, double seconds, std::chrono::steady_clock::time_point start);
    [[nodiscard]] double margin_of(const ConfigurationCell& cell) const;
    static void split(const std::vector<Axis>& axes, const ConfigurationCell& cell,
                      std::deque<ConfigurationCell>& cells);

    const Robot& robot_;
    const Model& model_;
    const PairProofOptions& options_;
    Configuration neutral_;
    std::vector<const Element*> first_, second_;
    std::vector<Axis> axes_; ///< the swept one last
    bool has_limits_ = true;
    bool was_clear_ = false; ///< in some configuration
};

/// How far the points of an element are from the origin of its group.
double PairSearch::reach_of(const Element& element) const {
    const Body& body = element.shape.body();
    return length(placed(element.place.in_double, motion::vector_in<double>(body.bvh().centre()))) +
           body.vertex_radius();
}

/// The way from the second link to the first one goes up to their first common group and down again. A point behind a
/// joint is at most as far from it as all lengths between them sum up to.
void PairSearch::find_axes() {
    std::size_t a = first_.front()->group, b = second_.front()->group;
    std::vector<std::size_t> up, down; // groups whose joints are between the links
    while (a != b) {
        std::size_t& deeper = model_.groups[a].depth >= model_.groups[b].depth ? a : b;
        (&deeper == &a ? down : up).push_back(deeper);
        deeper = model_.groups[deeper].parent;
    }
    // From the moving link (the first one) inwards, and out to the fixed one: what is between the points and the joint.
    double arm = 0;
    for (const Element* element : first_)
        arm = std::max(arm, reach_of(*element));
    const auto add = [&](std::size_t group) {
        const robot::RigidGroup& g = model_.groups[group];
        has_limits_ = has_limits_ && !g.quaternion && g.steps.size() == 1;
        for (const robot::JointStep& step : g.steps) {
            const RobotVariable& variable = model_.variables[step.variable];
            Axis axis{step.variable, variable.lower, variable.upper, 0};
            if (variable.is_continuous)
                axis.lower = -std::numbers::pi, axis.upper = std::numbers::pi;
            if (!std::isfinite(axis.upper - axis.lower))
                has_limits_ = false;
            auto known = std::ranges::find(axes_, step.variable, &Axis::variable);
            if (known == axes_.end())
                known = axes_.insert(axes_.end(), axis);
            known->reach += std::abs(step.multiplier) * (step.turns ? arm : 1) * outward_reach;
            if (!step.turns) // all later joints may be as much farther away
                arm += std::abs(step.multiplier) * std::max(std::abs(axis.lower), std::abs(axis.upper)) +
                       std::abs(step.offset);
        }
    };
    for (const std::size_t group : down) {
        add(group);
        arm += length(model_.groups[group].origin.in_double.translation);
    }
    for (std::size_t i = up.size(); i-- > 0;) {
        arm += length(model_.groups[up[i]].origin.in_double.translation);
        add(up[i]);
    }
    if (!axes_.empty())
        std::ranges::iter_swap(std::ranges::max_element(
                                   axes_, {}, [](const Axis& axis) { return axis.reach * (axis.upper - axis.lower); }),
                               axes_.end() - 1);
}

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
    if (!axes_.empty())
        segment.coefficients(1, Eigen::Index(axes_.back().variable)) = upper - lower;
    return segment;
}

/// Whether the links come within the margin on a line; `when` gets the time, and the contact is the first one.
LineFinding PairSearch::ask(const std::vector<double>& values, double margin, std::optional<double>* when,
                            bool* starts_clear) const {
    QueryOptions options;
    options.margin = margin;
    options.find = when ? Find::first : Find::any;
    const robot::SegmentMotion motion = model_.motion_of(line(values));
    LineFinding finding = LineFinding::apart;
    for (const Element* moving : first_)
        for (const Element* fixed : second_) {
            const motion::SharedFrame frame = motion::chain_frame(model_.chain_between(motion, *fixed, *moving));
            const motion::ErasedTrajectory trajectory{motion::SmoothTrajectory(motion::SmoothMotion::of_one(frame))};
            const FirstContact found = query::answer({moving->shape.body(), fixed->shape.body(), trajectory, options});
            if (starts_clear && found.verdict == Verdict::contact_at_start)
                *starts_clear = false;
            if (found.verdict == Verdict::clear)
                continue;
            if (!when)
                return LineFinding::near;
            finding = LineFinding::touching;
            *when = std::min(when->value_or(1), found.time.upper);
        }
    return finding;
}

bool PairSearch::overlap(const Configuration& values) const {
    JointPath::Segment segment{0, 1, values.transpose()};
    const robot::SegmentMotion motion = model_.motion_of(segment);
    for (const Element* moving : first_)
        for (const Element* fixed : second_) {
            const motion::SharedFrame frame = motion::chain_frame(model_.chain_between(motion, *fixed, *moving));
            const motion::ErasedTrajectory trajectory{motion::SmoothTrajectory(motion::SmoothMotion::of_one(frame))};
            const FirstContact found =
                query::answer({moving->shape.body(), fixed->shape.body(), trajectory, QueryOptions()});
            if (found.verdict == Verdict::contact_at_start && found.overlap)
                return true;
        }
    return false;
}

/// Asks a line, and keeps what it shows: a configuration in which the links touch, and whether they do not in another.
void PairSearch::note(const std::vector<double>& values, PairProof& proof) {
    std::optional<double> when;
    bool starts_clear = true;
    const LineFinding finding = ask(values, 0, &when, &starts_clear);
    was_clear_ = was_clear_ || starts_clear;
    if (finding == LineFinding::apart || proof.witness)
        return;
    const double lower = axes_.empty() ? 0 : axes_.back().lower, upper = axes_.empty() ? 0 : axes_.back().upper;
    const auto at = [&](double time) { return configuration(values, lower + std::min(time, 1.0) * (upper - lower)); };
    proof.witness = at(*when);
    for (double deeper = 1e-9; deeper < 0.1; deeper *= 10) // past the first touch the links overlap
        if (overlap(at(*when + deeper))) {
            proof.witness = at(*when + deeper);
            return;
        }
}

/// True if the pair is decided.
bool PairSearch::sample(PairProof& proof) {
    std::mt19937_64 random(1);
    std::vector<double> values(axes_.empty() ? 0 : axes_.size() - 1);
    const int lines = axes_.size() < 2 ? 1 : random_lines;
    for (int i = 0; i < lines && !(was_clear_ && proof.witness); ++i) {
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double share = i == 0 ? 0.5 : std::ldexp(double(random() >> 11), -53);
            values[k] = axes_[k].lower + share * (axes_[k].upper - axes_[k].lower);
        }
        note(values, proof);
        ++proof.cells;
    }
    if (was_clear_ && proof.witness)
        proof.reason = PairReason::sometimes;
    else if (axes_.empty())
        proof.reason = proof.witness ? PairReason::always : PairReason::never;
    else if (axes_.size() == 1 && !proof.witness)
        proof.reason = PairReason::never;
    else
        return false;
    return true;
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

void PairSearch::branch(PairProof& proof, double seconds, std::chrono::steady_clock::time_point start) {
    ConfigurationCell whole;
    for (std::size_t i = 0; i + 1 < axes_.size(); ++i) {
        whole.middle.push_back(0.5 * (axes_[i].lower + axes_[i].upper));
        whole.half.push_back(0.5 * (axes_[i].upper - axes_[i].lower) * outward_reach);
    }
    std::deque<ConfigurationCell> cells{whole};
    while (!cells.empty()) {
        if (seconds_since(start) > seconds)
            return;
        const std::size_t count = std::min(cells.size(), cells_together);
        std::vector<LineFinding> findings(count);
        parallel_for(options_.threads, count, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                findings[i] = ask(cells[i].middle, margin_of(cells[i]), nullptr, nullptr);
        });
        proof.cells += count;
        for (std::size_t i = 0; i < count; ++i) {
            if (findings[i] == LineFinding::near) {
                note(cells.front().middle, proof);
                if (was_clear_ && proof.witness) {
                    proof.reason = PairReason::sometimes;
                    return;
                }
                split(axes_, cells.front(), cells);
            }
            cells.pop_front();
        }
    }
    proof.reason = PairReason::never;
}

void PairSearch::run(PairProof& proof, double seconds) {
    const auto start = std::chrono::steady_clock::now();
    if (has_limits_ && !sample(proof) && !proof.witness)
        branch(proof, seconds, start);
    proof.seconds = seconds_since(start);
}

/// Pairs with few joints between them come first, and leave their time to the others.
std::vector<std::size_t> in_order_of_effort(const std::vector<std::optional<PairSearch>>& searches) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < searches.size(); ++i)
        if (searches[i])
            order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return searches[i]->dimension(); });
    return order;
}

} // namespace

std::vector<PairProof> prove_pairs(const Robot& robot, const PairProofOptions& options) {
    query::require(options.seconds > 0, "seconds", "must be positive");
    const auto start = std::chrono::steady_clock::now();
    const Model& model = robot.model();
    const auto& links = robot.description().links;
    std::vector<PairProof> proofs;
    std::vector<std::optional<PairSearch>> searches;
    for (std::size_t i = 0; i < links.size(); ++i)
        for (std::size_t j = i + 1; j < links.size(); ++j) {
            if (links[i].collisions.empty() || links[j].collisions.empty())
                continue;
            proofs.push_back({links[i].name, links[j].name});
            if (model.neighbours.contains({i, j}))
                proofs.back().reason = PairReason::adjacent;
            searches.emplace_back();
            if (proofs.back().reason != PairReason::adjacent)
                searches.back().emplace(robot, i, j, options);
        }
    const std::vector<std::size_t> order = in_order_of_effort(searches);
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (options.progress && !options.progress(proofs.size() - (order.size() - k), proofs.size()))
            break;
        const double left = options.seconds - seconds_since(start);
        searches[order[k]]->run(proofs[order[k]], std::max(0.0, left / double(order.size() - k)));
    }
    if (options.progress)
        options.progress(proofs.size(), proofs.size());
    return proofs;
}

} // namespace chasles
