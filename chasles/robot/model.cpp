// Makes the tree of a description, and chains of it. Source: docs/derivations/29-robots.md, "Rigid groups".
#include "chasles/robot/model.h"

#include "chasles/base/invalid_input.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace chasles::robot {

namespace {

using motion::Chain;
using motion::ElementaryJoint;
using motion::FixedAxis;
using motion::FixedPose;
using motion::TimePolynomial;
using Wide = algebra::DoubleDouble;

constexpr double infinity = std::numeric_limits<double>::infinity();

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

void check_joint(const JointDescription& joint) {
    const bool has_axis = joint.type != JointType::fixed && joint.type != JointType::floating;
    if (has_axis && (!joint.axis.allFinite() || !(joint.axis.cwiseAbs().maxCoeff() > 0)))
        refuse(joint.name, "axis: must be finite and not zero");
    if (std::isnan(joint.lower) || std::isnan(joint.upper) || joint.lower > joint.upper)
        refuse(joint.name, "limits: the lower one must not be above the upper one");
    if (!joint.mimic)
        return;
    if (!std::isfinite(joint.mimic->multiplier) || !std::isfinite(joint.mimic->offset))
        refuse(joint.name, "mimic: multiplier and offset must be finite");
    if (joint.type == JointType::planar || joint.type == JointType::floating)
        refuse(joint.name, "mimic: a joint with several variables cannot follow another one");
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
        if (next->type != JointType::revolute && next->type != JointType::continuous &&
            next->type != JointType::prismatic)
            refuse(f.joint->name, "mimic: " + mimic.joint + " has not one variable");
        if (count > robot.joints.size())
            refuse(joint.name, "mimic: follows itself");
        f.offset += f.multiplier * mimic.offset;
        f.multiplier *= mimic.multiplier;
        f.joint = &*next;
    }
    return f;
}

} // namespace

void refuse(std::string_view what, std::string_view why) {
    throw InvalidInput("robot: " + std::string(what) + ": " + std::string(why));
}

Model::Model(RobotDescription given) : description(std::move(given)) {
    add_variables();
    add_links();
    find_neighbours();
    apply_pairs();
}

void Model::add_variables() {
    indices_of(description.joints, "joint");
    for (const JointDescription& joint : description.joints) {
        check_joint(joint);
        if (joint.type == JointType::fixed || joint.mimic)
            continue;
        const auto add = [&](const char* suffix, double lower, double upper, bool is_continuous) {
            variables.push_back({joint.name + suffix, lower, upper, is_continuous});
        };
        switch (joint.type) {
        case JointType::planar:
            for (const char* suffix : {"/x", "/y"})
                add(suffix, -infinity, infinity, false);
            add("/theta", -infinity, infinity, true);
            break;
        case JointType::floating:
            for (const char* suffix : {"/trans_x", "/trans_y", "/trans_z"})
                add(suffix, -infinity, infinity, false);
            quaternions.push_back(variables.size());
            for (const char* suffix : {"/rot_x", "/rot_y", "/rot_z", "/rot_w"})
                add(suffix, -1, 1, false);
            break;
        case JointType::continuous:
            add("", -infinity, infinity, true);
            break;
        default:
            add("", joint.lower, joint.upper, false);
            break;
        }
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
        const Eigen::Quaterniond plane = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), joint.axis);
        const std::size_t first = variable_of.at(joint.name + "/x");
        add(plane * Eigen::Vector3d::UnitX(), false, first);
        add(plane * Eigen::Vector3d::UnitY(), false, first + 1);
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

