// The public face of a robot. A changed robot has a changed copy of its model, so checkers keep theirs.
#include "chasles/robot/robot.h"

#include "chasles/query/requirements.h"
#include "chasles/robot/model.h"

#include <algorithm>
#include <cmath>

namespace chasles {

using robot::Model;

namespace {

/// The number of [lower, upper] nearest to zero.
double nearest_to_zero(const RobotVariable& variable) {
    return std::clamp(0.0, variable.lower, variable.upper);
}

template <class Change>
std::shared_ptr<const Model> changed(const Model& model, const Change& change) {
    auto copy = std::make_shared<Model>(model);
    change(*copy);
    return copy;
}

/// Why no variable has this name, which may be that of a joint.
std::string why_no_variable(const Model& model, std::string_view name) {
    const auto& joints = model.description.joints;
    const auto joint = std::ranges::find(joints, name, &JointDescription::name);
    const std::string none = "there is no such variable of a joint";
    if (joint == joints.end())
        return none;
    if (joint->mimic)
        return none + ": it follows " + joint->mimic->joint;
    if (joint->type == JointType::fixed)
        return none + ": it is fixed";
    std::string names;
    for (const RobotVariable& variable : model.variables)
        if (variable.name.starts_with(joint->name + '/'))
            names += (names.empty() ? "" : ", ") + variable.name;
    return none + ": it has several, " + names;
}

/// The segment that stays at a configuration.
JointPath::Segment resting_segment(const Robot& robot, const Configuration& configuration) {
    const std::vector<Configuration> both{configuration, configuration};
    return JointPath::straight(robot, both).segments().front();
}

/// Sets the variables of a joint; a joint that follows another one has none.
void set_joint(Configuration& values, std::span<const RobotVariable> variables, const StateDescription::Value& given) {
    const auto first = std::ranges::find_if(variables, [&](const RobotVariable& v) {
        return v.name == given.joint || v.name.starts_with(given.joint + '/');
    });
    if (first == variables.end())
        return;
    const auto index = first - variables.begin();
    if (index + std::ptrdiff_t(given.values.size()) > values.size())
        robot::refuse(given.joint, "a state has too many values");
    std::ranges::copy(given.values, values.data() + index);
}

const StateDescription& state_named(const RobotDescription& robot, std::string_view name, std::string_view group) {
    const StateDescription* found = nullptr;
    for (const StateDescription& state : robot.states) {
        if (state.name != name || (!group.empty() && state.group != group))
            continue;
        if (found)
            robot::refuse(name, "the groups " + found->group + " and " + state.group +
                                    " have such a state; name one of them");
        found = &state;
    }
    if (!found)
        robot::refuse(name, group.empty() ? "there is no such state"
                                          : "the group " + std::string(group) + " has no such state");
    return *found;
}

} // namespace

Robot::Robot(RobotDescription description) : model_(std::make_shared<const Model>(std::move(description))) {}

const RobotDescription& Robot::description() const {
    return model_->description;
}

std::span<const RobotVariable> Robot::variables() const {
    return model_->variables;
}

std::size_t Robot::variable(std::string_view name) const {
    const auto found = model_->variable_of.find(name);
    if (found == model_->variable_of.end())
        robot::refuse(name, why_no_variable(*model_, name));
    return found->second;
}

Configuration Robot::neutral() const {
    Configuration values(Eigen::Index(model_->variables.size()));
    for (std::size_t i = 0; i < model_->variables.size(); ++i)
        values[Eigen::Index(i)] = nearest_to_zero(model_->variables[i]);
    for (const std::size_t first : model_->quaternions)
        values[Eigen::Index(first + 3)] = 1;
    return values;
}

Configuration Robot::state(std::string_view name, std::string_view group) const {
    Configuration values = neutral();
    for (const StateDescription::Value& value : state_named(model_->description, name, group).values)
        set_joint(values, model_->variables, value);
    return values;
}

Pose Robot::link_pose(std::string_view link, const Configuration& configuration) const {
    const std::size_t owner = model_->owner(link);
    const robot::SegmentMotion motion = model_->motion_of(resting_segment(*this, configuration));
    return model_->pose_of(motion, owner, 0);
}

std::vector<Pose> Robot::link_poses(const Configuration& configuration) const {
    return model_->link_poses(model_->motion_of(resting_segment(*this, configuration)), 0);
}

void Robot::set_base(const Pose& pose) {
    const Pose checked(pose.translation, Eigen::Quaterniond(pose.rotation));
    model_ = changed(*model_, [&](Model& m) { m.base = checked; });
}

const Pose& Robot::base() const {
    return model_->base;
}

void Robot::attach(const AttachedPart& part) {
    model_ = changed(*model_, [&](Model& m) { m.attach(part); });
}

void Robot::detach(std::string_view name) {
    model_ = changed(*model_, [&](Model& m) { m.detach(name); });
}

std::span<const AttachedPart> Robot::attached() const {
    return model_->parts;
}

void Robot::ignore(std::string_view first, std::string_view second) {
    model_ = changed(*model_, [&](Model& m) { m.ignored.insert(m.owners_of(first, second)); });
}

void Robot::test(std::string_view first, std::string_view second) {
    model_ = changed(*model_, [&](Model& m) { m.ignored.erase(m.owners_of(first, second)); });
}

bool Robot::is_tested(std::string_view first, std::string_view second) const {
    return model_->is_tested(model_->owners_of(first, second));
}

std::vector<std::pair<std::string, std::string>> Robot::tested_pairs() const {
    std::vector<bool> have_shapes(model_->owners.size());
    for (const robot::Element& element : model_->elements)
        have_shapes[element.owner] = true;
    std::vector<std::pair<std::string, std::string>> pairs;
    for (std::size_t a = 0; a < have_shapes.size(); ++a)
        for (std::size_t b = a + 1; b < have_shapes.size() && have_shapes[a]; ++b)
            if (have_shapes[b] && model_->is_tested({a, b}))
                pairs.emplace_back(model_->owners[a].name, model_->owners[b].name);
    return pairs;
}

void Robot::ignore_in_scene(std::string_view link, std::string_view body) {
    const std::string& name = model_->owners[model_->owner(link)].name;
    model_ = changed(*model_, [&](Model& m) { m.ignored_in_scene.emplace(name, body); });
}

bool Robot::is_tested_in_scene(std::string_view link, std::string_view body) const {
    return !model_->ignored_in_scene.contains({std::string(link), std::string(body)});
}

void Robot::set_margin(std::string_view first, std::string_view second, double margin) {
    QueryOptions options;
    options.margin = margin;
    query::check_options(options);
    model_ = changed(*model_, [&](Model& m) { m.margins[m.owners_of(first, second)] = margin; });
}

} // namespace chasles
