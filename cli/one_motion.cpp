// One motion between two poses: its options, how they are read, and the query.
#include "cli/one_motion.h"

#include "chasles/base/invalid_input.h"
#include "cli/warnings.h"

namespace chasles::cli {
namespace {

/// The end poses of both bodies. By default the fixed body rests at the origin of the world.
struct EndPoses {
    Pose start;
    Pose goal;
    Pose fixed_start;
    Pose fixed_goal;
    bool is_fixed_moving = false;
};

EndPoses read_poses(const OneMotionOptions& options) {
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

// Screws and sweeps are motions of one body as seen from the other one. The even motions are motions in the world.
view::NumberedMotion motion_of_two(const EndPoses& poses, const MotionRule& rule, const Eigen::Vector3d& fixed_centre) {
    const auto& [start, goal, fixed_start, fixed_goal, is_fixed_moving] = poses;
    if (rule.kind == view::MotionKind::screw)
        return view::numbered(ScrewMotion::relative(start, goal, fixed_start, fixed_goal, rule.max_turn));
    if (rule.kind == view::MotionKind::sweep)
        return view::numbered(SweepMotion::relative(start, goal, fixed_start, fixed_goal).about(rule.centre));
    MotionRule fixed_rule = rule;
    fixed_rule.centre = fixed_centre;
    view::MotionNumbers numbers = numbers_between(rule, start, goal);
    numbers.is_in_world = true;
    return {relative(motion_between(rule, start, goal), motion_between(fixed_rule, fixed_start, fixed_goal)), numbers};
}

view::NumberedMotion read_motion(const OneMotionOptions& options) {
    const EndPoses poses = read_poses(options);
    const MotionRule rule = rule_of(options.motion);
    const Eigen::Vector3d fixed_centre =
        centre_of("--fixed-centre", options.fixed_centre, rule.kind, {view::MotionKind::velocity});
    if (poses.is_fixed_moving)
        return motion_of_two(poses, rule, fixed_centre);
    return {motion_between(rule, poses.start, poses.goal), numbers_between(rule, poses.start, poses.goal)};
}

void add_pose_options(CLI::App& command, OneMotionOptions& options) {
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
    command
        .add_option("--fixed-centre", options.fixed_centre,
                    "point of the fixed body that --motion velocity carries along a line")
        ->needs(fixed_start)
        ->type_name("\"X Y Z\"");
}

} // namespace

void add_motion_options(CLI::App& command, OneMotionOptions& options) {
    add_body_options(command, options.bodies);
    add_pose_options(command, options);
    add_motion_rule_options(command, options.motion);
}

void add_one_motion_options(CLI::App& command, OneMotionOptions& options) {
    add_motion_options(command, options);
    add_query_options(command, options.query);
}

// Poses and numbers are read before meshes, which may be large.
OneMotion read_one_motion(const OneMotionOptions& options) {
    const view::NumberedMotion motion = read_motion(options);
    const QueryOptions query = options_of(options.query);
    const double seconds = seconds_of(options.query.seconds);
    const Bodies bodies = load_bodies(options.bodies);
    print_warnings(bodies.warnings);
    return {motion.motion, motion.numbers, query, seconds, bodies};
}

FirstContact first_contact(const OneMotion& question) {
    const Limit limit(question.seconds);
    return chasles::first_contact({.moving = question.bodies.moving,
                                   .fixed = question.bodies.fixed,
                                   .motion = question.motion,
                                   .options = question.options});
}

} // namespace chasles::cli
