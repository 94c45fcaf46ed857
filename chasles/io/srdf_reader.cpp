// Reads pairs, groups and states of an SRDF file.
#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"
#include "chasles/io/urdf_reader.h"
#include "chasles/io/xml_file.h"

#include <algorithm>
#include <map>
#include <set>

namespace chasles::io {

namespace {

using Element = XmlFile::Element;

class SrdfReader {
public:
    SrdfReader(const std::filesystem::path& path, RobotDescription& robot) : file_(path, "robot"), robot_(robot) {
        for (const LinkDescription& link : robot_.links)
            links_.insert(link.name);
        for (const JointDescription& joint : robot_.joints) {
            joint_above_.emplace(joint.child, &joint);
            joints_.insert(joint.name);
        }
    }

    void read();

private:
    void add_pairs(const char* element, std::vector<LinkPairDescription>& pairs, bool must_exist) const;
    void add_default_pairs();
    void add_groups();
    void add_states();
    void fill(GroupDescription& group, const Element& element, std::set<std::string>& above);
    void add_chain(GroupDescription& group, const Element& element) const;
    [[nodiscard]] std::vector<std::string> links_above(std::string link) const;
    void require_link(const Element& element, const char* attribute) const;

    XmlFile file_;
    RobotDescription& robot_;
    std::set<std::string> links_, joints_;
    std::map<std::string, const JointDescription*> joint_above_; ///< of each link
    std::map<std::string, const Element*> groups_;
};

template <class Items, class Item>
void add_once(Items& items, const Item& item) {
    if (std::ranges::find(items, item) == items.end())
        items.push_back(item);
}

void SrdfReader::require_link(const Element& element, const char* attribute) const {
    if (const std::string name = file_.text(element, attribute); !links_.contains(name))
        file_.fail(element, std::string(attribute) + ": there is no link " + in_quotes(name));
}

void SrdfReader::add_pairs(const char* element, std::vector<LinkPairDescription>& pairs, bool must_exist) const {
    for (const Element* pair : XmlFile::children(file_.root(), element)) {
        const std::string first = file_.text(*pair, "link1"), second = file_.text(*pair, "link2");
        if (first == second)
            file_.fail(*pair, "names " + in_quotes(first) + " twice");
        if (must_exist) {
            require_link(*pair, "link1");
            require_link(*pair, "link2");
        }
        if (links_.contains(first) && links_.contains(second))
            pairs.push_back({first, second, pair->Attribute("reason") ? pair->Attribute("reason") : ""});
    }
}

/// A link that is not tested unless its pairs are enabled.
void SrdfReader::add_default_pairs() {
    for (const Element* element : XmlFile::children(file_.root(), "disable_default_collisions")) {
        const std::string link = file_.text(*element, "link");
        if (!links_.contains(link))
            continue;
        for (const std::string& other : links_)
            if (other != link)
                robot_.disabled_pairs.push_back({link, other, "Default"});
    }
}

/// A link and all links above it.
std::vector<std::string> SrdfReader::links_above(std::string link) const {
    std::vector<std::string> links{link};
    for (auto above = joint_above_.find(link); above != joint_above_.end(); above = joint_above_.find(links.back()))
        links.push_back(above->second->parent);
    return links;
}

/// From the base to the tip, by the lowest link that is above both.
void SrdfReader::add_chain(GroupDescription& group, const Element& element) const {
    const std::string base = file_.text(element, "base_link"), tip = file_.text(element, "tip_link");
    if (!links_.contains(base) || !links_.contains(tip))
        return;
    std::vector<std::string> from = links_above(base), to = links_above(tip);
    while (from.size() > 1 && to.size() > 1 && from[from.size() - 2] == to[to.size() - 2]) {
        from.pop_back();
        to.pop_back();
    }
    for (std::size_t i = 0; i + 1 < from.size(); ++i) {
        add_once(group.links, from[i]);
        add_once(group.joints, joint_above_.at(from[i])->name);
    }
    add_once(group.links, from.back());
    for (std::size_t i = to.size() - 1; i-- > 0;) {
        add_once(group.joints, joint_above_.at(to[i])->name);
        add_once(group.links, to[i]);
    }
}

void SrdfReader::fill(GroupDescription& group, const Element& element, std::set<std::string>& above) {
    const std::string name = file_.text(element, "name");
    if (!above.insert(name).second)
        file_.fail(element, "contains itself");
    for (const Element* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
        const std::string_view kind = child->Name();
        if (kind == "joint") {
            const std::string joint = file_.text(*child, "name"); // or a virtual joint
            if (joints_.contains(joint))
                add_once(group.joints, joint);
        } else if (kind == "link") {
            if (const std::string link = file_.text(*child, "name"); links_.contains(link))
                add_once(group.links, link);
        } else if (kind == "chain") {
            add_chain(group, *child);
        } else if (kind == "group") {
            const auto inner = groups_.find(file_.text(*child, "name"));
            if (inner != groups_.end())
                fill(group, *inner->second, above);
        }
    }
    above.erase(name);
}

void SrdfReader::add_groups() {
    const std::vector<const Element*> elements = XmlFile::children(file_.root(), "group");
    for (const Element* element : elements)
        groups_[file_.text(*element, "name")] = element;
    for (const Element* element : elements) {
        if (groups_.at(file_.text(*element, "name")) != element)
            continue; // the last one of a name counts
        GroupDescription group{file_.text(*element, "name")};
        std::set<std::string> above;
        fill(group, *element, above);
        robot_.groups.push_back(std::move(group));
    }
}

void SrdfReader::add_states() {
    for (const Element* element : XmlFile::children(file_.root(), "group_state")) {
        StateDescription state{file_.text(*element, "name"), file_.optional_text(*element, "group").value_or("")};
        for (const Element* joint : XmlFile::children(*element, "joint")) {
            const std::string name = file_.text(*joint, "name");
            if (!joints_.contains(name))
                continue; // a virtual joint, or one of another variant of the robot
            StateDescription::Value value{name, {}};
            const std::string text = file_.text(*joint, "value");
            Words words(text);
            for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
                const std::optional<double> number = parse_finite(word);
                if (!number)
                    file_.fail(*joint, "value: " + in_quotes(word) + " is not a finite number");
                value.values.push_back(*number);
            }
            state.values.push_back(std::move(value));
        }
        robot_.states.push_back(std::move(state));
    }
}

void SrdfReader::read() {
    add_default_pairs();
    add_pairs("disable_collisions", robot_.disabled_pairs, false);
    add_pairs("enable_collisions", robot_.enabled_pairs, true);
    add_groups();
    add_states();
}

} // namespace

void read_srdf(const std::filesystem::path& file, RobotDescription& robot) {
    SrdfReader(file, robot).read();
}

} // namespace chasles::io
