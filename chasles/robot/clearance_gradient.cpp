// How does the least distance along a path change with its knots? Source: docs/derivations/41-gradients.md, "Robots".
#include "chasles/base/limit_of_thread.h"
#include "chasles/motion/screw_path.h"
#include "chasles/query/agreement.h"
#include "chasles/query/witnesses.h"
#include "chasles/robot/knot_weights.h"
#include "chasles/robot/segment_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace chasles {

using query::Witness;
using query::Witnesses;
using robot::Element;
using robot::SegmentPairs;
using robot::Task;

namespace {

using Prepared = RobotChecker::Prepared;

/// The index of what a predicate holds for.
template <class Range, class Predicate>
std::size_t index_in(const Range& range, const Predicate& holds) {
    const auto found = std::ranges::find_if(range, holds);
    if (found == range.end())
        throw InvalidInput("gradient: clearance: is no answer of this checker: it tests no such pair");
    return std::size_t(found - range.begin());
}

/// The pair of an answer, over a whole segment.
Task task_of(const Prepared& prepared, const RobotPair& pair) {
    const robot::Model& model = prepared.model();
    const auto element = [&](const std::string& name, std::size_t shape) {
        return index_in(model.elements, [&](const Element& e) { return model.name_of(e) == std::pair(name, shape); });
    };
    const std::size_t first = element(pair.first, pair.first_shape);
    if (!pair.is_with_scene) {
        const std::size_t second = element(pair.second, pair.second_shape);
        return {Task::Kind::self,
                index_in(prepared.self_pairs,
                         [&](const Prepared::SelfPair& p) { return p.moving == first && p.fixed == second; }),
                0,
                {0, 1}};
    }
    const auto is_body = [&](std::size_t body) { return prepared.bodies[body].name == pair.second; };
    const auto mover = std::ranges::find_if(prepared.movers, is_body);
    if (mover != prepared.movers.end())
        return {Task::Kind::mover, first, std::size_t(mover - prepared.movers.begin()), {0, 1}};
    const auto is_obstacle = [&](const Prepared::Obstacle& obstacle) { return is_body(obstacle.body); };
    return {Task::Kind::obstacle, first, index_in(prepared.obstacles, is_obstacle), {0, 1}};
}

bool is_same_pair(const Task& a, const Task& b) {
    return a.kind == b.kind && a.first == b.first && a.second == b.second;
}

/// The derivatives of the distance of two points, one of each element of a pair, at a time of a segment.
class KnotSteps {
public:
    KnotSteps(const Prepared& prepared, const JointPath& path, const Task& task)
        : prepared_(prepared), path_(path), moving_(prepared.moving(task)), fixed_(nullptr) {
        const robot::Model& model = prepared.model();
        if (task.kind == Task::Kind::self)
            fixed_ = &model.elements[prepared.self_pairs[task.first].fixed];
        std::size_t a = moving_.group, b = fixed_ ? fixed_->group : 0; // up to the first common group above
        while (a != b) {
            std::size_t& deeper = model.groups[a].depth >= model.groups[b].depth ? a : b;
            add_variables(model.groups[deeper]);
            deeper = model.groups[deeper].parent;
        }
    }

    /// Whether joints move the elements against each other.
    [[nodiscard]] bool is_any() const { return !variables_.empty() || !quaternions_.empty(); }
    [[nodiscard]] Eigen::VectorXd gradient_of(std::size_t segment, const Witness& witness) const {
        const auto knots = Eigen::Index(path_.segments().size()) + 1;
        Eigen::MatrixXd by_knots = Eigen::MatrixXd::Zero(knots, Eigen::Index(prepared_.model().variables.size()));
        const std::vector<robot::KnotWeight> weights = robot::knot_weights(path_, segment, witness.time);
        for (const std::size_t variable : variables_) {
            const auto i = Eigen::Index(variable);
            const double rate = rate_of(segment, witness, step_of(variable, witness), Eigen::Vector2d::Ones(), i);
            for (const auto& [knot, weight] : weights)
                by_knots(Eigen::Index(knot), i) += weight * rate;
        }
        for (const std::size_t first : quaternions_)
            for (Eigen::Index i = Eigen::Index(first); i < Eigen::Index(first) + 4; ++i) {
                by_knots(Eigen::Index(segment), i) += rate_of(segment, witness, turn_step, {1, 0}, i);
                by_knots(Eigen::Index(segment) + 1, i) += rate_of(segment, witness, turn_step, {0, 1}, i);
            }
        return by_knots.reshaped();
    }

private:
    static constexpr double turn_step = 0x1p-17;

