// Shared options: their declaration, and the conversion of their text to numbers, poses and bodies.
#include "cli/options.h"

#include "chasles/io/pose_text.h"
#include "chasles/io/text_scan.h"
#include "cli/mesh_units.h"

#include <limits>

namespace chasles::cli {

CLI::Option* add_seconds_option(CLI::App& command, std::string& seconds) {
    return command
        .add_option("--seconds", seconds, "answer after this time at the latest, with what is proven until then")
        ->type_name("T");
}

CLI::Option* add_curve_option(CLI::App& command, bool& wants_curve) {
    return command.add_flag("--curve", wants_curve, "show the distance over time on the page, below the slider");
}

void add_search_options(CLI::App& command, QuestionOptions& options) {
    add_seconds_option(command, options.seconds);
    command.add_option("--time-tolerance", options.time_tolerance, "aimed width of the bracket around the time")
        ->type_name("T")
        ->capture_default_str();
}

void add_batch_query_options(CLI::App& command, QuestionOptions& options) {
    command.add_option("--margin", options.margin, "distance of the surfaces that counts as contact")
        ->type_name("D")
        ->capture_default_str();
    add_search_options(command, options);
    command.add_flag("--any", options.any, "stop at any contact, which need not be the first one");
}

void add_query_options(CLI::App& command, QuestionOptions& options) {
    add_batch_query_options(command, options);
    command.add_flag("--all-contacts", options.all_contacts, "list every contact at the time of the first one")
        ->excludes("--any");
    command
        .add_option("--hold", options.hold,
                    "bodies that start within the margin may move on, but never come within this distance")
        ->type_name("H");
}

Solid solid_of(const std::string& text) {
    if (text == "automatic")
        return Solid::automatic;
    if (text == "yes" || text == "no")
        return text == "yes" ? Solid::yes : Solid::no;
    throw InvalidInput("must be automatic, yes or no, and is " + io::in_quotes(text));
}

void add_solid_option(CLI::App& command, Solid& solid) {
    command
        .add_option_function<std::string>(
            "--solid",
            [&solid](const std::string& text) { solid = at_place("--solid", [&] { return solid_of(text); }); },
            "whether the inside of a closed mesh belongs to the body (default automatic)")
        ->type_name("automatic|yes|no");
}

void add_mesh_options(CLI::App& command, PolyhedronOptions& options) {
    command.add_flag("--triangulate", options.triangulate,
                     "cut polygons that are not planar, cross themselves or turn back into triangles");
    add_solid_option(command, options.solid);
}

void add_radius_option(CLI::App& command, double& radius, const std::string& of_what) {
    command
        .add_option_function<std::string>(
            "--radius", [&radius](const std::string& text) { radius = number_of("--radius", text); },
            "all points within this distance of " + of_what +
                " belong to it, on top of a radius of its own; below 0: faces move inwards and round shapes shrink by "
                "so much, an overlap that is allowed (default 0)")
        ->type_name("R");
}

void add_radii_option(CLI::App& command, std::pair<double, double>& radii, const std::string& of_what) {
    const auto read = [&radii](const std::string& text) {
        const std::vector<double> numbers = at_place("--radius", [&] { return io::parse_numbers(text); });
        if (numbers.empty() || numbers.size() > 2)
            throw InvalidInput("--radius: needs one or two numbers, A or A,B");
        radii = {numbers[0], numbers.size() == 2 ? numbers[1] : 0};
    };
    command
        .add_option_function<std::string>(
            "--radius", read,
            "radii of " + of_what +
                ": all points within this distance belong to it, on top of a radius of its "
                "own; below 0: faces move inwards and round shapes shrink by so much, an "
                "overlap that is allowed (default 0)")
        ->type_name("A[,B]");
}

void add_body_options(CLI::App& command, BodyOptions& options) {
    command.add_option("MOVING", options.moving, "mesh of the moving body")->required()->type_name("FILE");
    command.add_option("FIXED", options.fixed, "mesh of the fixed body")->required()->type_name("FILE");
    add_mesh_options(command, options.polyhedron);
    add_radii_option(command, options.radii, "the moving and of the fixed body");
}

Bodies load_bodies(const BodyOptions& options) {
    std::vector<std::string> warnings;
    const auto [of_moving, of_fixed] = options.radii;
    PolyhedronOptions polyhedron = options.polyhedron;
    polyhedron.radius = of_moving;
    const MeshWithUnit moving = load_with_unit(options.moving, polyhedron, warnings);
    if (options.fixed == options.moving && of_fixed == of_moving)
        return {moving.body, moving.body, warnings};
    polyhedron.radius = of_fixed;
    const MeshWithUnit fixed = load_with_unit(options.fixed, polyhedron, warnings);
    for (std::string& warning : unit_warnings({{options.moving, moving.unit}, {options.fixed, fixed.unit}}))
        warnings.push_back(std::move(warning));
    return {moving.body, fixed.body, warnings};
}

double number_of(const std::string& option, const std::string& text) {
    const std::vector<double> numbers = at_place(option, [&] { return io::parse_numbers(text); });
    if (numbers.size() != 1)
        throw InvalidInput(option + ": needs one number");
    return numbers.front();
}

Pose pose_of(const std::string& option, const std::string& text) {
    return at_place(option, [&] { return io::parse_pose(text); });
}

Eigen::Vector3d point_of(const std::string& option, const std::string& text) {
    return at_place(option, [&] { return io::parse_point(text); });
}

QueryOptions options_of(const QuestionOptions& options) {
    return {.margin = number_of("--margin", options.margin),
            .hold = options.hold.empty() ? std::nullopt : std::optional(number_of("--hold", options.hold)),
            .time_tolerance = number_of("--time-tolerance", options.time_tolerance),
            .find = options.any            ? Find::any
                    : options.all_contacts ? Find::first_with_all_contacts
                                           : Find::first};
}

double seconds_of(const std::string& option) {
    if (option.empty())
        return std::numeric_limits<double>::infinity();
    const double seconds = number_of("--seconds", option);
    if (!(seconds > 0))
        throw InvalidInput("--seconds: must be positive");
    return seconds;
}

} // namespace chasles::cli
