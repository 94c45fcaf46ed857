// Answers the questions of the tests of the JavaScript package by the native library, as the command line prints them.
//
//   chasles_native_answers [ROUNDS] < QUESTIONS > ANSWERS
//
// One JSON object a line. A line with vertices and faces is a body, counted from 0, and has no answer. With ROUNDS, the
// last line says how many seconds the fastest round over all questions about two bodies took, without JSON.
#include "chasles/base/invalid_input.h"
#include "chasles/io/pose_text.h"
#include "view/answer_json.h"

#include <cstdlib>
#include <ctime>
#include <functional>
#include <iostream>
#include <limits>

namespace chasles::test {
namespace {

using view::Json;

Pose pose_in(const Json& json) {
    return io::pose_from_numbers(json.get<std::vector<double>>());
}

Pose pose_of(const Json& json, const char* key) {
    return json.contains(key) ? pose_in(json[key]) : Pose();
}

Eigen::Vector3d centre_in(const Json& json, const char* key) {
    const auto numbers = json.value(key, std::vector<double>{0, 0, 0});
    return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

Polyhedron body_in(const Json& json) {
    std::vector<Eigen::Vector3d> vertices;
    for (const Json& vertex : json["vertices"])
        vertices.emplace_back(vertex[0], vertex[1], vertex[2]);
    return Polyhedron::from_polygons(vertices, json["faces"].get<std::vector<std::vector<std::uint32_t>>>());
}

Find find_in(const Json& json) {
    const std::string name = json.value("find", "first");
    return name == "any" ? Find::any : name == "first" ? Find::first : Find::first_with_all_contacts;
}

QueryOptions options_in(const Json& json) {
    QueryOptions options;
    options.margin = json.value("margin", 0.0);
    if (json.contains("hold"))
        options.hold = json["hold"].get<double>();
    options.find = find_in(json);
    return options;
}

view::NumberedMotion between(const Json& json, const Pose& start, const Pose& goal, const char* centre = "centre") {
    const std::string kind = json.value("motion", "screw");
    if (kind == "screw")
        return view::numbered(ScrewMotion::between(start, goal, json.value("max_turn", ScrewMotion::default_max_turn)));
    if (kind == "sweep")
        return view::numbered(SweepMotion::between(start, goal, centre_in(json, centre)));
    if (kind == "velocity")
        return view::numbered(ConstantVelocity::between(start, goal, centre_in(json, centre)));
    return view::numbered(ConstantTwist::between(start, goal));
}

view::NumberedMotion motion_in(const Json& json) {
    const Pose start = pose_in(json["start"]), goal = pose_in(json["goal"]);
    if (!json.contains("fixed_start"))
        return between(json, start, goal);
    const Pose fixed_start = pose_in(json["fixed_start"]), fixed_goal = pose_in(json["fixed_goal"]);
    const std::string kind = json.value("motion", "screw");
    if (kind == "screw")
        return view::numbered(ScrewMotion::relative(start, goal, fixed_start, fixed_goal,
                                                    json.value("max_turn", ScrewMotion::default_max_turn)));
    if (kind == "sweep")
        return view::numbered(
            SweepMotion::relative(start, goal, fixed_start, fixed_goal).about(centre_in(json, "centre")));
    const view::NumberedMotion moving = between(json, start, goal);
    return {relative(moving.motion, between(json, fixed_start, fixed_goal, "fixed_centre").motion), moving.numbers};
}

DragOptions drag_options_in(const Json& json) {
    DragOptions options;
    options.friction = json.value("friction", 0.0);
    if (!json.contains("lock"))
        return options;
    const Json& lock = json["lock"];
    const std::string kind = lock["kind"];
    options.lock.kind = kind == "hinge"      ? DragLockKind::hinge
                        : kind == "slider"   ? DragLockKind::slider
                        : kind == "cylinder" ? DragLockKind::cylinder
                                             : DragLockKind::plane;
    options.lock.direction = centre_in(lock, "direction");
    options.lock.point = centre_in(lock, "point");
    return options;
}

class Answerer {
public:
    /// Null for a body.
    Json answer(const Json& line);
    /// Asks the questions about two bodies again. Returns seconds.
    [[nodiscard]] double round() const;

private:
    const Polyhedron& body(const Json& index) const { return bodies_.at(index.get<std::size_t>()); }
    Json first_contact_json(const Json& json);
    [[nodiscard]] Json path_json(const Json& json) const;
    [[nodiscard]] Json least_distance_json(const Json& json) const;
    [[nodiscard]] Scene scene_in(const Json& json) const;
    [[nodiscard]] Json scene_json(const Json& json) const;
    [[nodiscard]] Json drag_json(const Json& json) const;

    std::vector<Polyhedron> bodies_;
    std::vector<std::function<void()>> again_;
};

Json Answerer::first_contact_json(const Json& json) {
    const Polyhedron moving = body(json["moving"]), fixed = body(json["fixed"]);
    const view::NumberedMotion motion = motion_in(json);
    const QueryOptions options = options_in(json);
    Json answer = view::answer_json(first_contact({moving, fixed, motion.motion, options}), motion.numbers);
    again_.emplace_back([moving, fixed, json, options] {
        (void)first_contact({moving, fixed, motion_in(json).motion, options});
    });
    return answer;
}

Json Answerer::path_json(const Json& json) const {
    PathQuery query{body(json["moving"]), body(json["fixed"]), {}, options_in(json)};
    std::vector<Pose> poses;
    for (const Json& pose : json["poses"])
        poses.push_back(pose_in(pose));
    for (std::size_t i = 0; i + 1 < poses.size(); ++i)
        query.motions.push_back(between(json, poses[i], poses[i + 1]).motion);
    const PathContact found = first_contact_on_path(query);
    Json answer =
        view::answer_json(found.contact, between(json, poses[found.segment], poses[found.segment + 1]).numbers);
    answer["segment"] = found.segment;
    return answer;
}

Json Answerer::least_distance_json(const Json& json) const {
    const view::NumberedMotion motion = motion_in(json);
    const LeastDistanceOptions options{.tolerance = json.value("tolerance", 1e-6), .find = find_in(json)};
    return view::answer_json(least_distance({body(json["moving"]), body(json["fixed"]), motion.motion, options}),
                             motion.numbers);
}

Scene Answerer::scene_in(const Json& json) const {
    Scene scene;
    for (const Json& entry : json["bodies"]) {
        const Pose pose = pose_of(entry, "pose");
        const bool moves = entry.contains("goal");
        const Motion motion = !moves ? Motion::at_rest(pose) : between(entry, pose, pose_in(entry["goal"])).motion;
        scene.add({entry["name"], body(entry["shape"]), motion, entry.value("group", "")});
    }
    return scene;
}

Json Answerer::scene_json(const Json& json) const {
    const Scene scene = scene_in(json);
    const SceneQuery query{.options = options_in(json), .until = json.value("until", 1.0)};
    const bool all = json.value("all", false);
    SceneAnswer answer = all ? scene.all_contacts(query) : scene.first_contact(query);
    answer.untested = scene.untested(query); // with names
    return view::scene_answer_json(scene, answer, all);
}

Json Answerer::drag_json(const Json& json) const {
    Scene scene = scene_in(json);
    DraggedBody hand(scene, json["body"], drag_options_in(json));
    Json steps = Json::array();
    for (const Json& goal : json["goals"]) {
        const DragStep step = hand.update(pose_in(goal));
        Json contacts = Json::array();
        for (const DragContact& contact : step.contacts) {
            contacts.push_back(view::contact_json(contact.contact));
            contacts.back()["force"] = contact.force;
            contacts.back()["friction"] = view::vector_json(contact.friction);
            contacts.back()["body"] = scene.bodies()[contact.body].name;
        }
        Json wrench = view::vector_json(step.force);
        for (const double component : step.torque)
            wrench.push_back(component);
        steps.push_back({{"pose", view::pose_json(step.pose)},
                         {"distance", step.distance},
                         {"contacts", contacts},
                         {"wrench", wrench},
                         {"events", step.events.size()},
                         {"pieces", step.pieces.size()}});
    }
    return steps;
}

Json Answerer::answer(const Json& line) {
    try {
        if (line.contains("vertices"))
            return bodies_.push_back(body_in(line)), Json();
        const std::string ask = line["ask"];
        return ask == "path"             ? path_json(line)
               : ask == "least_distance" ? least_distance_json(line)
               : ask == "scene"          ? scene_json(line)
               : ask == "drag"           ? drag_json(line)
                                         : first_contact_json(line);
    } catch (const InvalidInput& error) {
        return {{"error", error.what()}};
    }
}

double Answerer::round() const {
    const std::clock_t start = std::clock(); // of the processor: other programs count less
    for (const auto& ask : again_)
        ask();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

void run(int rounds) {
    Answerer answerer;
    for (std::string line; std::getline(std::cin, line);)
        if (const Json answer = answerer.answer(Json::parse(line)); !answer.is_null())
            std::cout << answer.dump() << '\n';
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < rounds; ++i)
        best = std::min(best, answerer.round());
    if (rounds > 0)
        std::cout << Json{{"seconds", best}}.dump() << '\n';
}

} // namespace
} // namespace chasles::test

int main(int argc, char** argv) {
    chasles::test::run(argc > 1 ? std::atoi(argv[1]) : 0);
}
