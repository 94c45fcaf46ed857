// Reads pairs, groups and states of an SRDF file.
#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"
#include "chasles/robot/model.h"
#include "chasles/robot/unread_parts.h"
#include "chasles/robot/urdf_reader.h"
#include "chasles/robot/xml_file.h"

#include <algorithm>
#include <map>
#include <ranges>
#include <set>
#include <utility>

namespace chasles::robot {

namespace {

using XmlElement = XmlFile::Element;

class SrdfReader {
public:
    SrdfReader(const std::filesystem::path& path, RobotDescription& robot) : file_(path, "robot"), robot_(robot) {
        for (const LinkDescription& link : robot_.links)
            links_.insert(link.name);
        for (const JointDescription& joint : robot_.joints) {
            joint_above_.emplace(joint.child, &joint);
            joints_.emplace(joint.name, &joint);
        }
    }

    void read();

private:
    using Names = std::pair<std::string, std::string>;

    [[nodiscard]] Names names_of(const XmlElement& pair) const;
    [[nodiscard]] bool has_link(const XmlElement& element, const std::string& name);
    void warn(const XmlElement& element, const std::string& what, const std::string& name);
    void refuse_urdf() const;
    void warn_of_another_robot();
    void add_warnings();
    void add_disabled_pairs();
    void add_enabled_pairs();
    void add_default_pairs();
    void add_groups();
    void add_states();
    [[nodiscard]] const GroupDescription& made_group(const std::string& name, const XmlElement& place);
    void add_part(GroupDescription& group, const XmlElement& element);
    static void add_joint(GroupDescription& group, const JointDescription& joint);
    void add_chain(GroupDescription& group, const XmlElement& element);
    [[nodiscard]] StateDescription::Value value_of(const XmlElement& element, const JointDescription& joint) const;
    [[nodiscard]] std::vector<std::string> links_above(const std::string& link) const;

