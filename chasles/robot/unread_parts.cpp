#include "chasles/robot/unread_parts.h"

#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <map>

namespace chasles::robot {
namespace {

using Names = std::vector<std::string_view>;

/// What an element may hold. The files of the robots of `example-robot-data` and of many others were searched for it.
struct Kind {
    std::string_view name;
    Names attributes = {};           ///< that are read, or cannot change what collides
    std::vector<Kind> children = {}; ///< that are read
    Names harmless = {};             ///< children that cannot change what collides
};

/// `concave` asks PyBullet for the mesh as it is, which is what a mesh means here.
const Kind& urdf() {
    static const Kind origin{"origin", {"xyz", "rpy", "quat_xyzw"}};
    static const Kind geometry{"geometry",
                               {"name"},
                               {{"mesh", {"filename", "scale"}},
                                {"box", {"size"}},
                                {"sphere", {"radius"}},
                                {"cylinder", {"radius", "length"}},
                                {"capsule", {"radius", "length"}}}};
    static const Kind collision{"collision",
                                {"name", "concave"},
                                {origin, geometry},
                                {"material", "verbose", "surface", "contact", "drake:proximity_properties"}};
    static const Kind link{
        "link",
        {"name", "type"},
        {collision},
        {"visual", "inertial", "material", "sensor", "contact", "surface", "gravity", "kinematic", "self_filter"}};
    static const Kind joint{
        "joint",
        {"name", "type", "dont_collapse"},
        {origin,
         {"parent", {"link"}},
         {"child", {"link"}},
         {"axis", {"xyz"}},
         {"limit",
          {"lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk", "drake:acceleration",
           "command_effort", "current", "gear_velocity"}},
         {"mimic", {"joint", "multiplier", "offset"}}},
        {"calibration", "dynamics", "safety_controller", "controller_gains", "joint_properties", "traits"}};
    static const Kind robot{"robot",
                            {"name", "version"},
                            {link, joint},
                            {"material", "gazebo", "transmission", "ros2_control", "sensor", "mujoco"}};
    return robot;
}

/// A passive joint is tested where the path has it, as any other joint.
const Kind& srdf() {
    static const Kind named{"", {"name"}};
    static const Kind group{
        "group",
        {"name"},
        {{"joint", {"name"}}, {"link", {"name"}}, {"group", {"name"}}, {"chain", {"base_link", "tip_link"}}},
        {"passive_joint"}};
    static const Kind robot{"robot",
                            {"name", "version"},
                            {{"disable_collisions", {"link1", "link2", "reason"}},
                             {"enable_collisions", {"link1", "link2", "reason"}},
                             {"disable_default_collisions", {"link"}},
                             group,
                             {"group_state", {"name", "group"}, {{"joint", {"name", "value"}}}},
                             {"virtual_joint", {"name", "type", "parent_frame", "child_link"}}},
                            {"end_effector", "passive_joint", "group_tcps", "kinematics_plugin_config",
                             "contact_managers_plugin_config", "gripper", "rotor_params", "specificities"}};
    return robot;
}

bool lists(const Names& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

std::string_view without_namespace(std::string_view name) {
    return name.substr(name.find(':') + 1);
}

/// Names of XML itself, and a wish that is not made.
bool has_no_meaning(const tinyxml2::XMLAttribute& attribute) {
    const std::string_view name = attribute.Name();
    const std::string value = io::lower_case(attribute.Value());
    return name == "xmlns" || name.starts_with("xmlns:") || name.starts_with("xml:") || name.starts_with("xsi:") ||
           (without_namespace(name) == "make_convex" && (value == "false" || value == "0"));
}

/// What happens instead.
std::string consequence_of(std::string_view name) {
    static const std::map<std::string_view, std::string> consequences{
        {"make_convex", "meshes are taken as they are, without their convex hulls"},
        {"declare_convex", "the mesh is taken as it is, without its convex hull"},
        {"collision_margins", "the margins are those of the question"}};
    const auto found = consequences.find(without_namespace(name));
    return found == consequences.end() ? "" : ": " + found->second;
}

/// One line for each kind, in the order of their first places.
class UnreadParts {
public:
    explicit UnreadParts(const XmlFile& file) : file_(file) {}

    /// The parser bounds the depth.
    void look_at(const XmlFile::Element& element, const Kind& kind) {
        for (const auto* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next())
            if (!lists(kind.attributes, attribute->Name()) && !has_no_meaning(*attribute))
                add(element, kind, attribute->Name(),
                    "the attribute " + io::one_line(attribute->Name()) + " is not read");
        for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
            const auto known = std::ranges::find(kind.children, child->Name(), &Kind::name);
            if (known != kind.children.end())
                look_at(*child, *known);
            else if (!lists(kind.harmless, child->Name()))
                add(*child, kind, child->Name(),
                    kind.name == "robot" ? "is not read" : "is not read in <" + std::string(kind.name) + ">");
        }
    }

    void add_to(std::vector<std::string>& warnings) const {
        for (const Part& part : parts_)
            warnings.push_back(part.text +
                               (part.count > 1 ? "; it comes " + std::to_string(part.count) + " times" : ""));
        if (places_.size() > parts_.size())
            warnings.push_back(io::shown_name(file_.path()) + ": " + std::to_string(places_.size() - parts_.size()) +
                               " more kinds of elements and attributes are not read");
    }

private:
    struct Part {
        std::string text; ///< with the first place
        std::size_t count = 0;
    };
    static constexpr std::size_t most_lines = 20;

    void add(const XmlFile::Element& element, const Kind& kind, const std::string& name, const std::string& why) {
        const auto [known, is_new] = places_.emplace(std::string(kind.name) + ' ' + name + ' ' + why, places_.size());
        if (is_new && parts_.size() < most_lines)
            parts_.push_back({file_.place_of(element) + why + consequence_of(name)});
        if (known->second < parts_.size())
            ++parts_[known->second].count;
    }

    const XmlFile& file_;
    std::map<std::string, std::size_t> places_; ///< of each kind in the order of the file; the first ones are in parts_
    std::vector<Part> parts_;
};

void warn_of_unread_parts(const XmlFile& file, const Kind& kind, std::vector<std::string>& warnings) {
    UnreadParts parts(file);
    parts.look_at(file.root(), kind);
    parts.add_to(warnings);
}

} // namespace

void warn_of_unread_parts_of_urdf(const XmlFile& file, std::vector<std::string>& warnings) {
    warn_of_unread_parts(file, urdf(), warnings);
}

void warn_of_unread_parts_of_srdf(const XmlFile& file, std::vector<std::string>& warnings) {
    warn_of_unread_parts(file, srdf(), warnings);
}

} // namespace chasles::robot
