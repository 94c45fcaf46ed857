#include "cli/robot_options.h"

#include "chasles/io/text_scan.h"
#include "cli/options.h"

namespace chasles::cli {

void add_robot_options(CLI::App& command, RobotOptions& options) {
    command.add_option("ROBOT", options.urdf, "URDF file")->required()->type_name("FILE");
    add_robot_file_options(command, options);
    add_solid_option(command, options.solid);
}

void add_robot_file_options(CLI::App& command, RobotOptions& options) {
    command.add_option("--srdf", options.srdf, "SRDF file: which links are not tested against each other")
        ->type_name("FILE");
    command
        .add_option(
            "--packages", options.packages,
            "folder of a package of package:// paths; one for each --packages, which may be given several times")
        ->type_name("NAME=FOLDER")
        ->allow_extra_args(false);
}

Robot load_robot(const RobotOptions& options) {
    RobotFiles files{.srdf = options.srdf, .solid = options.solid, .radius = options.radii.first};
    for (const std::string& given : options.packages) {
        const std::size_t sign = given.find('=');
        if (sign == 0 || sign == std::string::npos || sign + 1 == given.size())
            throw InvalidInput("--packages: " + io::in_quotes(given) + " is not of the form NAME=FOLDER");
        files.packages[given.substr(0, sign)] = given.substr(sign + 1);
    }
    return Robot::load(options.urdf, files);
}

} // namespace chasles::cli