    void add_variables(const robot::RigidGroup& group) {
        for (const robot::JointStep& step : group.steps)
            variables_.insert(step.variable);
        if (group.quaternion)
            quaternions_.insert(*group.quaternion);
    }

    /// The turns of all joints that follow the variable are short. Slides are linear.
    [[nodiscard]] double step_of(std::size_t variable, const Witness& witness) const {
        double most_turn = 0;
        for (const robot::RigidGroup& group : prepared_.model().groups)
            for (const robot::JointStep& step : group.steps)
                if (step.variable == variable && step.turns)
                    most_turn = std::max(most_turn, std::abs(step.multiplier));
        if (most_turn > 0)
            return turn_step / std::max(1.0, most_turn);
        return turn_step * std::max(1.0, witness.on_moving.norm());
    }

    /// By a variable whose values at both ends of the segment change by these shares of the step.
    [[nodiscard]] double rate_of(std::size_t segment, const Witness& witness, double step,
                                 const Eigen::Vector2d& shares, Eigen::Index variable) const {
        const auto distance_after = [&](double signed_step) {
            JointPath::Segment changed = path_.segments()[segment];
            if (changed.remainders.size() == 0)
                changed.remainders.setZero(changed.coefficients.rows(), changed.coefficients.cols());
            changed.remainders(0, variable) += shares[0] * signed_step;
            if (shares[0] != shares[1]) // a straight segment
                changed.remainders(1, variable) += (shares[1] - shares[0]) * signed_step;
            return distance_of(changed, witness);
        };
        return (distance_after(step) - distance_after(-step)) / (2 * step);
    }

    /// Along the normal, up to a constant.
    [[nodiscard]] double distance_of(const JointPath::Segment& segment, const Witness& witness) const {
        const robot::SegmentMotion motion = prepared_.model().motion_of(segment);
        const auto place = [&](const Element& element, const Eigen::Vector3d& point) -> Eigen::Vector3d {
            const motion::SharedFrame frame =
                motion::chain_frame(prepared_.model().chain(motion, element.group, element.place));
            return motion::rounded(frame->refined_at(algebra::DoubleDouble(witness.time))).isometry() * point;
        };
        Eigen::Vector3d apart = place(moving_, witness.on_moving);
        if (fixed_)
            apart -= place(*fixed_, witness.on_fixed);
        return witness.normal.dot(apart);
    }

    const Prepared& prepared_;
    const JointPath& path_;
    const Element& moving_;
    const Element* fixed_;              ///< null if it is no part of the robot
    std::set<std::size_t> variables_;   ///< that move the elements against each other
    std::set<std::size_t> quaternions_; ///< the first variable of each
};

class GradientSearch {
public:
    GradientSearch(const Prepared& prepared, const JointPath& path, const RobotClearance& clearance)
        : prepared_(prepared), path_(path), segment_(clearance.segment), task_(task_of(prepared, *clearance.pair)),
          steps_(prepared, path, task_), radii_(distance_of_polyhedra(moving(task_), fixed(task_), 0)) {
        add(segment_, clearance.nearest.time.lower);
    }

