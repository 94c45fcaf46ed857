// Reads scene files. Every message names the file and the body.
#include "cli/scene_file.h"

#include "chasles/base/number_text.h"
#include "chasles/io/pose_text.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"
#include "cli/motion_rule.h"
#include "cli/report.h"
#include "cli/scene_shapes.h"
#include "cli/strict_json.h"
#include "cli/warnings.h"
#include "view/names.h"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>

namespace chasles::cli {
namespace {

using Json = nlohmann::json;

constexpr std::initializer_list<const char*> body_keys = {"name",   "mesh",   "part",    "urdf",  "scale", "pose",
                                                          "goal",   "motion", "centre",  "poses", "group", "solid",
                                                          "radius", "sphere", "capsule", "points"};

[[noreturn]] void refuse(const std::string& why) {
    throw InvalidInput(why);
}

/// The members of an object, which may have no other keys than these.
class Members {
public:
    Members(const Json& object, std::initializer_list<const char*> keys) : object_(object) {
        if (!object.is_object())
            refuse("must be an object");
        for (const auto& [key, value] : object.items()) {
            if (std::ranges::find(keys, key) == keys.end())
                refuse("unknown key " + io::in_quotes(key) + "; the keys are " +
                       shortened({keys.begin(), keys.end()}, keys.size(), keys.size()));
            if (value.is_null())
                refuse(key + ": is null, which is no value; leave the key out");
        }
    }

