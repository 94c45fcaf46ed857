// Makes the tree of a description, and chains of it. Source: docs/derivations/29-robots.md, "Rigid groups".
#include "chasles/robot/model.h"

#include "chasles/base/invalid_input.h"
#include "chasles/robot/description_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace chasles::robot {

namespace {

using motion::FixedAxis;
using motion::FixedPose;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Chains are followed recursively.
constexpr std::size_t longest_chain = 1000;

/// The x and the y axis, turned as the shortest way turns the z axis to a unit vector; to the opposite of the z axis
/// about the x axis. Exact if the vector is an axis.
std::array<Eigen::Vector3d, 2> axes_across(const Eigen::Vector3d& unit) {
    constexpr double rounding = 1e-12;
    const double x = unit.x(), y = unit.y(), sum = 1 + unit.z();
    if (sum < rounding)
        return {Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY()};
    return {Eigen::Vector3d(1 - x * x / sum, -x * y / sum, -x), Eigen::Vector3d(-x * y / sum, 1 - y * y / sum, -y)};
}

template <class Map>
std::size_t found_in(const Map& map, std::string_view name, const char* what) {
    const auto found = map.find(name);
    if (found == map.end())
        refuse(name, std::string("there is no such ") + what);
    return found->second;
}

/// The index of each name; refuses a name that is empty or comes twice.
template <class Item>
std::map<std::string, std::size_t, std::less<>> indices_of(const std::vector<Item>& items, const char* what) {
    std::map<std::string, std::size_t, std::less<>> indices;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (items[i].name.empty())
            refuse(std::string(what) + ' ' + std::to_string(i), "has no name");
        if (!indices.emplace(items[i].name, i).second)
            refuse(items[i].name, std::string("there is another ") + what + " of this name");
    }
    return indices;
}

/// The joint that a joint follows at last, and how: its value is multiplier * value + offset.
struct Followed {
    const JointDescription* joint;
    double multiplier = 1;
    double offset = 0;
};

Followed followed(const RobotDescription& robot, const JointDescription& joint) {
    Followed f{&joint};
    for (std::size_t count = 0; f.joint->mimic; ++count) {
        const MimicDescription& mimic = *f.joint->mimic;
        const auto next = std::ranges::find(robot.joints, mimic.joint, &JointDescription::name);
        if (next == robot.joints.end())
            refuse(f.joint->name, "mimic: there is no joint " + mimic.joint);
        if (const std::string why = why_not_followed(next->type); !why.empty())
            refuse(f.joint->name, "mimic: " + mimic.joint + why);
        if (count > robot.joints.size())
            refuse(joint.name, "mimic: follows itself");
        f.offset += f.multiplier * mimic.offset;
        f.multiplier *= mimic.multiplier;
        f.joint = &*next;
    }
    return f;
}

} // namespace

std::string why_not_followed(JointType type) {
    switch (type) {
    case JointType::fixed:
        return " is fixed: it has no value that a joint can follow";
    case JointType::planar:
        return " is planar: it has several values, and a joint can follow only one";
    case JointType::floating:
        return " is floating: it has several values, and a joint can follow only one";
    default:
        return {};
    }
}

std::vector<const char*> suffixes_of(JointType type) {
    switch (type) {
    case JointType::fixed:
        return {};
    case JointType::planar:
        return {"/x", "/y", "/theta"};
    case JointType::floating:
        return {"/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z", "/rot_w"};
    default:
        return {""};
    }
}

void refuse(std::string_view what, std::string_view why) {
    throw InvalidInput("robot: " + std::string(what) + (what.empty() ? "" : ": ") + std::string(why));
}

Model::Model(RobotDescription given) : description(std::move(given)) {
    add_variables();
    add_links();
    check_parts(description);
    find_continuous();
    apply_pairs();
}

bool JointStep::repeats_after_a_turn() const {
    return multiplier == 0 || (turns && std::trunc(multiplier) == multiplier);
}

bool RigidGroup::repeats_after_a_turn(std::size_t variable) const {
    return std::ranges::all_of(
        steps, [&](const JointStep& step) { return step.variable != variable || step.repeats_after_a_turn(); });
}

