// Reads the links and joints of a URDF file. Checks of the tree are those of `Robot`.
#include "chasles/robot/urdf_reader.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/io/cut_polygons.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"
#include "chasles/motion/turn_about.h"
#include "chasles/robot/added_radius.h"
#include "chasles/robot/model.h"
#include "chasles/robot/package_paths.h"
#include "chasles/robot/primitive_shapes.h"
#include "chasles/robot/shape_attributes.h"
#include "chasles/robot/unread_parts.h"
#include "chasles/robot/xml_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace chasles::robot {
namespace {

using Eigen::Vector3d;
using XmlElement = XmlFile::Element;

class UrdfReader {
public:
    UrdfReader(const std::filesystem::path& path, const RobotFiles& files)
        : file_(path, "robot"), files_(files), shapes_(files.primitive_deviation) {}

    RobotDescription read();

private:
    [[nodiscard]] Vector3d vector(const XmlElement& element, const char* attribute) const;
    [[nodiscard]] Pose origin(const XmlElement& element) const;
    [[nodiscard]] LinkDescription link(const XmlElement& element);
    [[nodiscard]] CollisionDescription collision(const XmlElement& element);
    [[nodiscard]] Polyhedron mesh(const XmlElement& element);
    [[nodiscard]] EnclosingPolyhedron round_body(const XmlElement& element);
    [[nodiscard]] JointDescription joint(const XmlElement& element);
    void add_limits(const XmlElement& element, JointDescription& joint);
    [[nodiscard]] double limit(const XmlElement& element, const char* attribute) const;
    void mend_mimic(JointDescription& joint, const RobotDescription& robot);
    void check_version() const;
    [[nodiscard]] std::string name(const XmlElement& element, std::set<std::string>& names) const;
    [[nodiscard]] std::string link_named(const XmlElement& joint, const char* child) const;
    void check_one_root() const;
    void check_connected(const std::string& root) const;

    using MeshKey = std::pair<std::filesystem::path, std::array<double, 3>>;

