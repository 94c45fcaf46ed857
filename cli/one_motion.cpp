// One motion between two poses: its options, how they are read, and the query.
#include "cli/one_motion.h"

#include "chasles/base/invalid_input.h"

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

ScrewMotion screw_between(const EndPoses& poses, double max_turn) {
    return poses.is_fixed_moving
               ? ScrewMotion::relative(poses.start, poses.goal, poses.fixed_start, poses.fixed_goal, max_turn)
               : ScrewMotion::between(poses.start, poses.goal, max_turn);
}

SweepMotion sweep_between(const EndPoses& poses, const Eigen::Vector3d& centre) {
    return poses.is_fixed_moving
               ? SweepMotion::relative(poses.start, poses.goal, poses.fixed_start, poses.fixed_goal).about(centre)
               : SweepMotion::between(poses.start, poses.goal, centre);
}

struct NamedMotion {
    Motion motion;
    view::MotionNumbers numbers;
};

NamedMotion read_motion(const OneMotionOptions& options) {
    const EndPoses poses = read_poses(options);
    if (options.motion == "screw") {
        if (!options.centre.empty())
            throw InvalidInput("--centre: is for --motion sweep, but the motion is a screw");
        const ScrewMotion screw = screw_between(poses, max_turn_of(options.query));
        return {screw, view::numbers_of(screw)};
    }
    const SweepMotion sweep =
        sweep_between(poses, point_of("--centre", options.centre.empty() ? "0 0 0" : options.centre));
    return {sweep, view::numbers_of(sweep)};
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
}

} // namespace

void add_motion_options(CLI::App& command, OneMotionOptions& options) {
    add_body_options(command, options.bodies);
    add_pose_options(command, options);
    command.add_option("--motion", options.motion, "the motion between the poses: screw or sweep")
        ->check(CLI::IsMember({"screw", "sweep"}))
        ->capture_default_str();
    command.add_option("--centre", options.centre, "point of the moving body that a sweep carries along a line")
        ->type_name("\"X Y Z\"");
}

void add_one_motion_options(CLI::App& command, OneMotionOptions& options) {
    add_motion_options(command, options);
    add_query_options(command, options.query);
}

// Poses and numbers are read before meshes, which may be large.
OneMotion read_one_motion(const OneMotionOptions& options) {
    const NamedMotion motion = read_motion(options);
    const QueryOptions query = options_of(options.query);
    return {motion.motion, motion.numbers, query, load_bodies(options.bodies)};
}

FirstContact first_contact(const OneMotion& question) {
    return chasles::first_contact({.moving = question.bodies.moving,
                                   .fixed = question.bodies.fixed,
                                   .motion = question.motion,
                                   .options = question.options});
}

} // namespace chasles::cli
