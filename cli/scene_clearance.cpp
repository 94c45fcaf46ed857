#include "cli/scene_clearance.h"

#include "chasles/base/limit.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/untested_text.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/names.h"

namespace chasles::cli {
namespace {

std::string report_of(const SceneFile& file, const SceneDistance& found, bool time_was_over) {
    if (!found.pair)
        return naming_motion(found.nearest.certain
                                 ? "CLEARANCE WITHOUT A LIMIT: no two bodies are tested"
                                 : "NO CLEARANCE PROVEN: the time was over before two bodies were searched",
                             file.motion) +
               report_of_scene(found.untested, "--clearance");
    const auto& [moving, fixed] = *found.pair;
    return headline(found.nearest, file.motion, time_was_over) + report(found.untested) +
           labelled("pair", file.scene.bodies()[moving].name + " on " + file.scene.bodies()[fixed].name) +
           report_least(found.nearest, time_was_over) + report(found.nearest.work);
}

std::string json_of(const SceneFile& file, const SceneDistance& found, ExitStatus status) {
    view::Json answer = view::scene_distance_json(file.scene, found);
    if (status == is_unknown)
        answer["verdict"] = view::name_of(Verdict::unknown);
    return json_line(std::move(answer), file);
}

} // namespace

int run_scene_clearance(const SceneClearanceQuestion& question) {
    const SceneFile& file = question.file;
    const Limit limit(seconds_of(question.seconds));
    SceneDistance found = file.scene.least_distance(question.options);
    found.untested = file.scene.untested(SceneQuery()); // with names
    const bool time_was_over = !found.nearest.certain && limit.is_over();
    const ExitStatus status = status_of(found.nearest.distance, time_was_over);
    print(question.json ? json_of(file, found, status) : report_of(file, found, time_was_over));
    print_warnings(file.warnings);
    return status;
}

int run_scene_profile(const SceneProfileQuestion& question) {
    const SceneFile& file = question.file;
    ProfileRequest request(question.flags, question.tolerance);
    request.open_files();
    const Limit limit(seconds_of(question.seconds));
    SceneProfile answer = file.scene.profile(request.options());
    answer.untested = file.scene.untested(SceneQuery()); // with names
    NamedProfile found{std::move(answer.distance), {}, true};
    for (const auto& [moving, fixed] : answer.pairs)
        found.pairs.emplace_back(file.scene.bodies()[moving].name, file.scene.bodies()[fixed].name);
    request.write(found);
    const ExitStatus status = status_of(found.distance, !found.distance.certain && limit.is_over());
    if (question.json) {
        view::Json json = request.json(found, status);
        json["untested"] = view::untested_json(answer.untested);
        print(json_line(std::move(json), file));
    } else {
        print(profile_headline(found.distance, file.motion) + report_of_scene(answer.untested, "--profile") +
              request.text(found));
    }
    print_warnings(file.warnings);
    return status;
}

} // namespace chasles::cli
