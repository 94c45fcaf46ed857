// Numbers of the answer are decimal text that reads back to the same double. Meshes and poses are base64.
#include "view/scene_json.h"

#include "view/answer_json.h"
#include "view/names.h"
#include "view/page_data.h"
#include "view/sampled_poses.h"

namespace chasles::view {
namespace {

constexpr int scene_format = 1;

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
    const bool is_alone = is_same_body(scene.moving, scene.fixed);
    if (!is_alone)
        json["meshes"].push_back(mesh_json(scene.fixed));
    const SampledPoses poses = sampled_poses(scene.motion);
    json["moving"] = {{"name", scene.moving_name}, {"mesh", 0}, {"poses", packed(poses.moving)}};
    json["fixed"] = {{"name", scene.fixed_name}, {"mesh", is_alone ? 0 : 1}, {"poses", packed(poses.fixed)}};
    json["fixed_pose"] = pose_json(scene.motion.fixed_pose_at(scene.found.time.lower));
    json["answer"] = answer_json(scene.found, scene.numbers);
    if (scene.curve)
        json["curve"] = curve_json(*scene.curve);
    return page_text(json);
}

} // namespace chasles::view