    RobotGradient run();

private:
    [[nodiscard]] const Body& moving(const Task& task) const { return prepared_.moving(task).shape.body(); }
    [[nodiscard]] const Body& fixed(const Task& task) const { return prepared_.fixed_shape(task).body(); }
    void add(std::size_t segment, double time);
    void look_beside_knots();
    [[nodiscard]] bool is_alone() const;
    [[nodiscard]] bool is_alone_in(std::size_t segment) const;

    const Prepared& prepared_;
    const JointPath& path_;
    std::size_t segment_;
    Task task_;
    KnotSteps steps_;
    double radii_;
    std::vector<std::size_t> searched_; ///< segments, of the pair
    double level_ = 0;                  ///< of the surfaces
    bool are_all_ = true;
    bool is_at_start_ = false, is_at_end_ = false; ///< of the segment: some witness is at this knot
    std::optional<query::Agreement> gradients_;
};

/// The pair in a segment.
void GradientSearch::add(std::size_t segment, double time) {
    const SegmentPairs pairs(prepared_, path_, segment);
    const auto trajectory = pairs.trajectory(task_);
    const Witnesses found = query::witnesses_of({moving(task_), fixed(task_), trajectory}, time);
    for (const Witness& witness : found.all) {
        if (!gradients_)
            gradients_.emplace(witness.on_moving.norm());
        if (!gradients_->is_one() || !gradients_->add(steps_.gradient_of(segment, witness)))
            return;
        is_at_start_ = is_at_start_ || (segment == segment_ && witness.time == 0);
        is_at_end_ = is_at_end_ || (segment == segment_ && witness.time == 1);
    }
    are_all_ = are_all_ && (found.are_all || !steps_.is_any()); // without joints all have the gradient 0
    if (searched_.empty())
        level_ = std::max(0.0, found.level - radii_);
    searched_.push_back(segment);
}

/// A minimum at a knot is one of both segments there.
void GradientSearch::look_beside_knots() {
    if (is_at_start_ && segment_ > 0)
        add(segment_ - 1, 1);
    if (is_at_end_ && segment_ + 1 < path_.segments().size())
        add(segment_ + 1, 0);
}

/// Whether no other pair comes within the level, and this one in no other segment.
bool GradientSearch::is_alone() const {
    for (std::size_t segment = 0; segment < path_.segments().size(); ++segment)
        if (!is_alone_in(segment))
            return false;
    return true;
}

bool GradientSearch::is_alone_in(std::size_t segment) const {
    const SegmentPairs pairs(prepared_, path_, segment);
    const bool is_searched = !steps_.is_any() || std::ranges::find(searched_, segment) != searched_.end();
    const QueryOptions options{.margin = std::min(level_, Pose::largest_length), .find = Find::any};
    return std::ranges::all_of(near_tasks(prepared_, pairs.motion(), options.margin), [&](const Task& task) {
        if (is_searched && is_same_pair(task, task_))
            return true;
        const auto trajectory = pairs.trajectory(task);
        return query::answer({moving(task), fixed(task), trajectory, options}).verdict == Verdict::clear;
    });
}

RobotGradient GradientSearch::run() {
    RobotGradient result;
    result.by_knots = gradients_->first().reshaped(Eigen::Index(path_.segments().size()) + 1,
                                                   path_.segments()[0].coefficients.cols());
    try {
        if (are_all_ && gradients_->is_one())
            look_beside_knots();
        result.isolated = are_all_ && gradients_->is_one() && is_alone();
    } catch (const Cancelled&) { // what is left may be as near
    }
    return result;
}

} // namespace

RobotGradient RobotChecker::least_distance_gradient(const JointPath& path, const RobotClearance& clearance) const {
    if (path.knots() == JointPath::Knots::none)
        static_cast<void>(robot::knot_weights(path, 0, 0)); // says why
    if (!clearance.pair || !(clearance.distance.upper > 0))
        return {};
    if (clearance.segment >= path.segments().size())
        throw InvalidInput("gradient: clearance: is no answer about this path, which has fewer segments");
    return GradientSearch(*prepared_, path, clearance).run();
}

} // namespace chasles