    /// A null pointer if it is missing.
    [[nodiscard]] const Json* find(const char* key) const {
        const auto found = object_.find(key);
        return found == object_.end() ? nullptr : &*found;
    }
    [[nodiscard]] const Json& get(const char* key) const {
        const Json* value = find(key);
        if (!value)
            refuse(std::string(key) + ": is missing");
        return *value;
    }
    /// `read` of a member, if there is one.
    template <class Read>
    auto read(const char* key, const Read& read) const {
        const Json* value = find(key);
        using Value = std::optional<decltype(read(*value))>;
        return value ? at_place(key, [&] { return Value(read(*value)); }) : Value();
    }

private:
    const Json& object_;
};

std::string text_in(const Json& json) {
    if (!json.is_string())
        refuse("must be a text");
    return json.get<std::string>();
}

double number_in(const Json& json) {
    if (!json.is_number())
        refuse("must be a number");
    return json.get<double>();
}

/// What a margin may be.
double margin_in(const Json& json) {
    const double margin = number_in(json);
    if (!(margin >= 0 && margin <= Pose::largest_length))
        refuse("must be in [0, 1e30]");
    return margin;
}

double scale_in(const Json& json) {
    if (!json.is_number() || !(json.get<double>() > 0))
        refuse("must be one positive number; mirror the mesh or scale its axes in the mesh file");
    return json.get<double>();
}

const Json& list_in(const Json& json) {
    if (!json.is_array())
        refuse("must be a list");
    return json;
}

std::vector<double> numbers_in(const Json& json) {
    std::vector<double> numbers;
    for (const Json& number : list_in(json))
        numbers.push_back(number_in(number));
    return numbers;
}

Pose pose_in(const Json& json) {
    return io::pose_from_numbers(numbers_in(json));
}

Eigen::Vector3d point_in(const Json& json) {
    const std::vector<double> numbers = numbers_in(json);
    if (numbers.size() != 3)
        refuse("a point needs 3 numbers, and there are " + std::to_string(numbers.size()));
    return {numbers[0], numbers[1], numbers[2]};
}

std::pair<std::string, std::string> two_names_in(const Json& json) {
    if (list_in(json).size() != 2)
        refuse("a pair needs 2 names, and there are " + std::to_string(json.size()));
    return {text_in(json[0]), text_in(json[1])};
}

view::MotionKind kind_in(const Json& json) {
    using enum view::MotionKind;
    const std::string name = text_in(json);
    const std::optional<view::MotionKind> kind = kind_named(name);
    if (kind == screw || kind == sweep)
        refuse(name + " is the motion of one body as seen from another one; a scene takes velocity and twist");
    if (!kind)
        refuse("there is no motion " + io::in_quotes(name) + "; a scene takes velocity and twist");
    return *kind;
}

/// Poses with times from 0 to 1.
Motion track_in(const Json& json, const MotionRule& rule) {
    std::vector<double> times;
    std::vector<Pose> poses;
    for (const Json& entry : list_in(json)) {
        const std::string place = "entry " + std::to_string(times.size() + 1);
        at_place(place, [&] {
            const Members members(entry, {"t", "pose"});
            times.push_back(at_place("t", [&] { return number_in(members.get("t")); }));
            poses.push_back(at_place("pose", [&] { return pose_in(members.get("pose")); }));
        });
    }
    if (times.empty() || times.front() != 0 || times.back() != 1)
        refuse("t must run from 0 to 1, which is the time of the whole scene");
    return track_through(rule, times, poses);
}

view::MotionKind kind_of(const Members& body) {
    return body.read("motion", kind_in).value_or(view::MotionKind::velocity);
}

Motion motion_in(const Members& body) {
    MotionRule rule;
    rule.kind = kind_of(body);
    if (const auto centre = body.read("centre", point_in)) {
        if (rule.kind == view::MotionKind::twist)
            refuse("centre: a twist has none");
        rule.centre = *centre;
    }
    const auto pose = body.read("pose", pose_in);
    const auto goal = body.read("goal", pose_in);
    if (const Json* poses = body.find("poses")) {
        if (pose || goal)
            refuse("poses: stand instead of pose and goal");
        return at_place("poses", [&] { return track_in(*poses, rule); });
    }
    const Pose start = pose.value_or(Pose());
    if (goal)
        return motion_between(rule, start, *goal);
    for (const char* const member : {"motion", "centre"})
        if (body.find(member))
            refuse(std::string(member) + ": is for a body that moves; without a goal or poses it stands still");
    return Motion::at_rest(start);
}

Polyhedron capsule_in(const Json& json) {
    const std::vector<double> numbers = numbers_in(json);
    if (numbers.size() != 2)
        refuse("needs [radius, length], and there are " + std::to_string(numbers.size()));
    return make_capsule(numbers[0], numbers[1]);
}

/// Refuses members that say nothing about a body of this kind.
void require_none_of(std::initializer_list<const char*> members, const Members& body, const std::string& kind,
                     const std::string& of) {
    for (const char* member : members)
        if (member != kind && body.find(member))
            refuse(std::string(member) + ": goes with " + of + ", and the body has a " + kind);
}

/// A body has a mesh, a robot without moving joints, a sphere, a capsule or points with a radius.
Polyhedron shape_in(const Members& body, Shapes& shapes) {
    const BodyChoice choice{body.read("solid", [](const Json& json) { return solid_of(text_in(json)); }),
                            body.read("radius", number_in)};
    std::vector<std::pair<std::string, Polyhedron>> found;
    const auto look_for = [&](const char* kind, auto read) {
        if (const auto shape = body.read(kind, read))
            found.emplace_back(kind, *shape);
    };
    look_for("urdf", [&](const Json& name) { return shapes.get_urdf(text_in(name), choice); });
    look_for("sphere", [&](const Json& json) { return shapes.grown(make_sphere(number_in(json))); });
    look_for("capsule", [&](const Json& json) { return shapes.grown(capsule_in(json)); });
    look_for("points", [&](const Json& name) { return shapes.get_points(text_in(name), choice); });
    if (found.empty()) {
        if (!body.find("mesh"))
            refuse("has no shape; a body has one of mesh, urdf, sphere, capsule and points");
        const std::string mesh = at_place("mesh", [&] { return text_in(body.get("mesh")); });
        return shapes.get({mesh, body.read("part", text_in), body.read("scale", scale_in).value_or(1), choice});
    }
    const auto& [kind, shape] = found.front();
    if (found.size() > 1)
        refuse(found[1].first + ": the body has a " + kind + " already");
    require_none_of({"mesh", "part", "scale"}, body, kind, "a mesh");
    if (kind == "sphere" || kind == "capsule")
        require_none_of({"radius"}, body, kind, "a mesh, a urdf or points");
    if (kind != "urdf")
        require_none_of({"solid"}, body, kind, "a mesh or a urdf");
    return shape;
}

void add_body(Scene& scene, const Json& json, Shapes& shapes) {
    const Members body(json, body_keys);
    const std::string name = at_place("name", [&] { return text_in(body.get("name")); });
    scene.add(at_place(io::in_quotes(name), [&]() -> SceneBody {
        const Motion motion = motion_in(body);
        const std::string group = body.read("group", text_in).value_or("");
        return {name, shape_in(body, shapes), motion, group};
    }));
}

/// Calls `use` with each pair of names in a list of pairs.
template <class Use>
void for_each_pair(const Members& members, const char* key, const Use& use) {
    (void)members.read(key, [&](const Json& list) {
        for (const Json& pair : list_in(list)) {
            const auto [a, b] = two_names_in(pair);
            use(a, b);
        }
        return true;
    });
}

/// The names of the motions of all bodies that move.
std::string motion_of(const Json& bodies) {
    std::string names;
    for (const view::MotionKind kind : {view::MotionKind::velocity, view::MotionKind::twist})
        if (std::any_of(bodies.begin(), bodies.end(), [&](const Json& json) {
                const Members body(json, body_keys);
                return (body.find("goal") || body.find("poses")) && kind_of(body) == kind;
            }))
            names += (names.empty() ? "" : " and ") + std::string(view::name_of(kind));
    return names.empty() ? "rest" : names;
}

bool truth_in(const Json& json) {
    if (!json.is_boolean())
        refuse("must be true or false");
    return json.get<bool>();
}

void require_object(std::string_view text) {
    const std::string_view content = without_comments(io::without_byte_order_mark(text));
    if (!content.empty() && content.front() != '{' && content.front() != '[')
        refuse("is no scene file: that is a JSON object with \"bodies\"; scenes of MoveIt and worlds of Gazebo are not "
               "read");
}

SceneFile scene_in(const Json& json, const std::filesystem::path& folder, const PolyhedronOptions& options,
                   const std::optional<double>& margin) {
    const Members members(json, {"bodies", "ignore", "ignore_groups", "ignore_touching_at_start", "margin", "hold"});
    SceneFile file;
    const std::optional<double> own_margin = members.read("margin", margin_in);
    file.margin = margin ? *margin : own_margin.value_or(0);
    file.hold = members.read("hold", number_in);
    if (margin && file.hold && *file.hold >= *margin) {
        file.warnings.push_back("hold: " + number_text(*file.hold) + " is not less than the margin " +
                                number_text(*margin) + " of the command line, and is left out");
        file.hold.reset();
    }
    Shapes shapes(folder, options);
    std::size_t count = 0;
    for (const Json& body : at_place("bodies", [&]() -> const Json& { return list_in(members.get("bodies")); }))
        at_place("body " + std::to_string(++count), [&] { add_body(file.scene, body, shapes); });
    for (std::string& warning : shapes.warnings())
        file.warnings.push_back(std::move(warning));
    file.motion = motion_of(members.get("bodies"));
    for_each_pair(members, "ignore", [&](const auto& a, const auto& b) { file.scene.ignore(a, b); });
    for_each_pair(members, "ignore_groups", [&](const auto& a, const auto& b) {
        for (const auto& group : {a, b})
            if (std::ranges::find(file.scene.bodies(), group, &SceneBody::group) == file.scene.bodies().end())
                refuse("no body has the group " + io::in_quotes(group));
        file.scene.ignore_groups(a, b);
    });
    file.ignores_touching_at_start = members.read("ignore_touching_at_start", truth_in).value_or(false);
    if (file.ignores_touching_at_start)
        (void)file.scene.ignore_touching_at_start(file.margin);
    return file;
}

} // namespace

SceneFile load_scene(const std::filesystem::path& file, const PolyhedronOptions& options,
                     std::optional<double> margin) {
    const std::string text = io::read_file(file);
    return at_place(io::shown_name(file), [&] {
        require_object(text);
        return scene_in(parse_json(text), file.parent_path(), options, margin);
    });
}

std::string json_line(nlohmann::ordered_json answer, const SceneFile& file) {
    answer["motion"] = {{"kind", file.motion}};
    add_warnings(answer, file.warnings);
    return answer.dump() + "\n";
}

} // namespace chasles::cli
