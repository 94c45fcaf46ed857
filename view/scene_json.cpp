// Numbers of the answer are decimal text that reads back to the same double. Meshes and poses are base64.
#include "view/scene_json.h"

#include "view/answer_json.h"
#include "view/base64.h"
#include "view/drawn_mesh.h"
#include "view/names.h"
#include "view/sampled_poses.h"

namespace chasles::view {
namespace {

constexpr int scene_format = 1;

template <class Rows>
std::string packed(const Rows& rows) {
    return base64(std::as_bytes(std::span(rows)));
}

Json mesh_json(const Polyhedron& body) {
    const DrawnMesh mesh = drawn_mesh(body);
    return {{"origin", vector_json(mesh.origin)},
            {"vertices", packed(mesh.vertices)},
            {"triangles", packed(mesh.triangles)},
            {"creases", packed(mesh.creases)}};
}

// If both bodies are the same one, its mesh is written once.
bool is_same_body(const Scene& scene) {
    return scene.moving.vertices().data() == scene.fixed.vertices().data();
}

// In JSON "<" occurs only inside strings, where an escape sequence may replace it. Without "<" no text can end the
// script element of the page.
std::string without_tags(const std::string& json) {
    std::string safe;
    safe.reserve(json.size());
    for (const char c : json)
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    return safe;
}

} // namespace

std::string scene_json(const Scene& scene) {
    Json json;
    json["format"] = scene_format;
    json["title"] = scene.title;
    json["margin"] = scene.margin;
    json["is_sweep"] = scene.numbers.kind == MotionKind::sweep;
    json["motion"] = name_of(scene.numbers.kind);
    json["is_in_world"] = scene.numbers.is_in_world;
    json["meshes"] = Json::array({mesh_json(scene.moving)});
    if (!is_same_body(scene))
        json["meshes"].push_back(mesh_json(scene.fixed));
    const SampledPoses poses = sampled_poses(scene.motion);
    json["moving"] = {{"name", scene.moving_name}, {"mesh", 0}, {"poses", packed(poses.moving)}};
    json["fixed"] = {{"name", scene.fixed_name}, {"mesh", is_same_body(scene) ? 0 : 1}, {"poses", packed(poses.fixed)}};
    json["fixed_pose"] = pose_json(scene.motion.fixed_pose_at(scene.found.time.lower));
    json["answer"] = answer_json(scene.found, scene.numbers);
    return without_tags(json.dump(-1, ' ', true, Json::error_handler_t::replace));
}

} // namespace chasles::view
