// Options that several subcommands share, and their values.
#pragma once

#include "chasles/chasles.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace chasles::cli {

/// Numbers stay text until use. Chasles then parses them itself, correctly rounded and with its own messages.
struct QuestionOptions {
    std::string margin = "0";
    std::string time_tolerance = "1e-12";
    std::string hold;    ///< empty: none
    std::string seconds; ///< empty: no limit
    bool any = false;
    bool all_contacts = false;
};

struct BodyOptions {
    std::string moving;
    std::string fixed;
    PolyhedronOptions polyhedron;
    std::pair<double, double> radii; ///< of the moving and of the fixed body
};

struct Bodies {
    Polyhedron moving;
    Polyhedron fixed;
    std::vector<std::string> warnings = {}; ///< about the files
};

CLI::Option* add_seconds_option(CLI::App& command, std::string& seconds);
/// Of commands that write a page.
CLI::Option* add_curve_option(CLI::App& command, bool& wants_curve);
/// The options of every search; with those for contacts, but for --hold; and with all.
void add_search_options(CLI::App& command, QuestionOptions& options);
void add_batch_query_options(CLI::App& command, QuestionOptions& options);
void add_query_options(CLI::App& command, QuestionOptions& options);
/// automatic, yes or no.
Solid solid_of(const std::string& text);
void add_solid_option(CLI::App& command, Solid& solid);
void add_mesh_options(CLI::App& command, PolyhedronOptions& options);
/// One radius for all bodies that a file gives none, or for all shapes of a robot.
void add_radius_option(CLI::App& command, double& radius, const std::string& of_what = "a mesh");
/// The radii of two bodies, A[,B].
void add_radii_option(CLI::App& command, std::pair<double, double>& radii, const std::string& of_what);
void add_body_options(CLI::App& command, BodyOptions& options);

/// Loads both bodies. If both have the same file name, the file is loaded once.
Bodies load_bodies(const BodyOptions& options);

/// "PLACE: REASON", also of a reason that names the place already.
inline std::string placed(const std::string& place, const std::string& why) {
    return why.starts_with(place + ": ") ? why : place + ": " + why;
}

/// What `read` returns. What it throws as InvalidInput gets the place in front: "PLACE: REASON".
template <typename Read>
auto at_place(const std::string& place, const Read& read) -> decltype(read()) {
    try {
        return read();
    } catch (const InvalidInput& error) {
        throw InvalidInput(placed(place, error.what()));
    }
}

/// The number, pose or point given for an option. Throws InvalidInput "OPTION: REASON".
double number_of(const std::string& option, const std::string& text);
Pose pose_of(const std::string& option, const std::string& text);
Eigen::Vector3d point_of(const std::string& option, const std::string& text);

QueryOptions options_of(const QuestionOptions& options);
/// Infinite without a limit.
double seconds_of(const std::string& option);

} // namespace chasles::cli
