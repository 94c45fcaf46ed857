// Validators for the planners of OMPL: motions are proven instead of sampled. This header is not part of
// chasles/chasles.h; who includes it has OMPL (1.5 or later).
//
//     chasles::RobotChecker checker(robot, &scene);
//     auto validity = std::make_shared<chasles::ompl::RobotValidityChecker>(information, checker);
//     information->setStateValidityChecker(validity);
//     information->setMotionValidator(std::make_shared<chasles::ompl::RobotMotionValidator>(information, checker));
#pragma once

#include "chasles/base/invalid_input.h"
#include "chasles/robot/robot.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <utility>
#include <vector>

namespace chasles::ompl {

/// A body that moves freely in space, as a robot for an SE3StateSpace: its variables are x, y, z and a quaternion.
/// OMPL's interpolation, a straight line of the origin and slerp, is a straight path of this robot.
inline Robot free_body(const Polyhedron& shape, const std::string& name = "body") {
    RobotDescription robot{name};
    robot.links = {{"world"}, {name, {{shape}}}};
    JointDescription joint{"free", JointType::floating, "world", name};
    robot.joints = {joint};
    return Robot(std::move(robot));
}

/// How the numbers of a state are the variables of a robot: the real numbers of a RealVectorStateSpace, SO2StateSpace
/// (where RobotVariable::is_continuous), SE2StateSpace (for planar joints), SE3StateSpace (for floating ones) or a
/// compound of them, in the order of `copyToReals`.
struct StateMap {
    std::vector<std::size_t> variables; ///< of the robot, one for each number of the state
    Configuration others;               ///< the values of all variables that a state does not have

    /// All variables in order.
    explicit StateMap(const Robot& robot) : variables(robot.variables().size()), others(robot.neutral()) {
        std::iota(variables.begin(), variables.end(), std::size_t{0});
    }
    /// Throws InvalidInput for an unknown name.
    StateMap(const Robot& robot, const std::vector<std::string>& names) : others(robot.neutral()) {
        for (const std::string& name : names)
            variables.push_back(robot.variable(name));
    }

    /// Throws InvalidInput for another number of values.
    [[nodiscard]] Configuration operator()(const ::ompl::base::StateSpace& space,
                                           const ::ompl::base::State* state) const {
        std::vector<double> reals;
        space.copyToReals(reals, state);
        if (reals.size() != variables.size())
            throw InvalidInput("state: has " + std::to_string(reals.size()) + " numbers, and " +
                               std::to_string(variables.size()) + " variables are named");
        Configuration values = others;
        for (std::size_t i = 0; i < reals.size(); ++i)
            values[Eigen::Index(variables[i])] = reals[i];
        return values;
    }
};

/// Refuses a space in which a number goes another way than its variable of the robot: then another motion would be
/// proven than the one that is planned. Throws InvalidInput, for another number of values, too. Spaces that interpolate
/// in their own ways, such as Dubins curves, are not told apart.
inline void require_same_ways(const Robot& robot, const StateMap& map, ::ompl::base::StateSpace& space) {
    space.computeLocations(); // they are known after the space's setup only
    const auto& places = space.getValueLocations();
    if (places.size() != map.variables.size())
        throw InvalidInput("state: has " + std::to_string(places.size()) + " numbers, and " +
                           std::to_string(map.variables.size()) + " variables are named");
    for (std::size_t i = 0; i < places.size(); ++i) {
        const RobotVariable& variable = robot.variables()[map.variables[i]];
        const int type = places[i].stateLocation.space->getType();
        const auto refuse_unless = [&](bool fits, const char* why) {
            if (!fits)
                throw InvalidInput("space: number " + std::to_string(i) + ": " + variable.name + why);
        };
        const bool is_rotation = variable.name.find("/rot_") != std::string::npos;
        if (type == ::ompl::base::STATE_SPACE_REAL_VECTOR || type == ::ompl::base::STATE_SPACE_SO2)
            refuse_unless(!is_rotation, " is part of a quaternion, as in an SO3StateSpace");
        if (type == ::ompl::base::STATE_SPACE_REAL_VECTOR)
            refuse_unless(!variable.is_continuous, " goes the shorter way round, as in an SO2StateSpace");
        if (type == ::ompl::base::STATE_SPACE_SO2)
            refuse_unless(variable.is_continuous, " goes straight, as in a RealVectorStateSpace");
        if (type == ::ompl::base::STATE_SPACE_SO3)
            refuse_unless(is_rotation, " is no part of a quaternion");
    }
}

/// A state is valid within the bounds of its space, if the robot touches nothing there. Keeps the checker by reference.
/// Throws InvalidInput for a space as require_same_ways.
class RobotValidityChecker : public ::ompl::base::StateValidityChecker {
public:
    RobotValidityChecker(const ::ompl::base::SpaceInformationPtr& information, const RobotChecker& checker)
        : RobotValidityChecker(information, checker, StateMap(checker.robot())) {}
    RobotValidityChecker(const ::ompl::base::SpaceInformationPtr& information, const RobotChecker& checker,
                         StateMap map)
        : StateValidityChecker(information), checker_(checker), map_(std::move(map)) {
        require_same_ways(checker_.robot(), map_, *information->getStateSpace());
    }