    XmlFile file_;
    RobotDescription& robot_;
    std::set<std::string> links_;
    std::set<Names> disabled_;                                   ///< pairs that the file names
    std::map<std::string, const JointDescription*> joints_;      ///< by name
    std::map<std::string, const JointDescription*> joint_above_; ///< of each link but the root
    std::map<std::string, const XmlElement*> group_elements_;
    std::map<std::string, GroupDescription> groups_; ///< that are made
    std::vector<std::string> open_groups_;           ///< that are being made, each inside of the one before it
    std::set<std::string> virtual_joints_;           ///< the file defines them; they are no joints of the robot
    struct Unknown {
        std::string place; ///< of the first element that names it
        std::size_t count = 0;
    };
    std::map<Names, Unknown> unknown_; ///< by what is missing and by name
};

template <class Items, class Item>
void add_once(Items& items, const Item& item) {
    if (std::ranges::find(items, item) == items.end())
        items.push_back(item);
}

SrdfReader::Names SrdfReader::names_of(const XmlElement& pair) const {
    Names names{file_.text(pair, "link1"), file_.text(pair, "link2")};
    if (names.first == names.second)
        file_.fail(pair, "names " + io::in_quotes(names.first) + " twice");
    return names;
}

/// Files are shared by variants of a robot, so one name may be missing many times: it makes one line.
void SrdfReader::warn(const XmlElement& element, const std::string& what, const std::string& name) {
    Unknown& unknown = unknown_[{what, name}];
    if (++unknown.count == 1)
        unknown.place = file_.place_of(element);
}

bool SrdfReader::has_link(const XmlElement& element, const std::string& name) {
    if (!links_.contains(name))
        warn(element, "link", name);
    return links_.contains(name);
}

void SrdfReader::add_warnings() {
    for (const auto& [names, unknown] : unknown_)
        robot_.warnings.push_back(
            unknown.place + "there is no " + names.first + ' ' + io::in_quotes(names.second) +
            (unknown.count > 1 ? "; it is named " + std::to_string(unknown.count) + " times" : std::string()));
}

void SrdfReader::add_disabled_pairs() {
    for (const XmlElement* pair : XmlFile::children(file_.root(), "disable_collisions")) {
        const auto [first, second] = names_of(*pair);
        const bool has_first = has_link(*pair, first);
        if (!has_link(*pair, second) || !has_first)
            continue;
        const char* const reason = pair->Attribute("reason");
        disabled_.insert(std::minmax(first, second));
        robot_.disabled_pairs.push_back({first, second, reason ? reason : ""});
    }
}

/// A pair that is also disabled stays disabled, as in MoveIt.
void SrdfReader::add_enabled_pairs() {
    for (const XmlElement* pair : XmlFile::children(file_.root(), "enable_collisions")) {
        const Names names = names_of(*pair);
        for (const std::string& link : {names.first, names.second})
            if (!links_.contains(link))
                file_.fail(*pair, "there is no link " + io::in_quotes(link));
        const char* const reason = pair->Attribute("reason");
        if (!disabled_.contains(std::minmax(names.first, names.second)))
            robot_.enabled_pairs.push_back({names.first, names.second, reason ? reason : ""});
    }
}

/// A link that is not tested unless its pairs are enabled.
void SrdfReader::add_default_pairs() {
    for (const XmlElement* element : XmlFile::children(file_.root(), "disable_default_collisions")) {
        const std::string link = file_.text(*element, "link");
        if (!has_link(*element, link))
            continue;
        for (const std::string& other : links_)
            if (other != link)
                robot_.disabled_pairs.push_back({link, other, "Default"});
    }
}

/// A link and all links above it.
std::vector<std::string> SrdfReader::links_above(const std::string& link) const {
    std::vector<std::string> links{link};
    for (auto above = joint_above_.find(link); above != joint_above_.end(); above = joint_above_.find(links.back()))
        links.push_back(above->second->parent);
    return links;
}

/// The joint, and the link that it moves.
void SrdfReader::add_joint(GroupDescription& group, const JointDescription& joint) {
    add_once(group.joints, joint.name);
    add_once(group.links, joint.child);
}

/// The joints from the base to the tip, by the lowest link that is above both.
void SrdfReader::add_chain(GroupDescription& group, const XmlElement& element) {
    const std::string base = file_.text(element, "base_link"), tip = file_.text(element, "tip_link");
    const bool has_base = has_link(element, base);
    if (!has_link(element, tip) || !has_base)
        return;
    std::vector<std::string> from = links_above(base), to = links_above(tip);
    while (!from.empty() && !to.empty() && from.back() == to.back()) {
        from.pop_back();
        to.pop_back();
    }
    for (const std::string& link : from)
        add_joint(group, *joint_above_.at(link));
    for (const std::string& link : std::views::reverse(to))
        add_joint(group, *joint_above_.at(link));
}

void SrdfReader::add_part(GroupDescription& group, const XmlElement& element) {
    const std::string_view kind = element.Name();
    if (kind == "joint") {
        const std::string name = file_.text(element, "name");
        if (const auto joint = joints_.find(name); joint != joints_.end())
            add_joint(group, *joint->second);
        else if (!virtual_joints_.contains(name))
            warn(element, "joint", name);
    } else if (kind == "link") {
        const std::string link = file_.text(element, "name");
        if (const auto above = joint_above_.find(link); above != joint_above_.end())
            add_joint(group, *above->second);
        else if (has_link(element, link)) // the root
            add_once(group.links, link);
    } else if (kind == "chain") {
        add_chain(group, element);
    } else if (kind == "group") {
        const auto inner = group_elements_.find(file_.text(element, "name"));
        if (inner == group_elements_.end())
            return warn(element, "group", file_.text(element, "name"));
        const GroupDescription& subgroup = made_group(inner->first, element);
        for (const std::string& joint : subgroup.joints)
            add_joint(group, *joints_.at(joint));
        for (const std::string& link : subgroup.links)
            add_once(group.links, link);
    }
}

/// Each group is made once, before the groups that contain it.
const GroupDescription& SrdfReader::made_group(const std::string& name, const XmlElement& place) {
    constexpr std::size_t most_levels = 100;
    if (const auto known = groups_.find(name); known != groups_.end())
        return known->second;
    if (std::ranges::find(open_groups_, name) != open_groups_.end())
        file_.fail(place, "the group " + io::in_quotes(name) + " contains itself");
    if (open_groups_.size() == most_levels)
        file_.fail(place, "groups are nested more than " + std::to_string(most_levels) + " times");
    open_groups_.push_back(name);
    GroupDescription group{name};
    const XmlElement& element = *group_elements_.at(name);
    for (const XmlElement* part = element.FirstChildElement(); part; part = part->NextSiblingElement())
        add_part(group, *part);
    open_groups_.pop_back();
    return groups_.emplace(name, std::move(group)).first->second;
}

void SrdfReader::add_groups() {
    const std::vector<const XmlElement*> elements = XmlFile::children(file_.root(), "group");
    for (const XmlElement* element : elements)
        if (!group_elements_.emplace(file_.text(*element, "name"), element).second)
            file_.fail(*element, "there is another group of this name");
    for (const XmlElement* element : elements)
        robot_.groups.push_back(made_group(file_.text(*element, "name"), *element));
}

StateDescription::Value SrdfReader::value_of(const XmlElement& element, const JointDescription& joint) const {
    return {joint.name, file_.numbers(element, "value", suffixes_of(joint.type).size())};
}

void SrdfReader::add_states() {
    std::set<std::pair<std::string, std::string>> names;
    for (const XmlElement* element : XmlFile::children(file_.root(), "group_state")) {
        StateDescription state{file_.text(*element, "name"), file_.optional_text(*element, "group").value_or("")};
        if (!names.emplace(state.name, state.group).second)
            file_.fail(*element, "there is another state of this name and group");
        if (!state.group.empty() && !group_elements_.contains(state.group))
            warn(*element, "group", state.group);
        for (const XmlElement* value : XmlFile::children(*element, "joint")) {
            const std::string name = file_.text(*value, "name");
            const auto joint = joints_.find(name);
            if (joint == joints_.end() && !virtual_joints_.contains(name))
                warn(*value, "joint", name);
            if (joint != joints_.end() && joint->second->type != JointType::fixed)
                state.values.push_back(value_of(*value, *joint->second));
        }
        robot_.states.push_back(std::move(state));
    }
}

/// A URDF file has the same root, and would be read as one without any pair.
void SrdfReader::refuse_urdf() const {
    for (const XmlElement* link : XmlFile::children(file_.root(), "link"))
        for (const char* const part : {"collision", "visual", "inertial"})
            if (link->FirstChildElement(part))
                file_.fail(*link, "is a link of a URDF file, and the SRDF file is needed");
    for (const XmlElement* joint : XmlFile::children(file_.root(), "joint"))
        if (joint->FirstChildElement("parent") && joint->FirstChildElement("child"))
            file_.fail(*joint, "is a joint of a URDF file, and the SRDF file is needed");
}

/// Robots of one maker have links of the same names.
void SrdfReader::warn_of_another_robot() {
    const auto name = file_.optional_text(file_.root(), "name");
    if (name && *name != robot_.name)
        robot_.warnings.push_back(file_.place_of(file_.root()) + "is the file of another robot: this one is named " +
                                  io::in_quotes(robot_.name));
}

void SrdfReader::read() {
    refuse_urdf();
    file_.require_no_misspelt_child(file_.root(),
                                    {"disable_collisions", "enable_collisions", "disable_default_collisions", "group",
                                     "group_state", "virtual_joint"});
    warn_of_another_robot();
    for (const XmlElement* joint : XmlFile::children(file_.root(), "virtual_joint"))
        if (const auto name = file_.optional_text(*joint, "name"))
            virtual_joints_.insert(*name);
    add_disabled_pairs();
    add_enabled_pairs();
    add_default_pairs();
    add_groups();
    add_states();
    add_warnings();
    warn_of_unread_parts_of_srdf(file_, robot_.warnings);
}

} // namespace

void read_srdf(const std::filesystem::path& file, RobotDescription& robot) {
    SrdfReader(file, robot).read();
}

} // namespace chasles::robot

namespace chasles {

Robot Robot::load(const std::filesystem::path& urdf, const RobotFiles& files) {
    RobotDescription description = robot::read_urdf(urdf, files);
    if (!files.srdf.empty())
        robot::read_srdf(files.srdf, description);
    return Robot(std::move(description));
}

} // namespace chasles