    XmlFile file_;
    const RobotFiles& files_;
    std::set<std::string> links_, joints_;
    std::map<std::string, const XmlElement*> joint_elements_; ///< by name
    std::map<std::string, std::string> parents_;              ///< of each link that is the child of a joint
    std::map<MeshKey, Polyhedron> meshes_;                    ///< by file and scale
    PrimitiveShapes shapes_;
    std::vector<std::string> warnings_;
    PackageWarnings package_warnings_;
};

Vector3d UrdfReader::vector(const XmlElement& element, const char* attribute) const {
    return Vector3d(file_.numbers(element, attribute, 3).data());
}

/// `rpy` turns about the fixed axes x, y and z in this order; version 1.1 allows a quaternion x y z w in its place.
Pose UrdfReader::origin(const XmlElement& element) const {
    const XmlElement* const origin = file_.child(element, "origin");
    if (!origin)
        return {};
    file_.require_no_misspelt_attribute(*origin, {"xyz", "rpy", "quat_xyzw"});
    const Vector3d place = origin->Attribute("xyz") ? vector(*origin, "xyz") : Vector3d(Vector3d::Zero());
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    if (origin->Attribute("quat_xyzw")) {
        if (origin->Attribute("rpy"))
            file_.fail(*origin, "has both rpy and quat_xyzw");
        const std::vector<double> q = file_.numbers(*origin, "quat_xyzw", 4);
        turn = {q[3], q[0], q[1], q[2]};
    } else if (origin->Attribute("rpy")) {
        const Vector3d rpy = vector(*origin, "rpy");
        turn = turn_about(Vector3d::UnitZ(), rpy.z()) * turn_about(Vector3d::UnitY(), rpy.y()) *
               turn_about(Vector3d::UnitX(), rpy.x());
    }
    try {
        return {place, turn};
    } catch (const InvalidInput& error) {
        file_.fail(*origin, error.what());
    }
}

std::string UrdfReader::name(const XmlElement& element, std::set<std::string>& names) const {
    std::string name = file_.text(element, "name");
    if (!names.insert(name).second)
        file_.fail(element, "there is another one of this name");
    return name;
}

LinkDescription UrdfReader::link(const XmlElement& element) {
    LinkDescription link{name(element, links_)};
    file_.require_no_misspelt_child(element, {"collision"});
    for (const XmlElement* collision_element : XmlFile::children(element, "collision"))
        link.collisions.push_back(collision(*collision_element));
    return link;
}

CollisionDescription UrdfReader::collision(const XmlElement& element) {
    file_.require_no_misspelt_child(element, {"geometry", "origin"});
    const XmlElement& geometry = file_.required_child(element, "geometry");
    const std::vector<const XmlElement*> shapes = XmlFile::plain_children(geometry);
    if (shapes.empty())
        file_.fail(geometry, "has no shape");
    if (shapes.size() > 1)
        file_.fail(*shapes[1], std::string_view(shapes[1]->Name()) == "origin"
                                   ? "stands in <geometry>; write it beside <geometry>, in <collision>"
                                   : "<geometry> has another shape already; write a second <collision>");
    const XmlElement* const shape = shapes[0];
    const std::string_view kind = shape->Name();
    check_shape_attributes(file_, *shape);
    const Pose place = origin(element);
    const auto with_radius = [&](const Polyhedron& body) { return with_added_radius(body, files_.radius); };
    try {
        if (kind == "mesh")
            return {with_radius(mesh(*shape)), place};
        if (kind == "box") {
            const EnclosingPolyhedron body = PrimitiveShapes::box(vector(*shape, "size"));
            return {with_radius(body.shape), place, body.deviation};
        }
        if (kind == "cylinder" || kind == "sphere" || kind == "capsule") {
            const EnclosingPolyhedron body = round_body(*shape);
            return {with_radius(body.shape), place, body.deviation};
        }
    } catch (const XmlFault&) {
        throw;
    } catch (const InvalidInput& error) {
        const std::string why = error.what(), named = std::string(kind) + ": "; // the element names the shape already
        file_.fail(*shape, why.starts_with(named) ? why.substr(named.size()) : why);
    }
    file_.fail(*shape, "is no mesh, box, cylinder, sphere or capsule");
}

EnclosingPolyhedron UrdfReader::round_body(const XmlElement& element) {
    const std::string kind = element.Name();
    const double radius = file_.number(element, "radius"),
                 length = kind == "sphere" ? 0 : file_.number(element, "length");
    return shapes_.round_body(kind, radius, length);
}

/// A mirrored mesh has its faces the other way round.
Polyhedron UrdfReader::mesh(const XmlElement& element) {
    const FoundFile found = found_file(file_.text(element, "filename"), file_.path(), files_);
    package_warnings_.add(found, file_.place_of(element));
    file_.require_no_misspelt_attribute(element, {"scale"});
    const Vector3d scale = element.Attribute("scale") ? vector(element, "scale") : Vector3d(Vector3d::Ones());
    const MeshKey key{found.path, {scale.x(), scale.y(), scale.z()}};
    if (const auto known = meshes_.find(key); known != meshes_.end())
        return known->second;
    if (scale.prod() == 0)
        file_.fail(element, "scale: must not be zero");
    io::PolygonSoup soup = io::load_polygons(found.path);
    for (Vector3d& vertex : soup.vertices)
        vertex = vertex.cwiseProduct(scale);
    if (scale.prod() < 0)
        for (std::vector<std::uint32_t>& face : soup.faces)
            std::ranges::reverse(face);
    try {
        const Polyhedron body =
            Polyhedron::from_polygons(soup.vertices, soup.faces, {.triangulate = true, .solid = files_.solid});
        io::warn_of_cut_polygons(found.path, soup, body, warnings_);
        return meshes_.emplace(key, body).first->second;
    } catch (const InvalidInput& error) {
        io::fail_in_file(found.path, error.what());
    }
}

std::string UrdfReader::link_named(const XmlElement& joint, const char* child) const {
    const XmlElement& element = file_.required_child(joint, child);
    std::string link = file_.text(element, "link");
    if (!links_.contains(link))
        file_.fail(joint, std::string(child) + ": there is no link " + io::in_quotes(link) +
                              (link == "world" ? "; add <link name=\"world\"/>" : ""));
    return link;
}

JointDescription UrdfReader::joint(const XmlElement& element) {
    static const std::map<std::string, JointType> types{
        {"fixed", JointType::fixed},         {"revolute", JointType::revolute}, {"continuous", JointType::continuous},
        {"prismatic", JointType::prismatic}, {"planar", JointType::planar},     {"floating", JointType::floating}};
    JointDescription joint;
    file_.require_no_misspelt_child(element, {"origin", "parent", "child", "axis", "limit", "mimic"});
    const auto type = types.find(file_.text(element, "type"));
    if (type == types.end())
        file_.fail(element, "type: " + io::in_quotes(file_.text(element, "type")) +
                                " is none of fixed, revolute, continuous, prismatic, planar and floating");
    joint.type = type->second;
    joint.parent = link_named(element, "parent");
    joint.child = link_named(element, "child");
    if (!parents_.emplace(joint.child, joint.parent).second)
        file_.fail(element, "child: another joint has the link " + io::in_quotes(joint.child) + " already");
    joint.origin = origin(element);
    const bool has_axis = joint.type != JointType::fixed && joint.type != JointType::floating;
    const XmlElement* const axis = has_axis ? file_.child(element, "axis") : nullptr;
    if (axis)
        joint.axis = vector(*axis, "xyz");
    if (has_axis && joint.axis.isZero(0))
        file_.fail(element, "axis: is zero");
    add_limits(element, joint);
    const XmlElement* const mimic = file_.child(element, "mimic");
    if (mimic)
        file_.require_no_misspelt_attribute(*mimic, {"multiplier", "offset"});
    if (mimic && joint.type != JointType::fixed)
        joint.mimic = MimicDescription{file_.text(*mimic, "joint"), file_.number(*mimic, "multiplier", 1),
                                       file_.number(*mimic, "offset", 0)};
    return joint;
}

/// Limits that are left out are 0, as the format says. Some writers give infinite ones.
double UrdfReader::limit(const XmlElement& element, const char* attribute) const {
    if (!element.Attribute(attribute))
        return 0;
    const std::string given = io::lower_case(file_.text(element, attribute));
    if (const auto number = io::parse_number(given); number && given.find("inf") != std::string::npos)
        return *number;
    return file_.number(element, attribute);
}

void UrdfReader::add_limits(const XmlElement& element, JointDescription& joint) {
    const XmlElement* const given = file_.child(element, "limit");
    const bool has_ends = given && (given->Attribute("lower") || given->Attribute("upper"));
    if (has_ends && (joint.type == JointType::planar || joint.type == JointType::floating))
        warnings_.push_back(file_.place_of(element) + "limit: is not read: the joint has several variables");
    if (joint.type != JointType::revolute && joint.type != JointType::prismatic)
        return;
    if (!given)
        file_.fail(element, joint.type == JointType::revolute ? "has no <limit>; a joint without limits is continuous"
                                                              : "has no <limit>");
    file_.require_no_misspelt_attribute(*given, {"lower", "upper"});
    if (!has_ends && !file_.child(element, "mimic"))
        warnings_.push_back(file_.place_of(*given) + "has no lower and no upper: both are 0, as URDF says");
    joint.lower = limit(*given, "lower");
    joint.upper = limit(*given, "upper");
    if (joint.lower <= joint.upper)
        return;
    warnings_.push_back(file_.place_of(element) + "limit: the lower one, " + number_text(joint.lower) +
                        ", is above the upper one, " + number_text(joint.upper) + ": the joint has no limits");
    joint.lower = -std::numeric_limits<double>::infinity(); // the wrong order is a way to say that there are none
    joint.upper = std::numeric_limits<double>::infinity();
}

/// A joint that has to follow one of an unknown name is free. `Robot` checks the rest too, but has no lines.
void UrdfReader::mend_mimic(JointDescription& joint, const RobotDescription& robot) {
    const XmlElement& element = *joint_elements_.at(joint.name);
    if (joint.mimic && !joints_.contains(joint.mimic->joint)) {
        warnings_.push_back(file_.place_of(element) + "mimic: there is no joint " + io::in_quotes(joint.mimic->joint) +
                            ": the joint follows none");
        joint.mimic.reset();
    }
    if (!joint.mimic)
        return;
    if (joint.type == JointType::planar || joint.type == JointType::floating)
        file_.fail(element, "mimic: a joint with several variables cannot follow another one");
    std::set<std::string> chain{joint.name};
    for (const JointDescription* follower = &joint; follower->mimic && joints_.contains(follower->mimic->joint);) {
        follower = &*std::ranges::find(robot.joints, follower->mimic->joint, &JointDescription::name);
        if (const std::string why = why_not_followed(follower->type); !why.empty())
            file_.fail(element, "mimic: " + io::in_quotes(follower->name) + why);
        if (!chain.insert(follower->name).second)
            file_.fail(element, "mimic: follows itself");
    }
}

/// `Robot` checks this too, but has no lines.
void UrdfReader::check_one_root() const {
    const XmlElement* root = nullptr;
    for (const XmlElement* link : XmlFile::children(file_.root(), "link")) {
        if (parents_.contains(file_.text(*link, "name")))
            continue;
        if (root)
            file_.fail(*link,
                       "is the child of no joint, and neither is the link " + io::in_quotes(file_.text(*root, "name")));
        root = link;
    }
    if (!root)
        file_.fail(file_.root(), "has no root: every link is the child of a joint");
    check_connected(file_.text(*root, "name"));
}

/// Links that are not below the root are below themselves.
void UrdfReader::check_connected(const std::string& root) const {
    std::set<std::string> connected{root};
    for (const XmlElement* element : XmlFile::children(file_.root(), "link")) {
        std::set<std::string> way;
        std::string link = file_.text(*element, "name");
        for (; !connected.contains(link); link = parents_.at(link))
            if (!way.insert(link).second)
                file_.fail(*element, "is not connected with the root " + io::in_quotes(root));
        connected.merge(way);
    }
}

/// Later versions may mean other things by the same words.
void UrdfReader::check_version() const {
    static const std::set<std::string_view> known{"1", "1.0", "1.1", "1.2"};
    const auto version = file_.optional_text(file_.root(), "version");
    if (version && !known.contains(*version))
        file_.fail(file_.root(), "version: " + io::in_quotes(*version) + " is none of 1.0, 1.1 and 1.2");
}

RobotDescription UrdfReader::read() {
    check_version();
    file_.require_no_misspelt_child(file_.root(), {"link", "joint"});
    RobotDescription robot{file_.optional_text(file_.root(), "name").value_or(file_.path().stem().string())};
    for (const XmlElement* element : XmlFile::children(file_.root(), "link"))
        robot.links.push_back(link(*element));
    if (robot.links.empty())
        file_.fail(file_.root(), "has no link");
    for (const XmlElement* element : XmlFile::children(file_.root(), "joint")) {
        JointDescription made = joint(*element);
        made.name = name(*element, joints_);
        joint_elements_.emplace(made.name, element);
        robot.joints.push_back(std::move(made));
    }
    for (JointDescription& joint : robot.joints)
        mend_mimic(joint, robot);
    check_one_root();
    package_warnings_.add_to(warnings_, files_);
    warn_of_unread_parts_of_urdf(file_, warnings_);
    robot.warnings = std::move(warnings_);
    try {
        (void)Robot(robot);
    } catch (const InvalidInput& error) {
        file_.fail(file_.root(), error.what());
    }
    return robot;
}

} // namespace

RobotDescription read_urdf(const std::filesystem::path& file, const RobotFiles& files) {
    return UrdfReader(file, files).read();
}

} // namespace chasles::robot