    [[nodiscard]] bool isValid(const ::ompl::base::State* state) const override {
        return si_->satisfiesBounds(state) && checker_.is_clear(map_(*si_->getStateSpace(), state));
    }

private:
    const RobotChecker& checker_;
    StateMap map_;
};

/// A motion is valid if it is proven that the robot touches nothing on the way, and if its end is valid. Thread-safe as
/// OMPL's own validators are. Keeps the checker by reference. Throws InvalidInput for a space as require_same_ways.
class RobotMotionValidator : public ::ompl::base::MotionValidator {
public:
    using State = ::ompl::base::State;

    RobotMotionValidator(const ::ompl::base::SpaceInformationPtr& information, const RobotChecker& checker)
        : RobotMotionValidator(information, checker, StateMap(checker.robot())) {}
    RobotMotionValidator(const ::ompl::base::SpaceInformationPtr& information, const RobotChecker& checker,
                         StateMap map)
        : MotionValidator(information), checker_(checker), map_(std::move(map)) {
        require_same_ways(checker_.robot(), map_, *information->getStateSpace());
    }

    bool checkMotion(const State* s1, const State* s2) const override {
        const bool is_valid = si_->isValid(s2) && is_clear(s1, s2);
        ++(is_valid ? valid_ : invalid_);
        return is_valid;
    }

    /// `last.second` is a proven lower bound: the motion is clear up to there, and the state there is valid itself. The
    /// motion to that state, rounded as it is, is proven both ways.
    bool checkMotion(const State* s1, const State* s2, std::pair<State*, double>& last) const override {
        const RobotAnswer found = checker_.first_contact(values(s1), values(s2));
        const bool is_clear = found.verdict == Verdict::clear;
        if (is_clear && si_->isValid(s2)) {
            ++valid_;
            return true;
        }
        ++invalid_;
        set_last(s1, s2, is_clear ? 1 : found.clear_until, last);
        return false;
    }

private:
    [[nodiscard]] Configuration values(const State* state) const { return map_(*si_->getStateSpace(), state); }

    /// A state that touches refutes a motion at a fifth of the cost of a search along the way, and a state that is
    /// clear adds a tenth to the cost of a proof. So states come first where enough motions touch: one in eight so far.
    [[nodiscard]] bool is_clear(const State* s1, const State* s2) const {
        const bool refutes_first = 8 * touching_ >= asked_++;
        const bool is_clear =
            !(refutes_first && touches_at_states(s1, s2)) && checker_.is_clear(values(s1), values(s2));
        touching_ += is_clear ? 0 : 1;
        return is_clear;
    }

    /// In the middle and at the quarters.
    [[nodiscard]] bool touches_at_states(const State* s1, const State* s2) const {
        State* const between = si_->allocState();
        const bool touches = std::ranges::any_of(std::array{0.5, 0.25, 0.75}, [&](double fraction) {
            si_->getStateSpace()->interpolate(s1, s2, fraction, between);
            return !checker_.is_clear(values(between));
        });
        si_->freeState(between);
        return touches;
    }

    /// States are rounded, so the one at the end of the clear part may touch: it is approached from before, until the
    /// motion to it and back is proven, as a planner may use it either way. `s1` counts as valid. `last.first` may be
    /// one of both states, and is written at the end.
    void set_last(const State* s1, const State* s2, double clear_until, std::pair<State*, double>& last) const {
        State* const between = si_->allocState();
        double fraction = clear_until;
        bool is_valid = false;
        for (double step = 1e-10; step < 1 && !is_valid; step *= 4) {
            fraction = std::max(0.0, clear_until - step);
            si_->getStateSpace()->interpolate(s1, s2, fraction, between);
            is_valid = fraction > 0 && si_->isValid(between) && checker_.is_clear(values(between), values(s1)) &&
                       checker_.is_clear(values(s1), values(between));
        }
        if (!is_valid) {
            fraction = 0;
            si_->copyState(between, s1);
        }
        if (last.first)
            si_->copyState(last.first, between);
        last.second = fraction;
        si_->freeState(between);
    }

    const RobotChecker& checker_;
    StateMap map_;
    mutable std::atomic<std::size_t> asked_{0}, touching_{0}; ///< motions whose ends are valid
};

} // namespace chasles::ompl
