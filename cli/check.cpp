// chasles check: one motion between two poses.
#include "cli/commands.h"
#include "cli/json_answer.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/report.h"

#include <memory>

namespace chasles::cli {
namespace {

struct CheckOptions {
    BodyOptions bodies;
    QueryOptions query;
    std::string start;
    std::string goal;
    std::string fixed_start;
    std::string fixed_goal;
    std::string motion = "screw";
    std::string centre = "0 0 0";
    std::string hold; ///< empty: none
    bool json = false;
};

/// The end poses of both bodies; the fixed one stands at the world's origin unless told otherwise.
struct EndPoses {
    Pose start;
    Pose goal;
    Pose fixed_start;
    Pose fixed_goal;
    bool is_fixed_moving = false;
};

EndPoses read_poses(const CheckOptions& options) {
    EndPoses poses;
    poses.start = pose_of("--start", options.start);
    poses.goal = pose_of("--goal", options.goal);
    poses.is_fixed_moving = !options.fixed_start.empty();
    if (poses.is_fixed_moving) {
        poses.fixed_start = pose_of("--fixed-start", options.fixed_start);
        poses.fixed_goal = pose_of("--fixed-goal", options.fixed_goal);
    }
    return poses;
}

ScrewMotion screw_between(const EndPoses& poses) {
    return poses.is_fixed_moving ? ScrewMotion::relative(poses.start, poses.goal, poses.fixed_start, poses.fixed_goal)
                                 : ScrewMotion::between(poses.start, poses.goal);
}

SweepMotion sweep_between(const EndPoses& poses, const Eigen::Vector3d& centre) {
    return poses.is_fixed_moving
               ? SweepMotion::relative(poses.start, poses.goal, poses.fixed_start, poses.fixed_goal).about(centre)
               : SweepMotion::between(poses.start, poses.goal, centre);
}

struct NumberedMotion {
    Motion motion;
    MotionNumbers numbers;
};

NumberedMotion read_motion(const CheckOptions& options) {
    const EndPoses poses = read_poses(options);
    const ScrewMotion screw = screw_between(poses);
    if (options.motion == "screw")
        return {screw, numbers_of(screw)};
    const SweepMotion sweep = sweep_between(poses, point_of("--centre", options.centre));
    return {sweep, numbers_of(sweep, screw)};
}

int run_check(const CheckOptions& options) {
    // Poses and numbers first: they are read at once, large meshes are not.
    const NumberedMotion motion = read_motion(options);
    const double margin = margin_of(options.query);
    const auto hold = options.hold.empty() ? std::nullopt : std::optional(number_of("--hold", options.hold));
    const double time_tolerance = time_tolerance_of(options.query);
    const double max_turn = max_turn_of(options.query);
    const Bodies bodies = load_bodies(options.bodies);
    const FirstContact found = first_contact({.moving = bodies.moving,
                                              .fixed = bodies.fixed,
                                              .motion = motion.motion,
                                              .margin = margin,
                                              .hold = hold,
                                              .time_tolerance = time_tolerance,
                                              .max_turn = max_turn,
                                              .find = options.query.any ? Find::any : Find::first_with_all_contacts});
    print(options.json ? answer_json(found, motion.numbers).dump() + "\n" : report(found, motion.numbers, margin));
    return found.verdict == Verdict::clear ? is_clear : is_contact;
}

void add_pose_options(CLI::App& command, CheckOptions& options) {
    const std::string pose = "; 3, 7 or 16 numbers: x y z, x y z qw qx qy qz, or a 4x4 matrix row by row";
    command.add_option("--start", options.start, "pose of the moving body at time 0" + pose)
        ->required()
        ->type_name("POSE");
    command.add_option("--goal", options.goal, "pose of the moving body at time 1")->required()->type_name("POSE");
    auto* const fixed_start =
        command.add_option("--fixed-start", options.fixed_start, "pose of the fixed body at time 0, if it moves too")
            ->type_name("POSE");
    auto* const fixed_goal =
        command.add_option("--fixed-goal", options.fixed_goal, "pose of the fixed body at time 1")->type_name("POSE");
    fixed_start->needs(fixed_goal);
    fixed_goal->needs(fixed_start);
}

} // namespace

void add_check(CLI::App& app, Task& task) {
    const auto options = std::make_shared<CheckOptions>();
    CLI::App& command = *app.add_subcommand("check", "When do two bodies first touch on the way between two poses?");
    add_body_options(command, options->bodies);
    add_pose_options(command, *options);
    command.add_option("--motion", options->motion, "what happens between the poses: screw or sweep")
        ->check(CLI::IsMember({"screw", "sweep"}))
        ->capture_default_str();
    command.add_option("--centre", options->centre, "point of the moving body that a sweep carries along a line")
        ->type_name("\"X Y Z\"");
    add_query_options(command, options->query);
    command
        .add_option("--hold", options->hold,
                    "bodies that start within the margin go on, but never come within this distance")
        ->type_name("H");
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_check(*options); }; });
}

} // namespace chasles::cli