namespace {

RobotVariable variable_of_joint(const JointDescription& joint, const std::string& suffix) {
    const bool is_continuous = suffix == "/theta" || joint.type == JointType::continuous;
    if (suffix.starts_with("/rot"))
        return {joint.name + suffix, -1, 1, false};
    const bool has_limits = joint.type == JointType::revolute || joint.type == JointType::prismatic;
    return {joint.name + suffix, has_limits ? joint.lower : -infinity, has_limits ? joint.upper : infinity,
            is_continuous};
}

} // namespace

void Model::add_variables() {
    indices_of(description.joints, "joint");
    for (const JointDescription& joint : description.joints) {
        check(joint);
        if (joint.mimic)
            continue;
        if (joint.type == JointType::floating)
            quaternions.push_back(variables.size() + 3);
        for (const char* suffix : suffixes_of(joint.type))
            variables.push_back(variable_of_joint(joint, suffix));
    }
    variable_of = indices_of(variables, "variable");
}

/// The joint with its parent, without the place of the parent link in its group.
RigidGroup Model::group_of(const JointDescription& joint) const {
    RigidGroup group;
    const auto add = [&](const Eigen::Vector3d& axis, bool turns, std::size_t variable, double multiplier = 1,
                         double offset = 0) {
        group.steps.push_back({FixedAxis(axis), variable, multiplier, offset, turns});
    };
    if (joint.type == JointType::planar) {
        const auto [x, y] = axes_across(joint.axis.stableNormalized());
        const std::size_t first = variable_of.at(joint.name + "/x");
        add(x, false, first);
        add(y, false, first + 1);
        add(joint.axis, true, first + 2);
    } else if (joint.type == JointType::floating) {
        const std::size_t first = variable_of.at(joint.name + "/trans_x");
        for (int i = 0; i < 3; ++i)
            add(Eigen::Vector3d::Unit(i), false, first + std::size_t(i));
        group.quaternion = first + 3;
    } else {
        const Followed f = followed(description, joint);
        add(joint.axis, joint.type != JointType::prismatic, variable_of.at(f.joint->name), f.multiplier, f.offset);
    }
    return group;
}

/// The only link that is no joint's child.
std::size_t Model::root_link() const {
    std::vector<const JointDescription*> above(description.links.size());
    for (const JointDescription& joint : description.joints) {
        found_in(owner_of, joint.parent, "link");
        const JointDescription*& of_child = above[found_in(owner_of, joint.child, "link")];
        if (of_child)
            refuse(joint.child, "is the child of two joints, " + of_child->name + " and " + joint.name);
        of_child = &joint;
    }
    const auto root = std::ranges::find(above, nullptr);
    if (root == above.end())
        refuse(description.name, "has no root: every link is the child of a joint");
    const auto name = [&](auto link) { return description.links[std::size_t(link - above.begin())].name; };
    if (const auto other = std::find(root + 1, above.end(), nullptr); other != above.end())
        refuse(name(other), "is the child of no joint, and neither is " + name(root));
    return std::size_t(root - above.begin());
}

void Model::add_links() {
    owner_of = indices_of(description.links, "link");
    if (description.links.empty())
        refuse(description.name, "has no link");
    owners.resize(description.links.size());
    groups.emplace_back();
    add_below(root_link());
    for (std::size_t i = 0; i < owners.size(); ++i) {
        const LinkDescription& link = description.links[i];
        if (owners[i].name.empty())
            refuse(link.name, "is not connected with the root");
        for (std::size_t k = 0; k < link.collisions.size(); ++k) {
            const CollisionDescription& shape = link.collisions[k];
            elements.push_back({i, owners[i].group, owners[i].place * FixedPose(shape.origin), shape.shape, k});
        }
    }
}

/// Places the links from the root outwards, and finds their neighbours.
void Model::add_below(std::size_t root) {
    constexpr std::size_t none = std::size_t(-1);
    std::vector<std::vector<const JointDescription*>> joints_below(owners.size());
    for (const JointDescription& joint : description.joints)
        joints_below[owner_of.at(joint.parent)].push_back(&joint);
    std::vector<std::size_t> order{root};
    std::vector<std::size_t> last_with_shapes(owners.size(), none); // on the way from the root to each link
    owners[root] = {description.links[root].name, 0, FixedPose()};
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::size_t link = order[i];
        if (!description.links[link].collisions.empty())
            last_with_shapes[link] = link;
        for (const JointDescription* const joint : joints_below[link]) {
            const std::size_t child = owner_of.at(joint->child);
            owners[child] = child_of(owners[link], *joint);
            last_with_shapes[child] = last_with_shapes[link];
            neighbours.insert(std::minmax(child, link));
            if (last_with_shapes[link] != none)
                neighbours.insert(std::minmax(child, last_with_shapes[link]));
            order.push_back(child);
        }
    }
}