void Model::add_links() {
    owner_of = indices_of(description.links, "link");
    if (description.links.empty())
        refuse(description.name, "has no link");
    std::vector<const JointDescription*> parent_joint(description.links.size());
    for (const JointDescription& joint : description.joints) {
        found_in(owner_of, joint.parent, "link");
        const JointDescription*& of_child = parent_joint[found_in(owner_of, joint.child, "link")];
        if (of_child)
            refuse(joint.child, "is the child of two joints, " + of_child->name + " and " + joint.name);
        of_child = &joint;
    }
    const auto root = std::ranges::find(parent_joint, nullptr);
    if (root == parent_joint.end())
        refuse(description.name, "has no root: every link is the child of a joint");
    if (const auto other = std::find(root + 1, parent_joint.end(), nullptr); other != parent_joint.end())
        refuse(description.links[std::size_t(other - parent_joint.begin())].name,
               "is the child of no joint, and neither is " +
                   description.links[std::size_t(root - parent_joint.begin())].name);
    owners.resize(description.links.size());
    groups.emplace_back();
    std::size_t reached = add_below(std::size_t(root - parent_joint.begin()));
    if (reached < owners.size())
        for (std::size_t i = 0; i < owners.size(); ++i)
            if (owners[i].name.empty())
                refuse(description.links[i].name, "is not connected with the root");
    for (std::size_t i = 0; i < owners.size(); ++i)
        for (const CollisionDescription& shape : description.links[i].collisions) {
            const auto index = std::size_t(&shape - description.links[i].collisions.data());
            elements.push_back({i, owners[i].group, owners[i].place * FixedPose(shape.origin), shape.shape, index});
        }
}

/// Places the links from the root outwards, and returns their number.
std::size_t Model::add_below(std::size_t root) {
    std::vector<std::size_t> order{root};
    owners[root] = {description.links[root].name, 0, FixedPose()};
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Owner parent = owners[order[i]];
        for (const JointDescription& joint : description.joints) {
            if (joint.parent != parent.name)
                continue;
            const std::size_t child = owner_of.at(joint.child);
            const FixedPose origin = parent.place * FixedPose(joint.origin);
            if (joint.type == JointType::fixed) {
                owners[child] = {joint.child, parent.group, origin};
            } else {
                RigidGroup group = group_of(joint);
                group.parent = parent.group;
                group.depth = groups[parent.group].depth + 1;
                group.origin = origin;
                owners[child] = {joint.child, groups.size(), FixedPose()};
                groups.push_back(std::move(group));
            }
            order.push_back(child);
        }
    }
    return order.size();
}

/// Links without shapes pass the neighbourhood on.
void Model::find_neighbours() {
    std::vector<std::vector<std::size_t>> next(owners.size());
    for (const JointDescription& joint : description.joints) {
        const std::size_t a = owner_of.at(joint.parent), b = owner_of.at(joint.child);
        next[a].push_back(b);
        next[b].push_back(a);
    }
    for (std::size_t start = 0; start < next.size(); ++start) {
        std::vector<std::pair<std::size_t, std::size_t>> reached{{start, start}}; // a link, and where from
        for (std::size_t i = 0; i < reached.size(); ++i) {
            const auto [link, from] = reached[i];
            if (i > 0)
                neighbours.insert(std::minmax(start, link));
            if (i == 0 || description.links[link].collisions.empty())
                for (const std::size_t neighbour : next[link])
                    if (neighbour != from || i == 0)
                        reached.emplace_back(neighbour, link);
        }
    }
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

/// The parts that remain are attached anew, so that no index of the removed one is left anywhere.
void Model::detach(std::string_view name) {
    const auto found = std::ranges::find(parts, name, &AttachedPart::name);
    if (found == parts.end())
        refuse(name, "there is no such part");
    const std::size_t removed = owner_of.at(found->name);
    const auto renumbered = [&](std::size_t i) { return i > removed ? i - 1 : i; };
    parts.erase(found);
    owners.erase(owners.begin() + std::ptrdiff_t(removed));
    std::erase_if(elements, [&](const Element& e) { return e.owner == removed; });
    for (Element& element : elements)
        element.owner = renumbered(element.owner);
    owner_of.clear();
    for (std::size_t i = 0; i < owners.size(); ++i)
        owner_of.emplace(owners[i].name, i);
    std::set<OwnerPair> still_ignored;
    for (const auto& [a, b] : ignored)
        if (a != removed && b != removed)
            still_ignored.emplace(renumbered(a), renumbered(b));
    ignored = std::move(still_ignored);
    std::map<OwnerPair, double> still_wide;
    for (const auto& [pair, margin] : margins)
        if (pair.first != removed && pair.second != removed)
            still_wide.emplace(OwnerPair(renumbered(pair.first), renumbered(pair.second)), margin);
    margins = std::move(still_wide);
}

} // namespace chasles::robot
