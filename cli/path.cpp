// chasles path: a sequence of screws through the poses of a file.
#include "chasles/io/motion_files.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "view/answer_json.h"

#include <fmt/format.h>
#include <memory>

namespace chasles::cli {
namespace {

struct PathOptions {
    BodyOptions bodies;
    QuestionOptions query;
    std::string poses;
    bool json = false;
};

// The JSON of `check`, with the segment that the time and the motion belong to (for a clear path, the last segment).
view::Json path_json(const PathContact& found, const view::MotionNumbers& motion) {
    view::Json answer = view::answer_json(found.contact, motion);
    answer["segment"] = found.segment;
    return answer;
}

std::string path_report(const PathContact& found, const view::MotionNumbers& motion, std::size_t poses, double margin) {
    if (found.contact.verdict == Verdict::clear)
        return headline(found.contact, margin) + labelled("path", counted(poses - 1, "segment")) +
               report(found.contact.work);
    return headline(found.contact, margin) +
           labelled("segment", fmt::format("{} of {} (from 0); the time counts from pose {} to pose {}", found.segment,
                                           poses - 1, found.segment, found.segment + 1)) +
           details(found.contact, motion, margin);
}

PathContact answer_path(const PathOptions& options, const std::vector<Pose>& poses) {
    const QueryOptions query = options_of(options.query);
    std::vector<Motion> motions = screws_along(poses, max_turn_of(options.query));
    const Bodies bodies = load_bodies(options.bodies);
    ProgressBar bar("segments", motions.size());
    return first_contact_on_path({.moving = bodies.moving,
                                  .fixed = bodies.fixed,
                                  .motions = std::move(motions),
                                  .options = query,
                                  .progress = [&](std::size_t done) { bar.show(done); }});
}

int run_path(const PathOptions& options) {
    const std::vector<Pose> poses = io::load_path(options.poses);
    const PathContact found = answer_path(options, poses);
    const view::MotionNumbers motion =
        view::numbers_of(ScrewMotion::between(poses[found.segment], poses[found.segment + 1]));
    print(options.json ? path_json(found, motion).dump() + "\n"
                       : path_report(found, motion, poses.size(), options_of(options.query).margin));
    return found.contact.verdict == Verdict::clear ? is_clear : is_contact;
}

} // namespace

void add_path(CLI::App& app, Task& task) {
    const auto options = std::make_shared<PathOptions>();
    CLI::App& command = *app.add_subcommand("path", "When do two bodies first touch on a path of many poses?");
    add_body_options(command, options->bodies);
    command.add_option("--poses", options->poses, "CSV file with the header x,y,z,qw,qx,qy,qz, one pose a row")
        ->required()
        ->type_name("FILE");
    add_query_options(command, options->query);
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_path(*options); }; });
}

} // namespace chasles::cli