/// The child of a joint; a joint that moves begins a rigid group.
Owner Model::child_of(const Owner& parent, const JointDescription& joint) {
    const FixedPose origin = parent.place * FixedPose(joint.origin);
    if (joint.type == JointType::fixed)
        return {joint.child, parent.group, origin};
    RigidGroup group = group_of(joint);
    group.parent = parent.group;
    group.depth = groups[parent.group].depth + 1;
    if (group.depth > longest_chain)
        refuse(joint.name, "there are more than 1000 joints above it");
    group.origin = origin;
    groups.push_back(std::move(group));
    return {joint.child, groups.size() - 1, FixedPose()};
}

/// A variable is continuous only if all joints that follow it are where they were after a turn.
void Model::find_continuous() {
    for (const RigidGroup& group : groups)
        for (const JointStep& step : group.steps)
            if (!step.repeats_after_a_turn())
                variables[step.variable].is_continuous = false;
    variables_of_paths = std::make_shared<const std::vector<RobotVariable>>(variables);
}

void Model::apply_pairs() {
    ignored = neighbours;
    for (const LinkPairDescription& pair : description.disabled_pairs)
        ignored.insert(owners_of(pair.first, pair.second));
    for (const LinkPairDescription& pair : description.enabled_pairs)
        ignored.erase(owners_of(pair.first, pair.second));
}

std::size_t Model::owner(std::string_view name) const {
    return found_in(owner_of, name, "link or part");
}

Model::OwnerPair Model::owners_of(std::string_view a, std::string_view b) const {
    const std::size_t first = owner(a), second = owner(b);
    if (first == second)
        refuse(a, "is named twice");
    return std::minmax(first, second);
}

void Model::attach(const AttachedPart& part) {
    if (part.name.empty() || owner_of.contains(part.name))
        refuse(part.name.empty() ? "part" : part.name, part.name.empty() ? "has no name" : "the name is taken");
    const Owner link = owners[owner(part.link)];
    std::vector<std::size_t> touching{owner(part.link)};
    for (const std::string& name : part.touch_links)
        touching.push_back(owner(name));
    const std::size_t index = owners.size();
    const FixedPose place = link.place * FixedPose(part.pose);
    owners.push_back({part.name, link.group, place});
    owner_of.emplace(part.name, index);
    elements.push_back({index, link.group, place, part.shape});
    parts.push_back(part);
    for (const std::size_t other : touching)
        ignored.insert({other, index});
}

/// Forgets the pairs of an owner. Owners with a higher index move down by one.
template <class Kept>
void remove_owner(Kept& kept, std::size_t removed) {
    const auto renumbered = [&](const Model::OwnerPair& pair) {
        return Model::OwnerPair(pair.first - (pair.first > removed), pair.second - (pair.second > removed));
    };
    Kept others;
    for (const auto& entry : kept)
        if constexpr (std::is_same_v<Kept, std::set<Model::OwnerPair>>) {
            if (entry.first != removed && entry.second != removed)
                others.insert(renumbered(entry));
        } else if (entry.first.first != removed && entry.first.second != removed)
            others.emplace(renumbered(entry.first), entry.second);
    kept = std::move(others);
}

void Model::detach(std::string_view name) {
    const auto found = std::ranges::find(parts, name, &AttachedPart::name);
    if (found == parts.end())
        refuse(name, "there is no such part");
    const std::size_t removed = owner_of.at(found->name);
    parts.erase(found);
    owners.erase(owners.begin() + std::ptrdiff_t(removed));
    std::erase_if(elements, [&](const Element& e) { return e.owner == removed; });
    for (Element& element : elements)
        element.owner -= element.owner > removed;
    owner_of = indices_of(owners, "part");
    remove_owner(ignored, removed);
    remove_owner(margins, removed);
}

} // namespace chasles::robot
