// The question of chasles robot: the robot, the world and the path, as options and files name them.
#pragma once

#include "chasles/robot/joint_path_file.h"
#include "cli/certificate_file.h"
#include "cli/options.h"
#include "cli/profile_report.h"
#include "cli/robot_changes.h"
#include "cli/robot_options.h"
#include "cli/scene_file.h"

#include <optional>
#include <string>
#include <vector>

namespace chasles::cli {

struct RobotCommand {
    RobotOptions robot;
    RobotChangeOptions changes;
    std::vector<std::string> paths;     ///< FILE, or NAME=FILE for each of several robots
    std::vector<std::string> handovers; ///< TIME,PART,LINK and more links that may touch the part
    std::string scene;
    std::string page;
    CertificateOptions certificate;
    QuestionOptions query;
    bool finds_clearance = false;
    bool finds_profile = false;
    bool wants_curve = false; ///< on the page
    std::string tolerance;    ///< of the clearance or the profile; empty: that of the library
    ProfileFlags profile;
    bool json = false;
};

struct RobotQuestion {
    Robot robot;
    JointPath path;
    bool has_stamps;
    std::vector<Handover> handovers;
    std::optional<SceneFile> scene;
    QueryOptions options;
    std::vector<std::string> warnings;

    [[nodiscard]] const Scene* world() const { return scene ? &scene->scene : nullptr; }
};

/// The world. Its bodies are not tested against each other, and what a robot touches at the start is a contact.
std::optional<SceneFile> read_scene(const RobotCommand& options);
/// Margin and hold distance of the scene's file stand where the command line has none.
QueryOptions query_of(const RobotCommand& options, const std::optional<SceneFile>& scene);
/// The robot, with what the command line changes of it.
Robot read_robot(const RobotCommand& options, const std::optional<SceneFile>& scene,
                 std::vector<std::string>& warnings);

/// Reads all files. What is wrong with an option is refused first.
RobotQuestion read_question(const RobotCommand& options);

} // namespace chasles::cli
