#include "view/curve.h"

#include "view/page_data.h"

namespace chasles::view {

Curve curve_of(DistanceProfile distance, double margin) {
    Curve curve{std::move(distance), {}, {}};
    if (margin > 0)
        curve.margins.push_back(margin);
    return curve;
}

Curve curve_of(const chasles::Scene& scene, double margin) {
    SceneProfile found = scene.profile();
    Curve curve = curve_of(std::move(found.distance), margin);
    for (const auto& [moving, fixed] : found.pairs)
        curve.pairs.emplace_back(scene.bodies()[moving].name, scene.bodies()[fixed].name);
    return curve;
}

Curve curve_of(const RobotChecker& checker, const JointPath& path, double margin, std::span<const Handover> handovers) {
    RobotProfile found = checker.profile(path, {}, handovers);
    Curve curve = curve_of(std::move(found.distance), margin);
    for (const RobotPair& pair : found.pairs)
        curve.pairs.emplace_back(pair.first, pair.second);
    return curve;
}

Json curve_json(const Curve& curve) {
    const DistanceProfile& distance = curve.distance;
    Json json = {{"times", packed(distance.times)}, {"lower", packed(distance.lower)},
                 {"upper", packed(distance.upper)}, {"nearest", distance.nearest},
                 {"pairs", Json::array()},          {"margins", curve.margins}};
    for (const auto& [first, second] : curve.pairs)
        json["pairs"].push_back({first, second});
    return json;
}

} // namespace chasles::view
