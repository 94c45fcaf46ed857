#include "cli/page_curve.h"

namespace chasles::cli {

void add_curve_option(CLI::App& command, bool& wants_curve, CLI::Option* page) {
    CLI::Option* const curve =
        command.add_flag("--curve", wants_curve, "show the distance over time on the page, below the slider");
    if (page)
        curve->needs(page);
}

view::Curve curve_of(DistanceProfile distance, double margin) {
    view::Curve curve{std::move(distance), {}, {}};
    if (margin > 0)
        curve.margins.push_back(margin);
    return curve;
}

view::Curve curve_of(const Scene& scene, double margin) {
    SceneProfile found = scene.profile();
    view::Curve curve = curve_of(std::move(found.distance), margin);
    for (const auto& [moving, fixed] : found.pairs)
        curve.pairs.emplace_back(scene.bodies()[moving].name, scene.bodies()[fixed].name);
    return curve;
}

view::Curve curve_of(const RobotChecker& checker, const JointPath& path, double margin) {
    RobotProfile found = checker.profile(path);
    view::Curve curve = curve_of(std::move(found.distance), margin);
    for (const RobotPair& pair : found.pairs)
        curve.pairs.emplace_back(pair.first, pair.second);
    return curve;
}

} // namespace chasles::cli
