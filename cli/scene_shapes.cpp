#include "cli/scene_shapes.h"

#include "chasles/io/cut_polygons.h"
#include "chasles/io/text_scan.h"
#include "chasles/robot/added_radius.h"
#include "cli/options.h"
#include "cli/report.h"
#include "view/names.h"

#include <algorithm>

namespace chasles::cli {

namespace {

/// The part of this name.
const io::MeshPart& part_named(const std::string& name, const std::vector<io::MeshPart>& parts) {
    constexpr std::size_t most_listed = 12;
    const auto found = std::ranges::find(parts, name, &io::MeshPart::name);
    if (found != parts.end())
        return *found;
    std::vector<std::string> names;
    for (const io::MeshPart& part : parts)
        names.push_back(io::in_quotes(part.name));
    throw InvalidInput("the file has no part " + io::in_quotes(name) + "; its parts are " +
                       shortened(names, most_listed, names.size()));
}

} // namespace

Polyhedron Shapes::get(const MeshChoice& choice) {
    if (const auto found = shapes_.find(choice); found != shapes_.end())
        return found->second;
    const std::filesystem::path file = folder_ / choice.file;
    return shapes_.emplace(choice, choice.part ? load_part(file, choice) : load(file, choice)).first->second;
}

Polyhedron Shapes::get_urdf(const std::string& name, const BodyChoice& body) {
    if (const auto found = robots_.find({name, body}); found != robots_.end())
        return found->second;
    const Robot robot = Robot::load(folder_ / name);
    warnings_.insert(warnings_.end(), robot.warnings().begin(), robot.warnings().end());
    std::string joints;
    for (const RobotVariable& variable : robot.variables())
        joints += (joints.empty() ? "" : ", ") + variable.name;
    if (!joints.empty())
        throw InvalidInput("the joints of " + io::in_quotes(name) + " move (" + joints +
                           "), and a body of a scene is rigid; `chasles robot` moves joints");
    return robots_.emplace(std::pair(name, body), robot.shape(robot.neutral(), options_of(body))).first->second;
}

Polyhedron Shapes::get_points(const std::string& name, const BodyChoice& body) const {
    const double radius = added_radius(body.radius.value_or(0), options_.radius);
    if (!(body.radius.value_or(radius) > 0 && radius > 0))
        throw InvalidInput("need a radius above 0 beside them, which is that of every point");
    return load_points(folder_ / name, radius);
}

Polyhedron Shapes::grown(const Polyhedron& shape) const {
    return with_added_radius(shape, options_.radius);
}

std::vector<std::string> Shapes::warnings() const {
    std::vector<std::string> all = warnings_;
    for (std::string& warning : unit_warnings(units_))
        all.push_back(std::move(warning));
    return all;
}

PolyhedronOptions Shapes::options_of(const BodyChoice& body) const {
    PolyhedronOptions options = options_;
    options.solid = body.solid.value_or(options.solid);
    options.radius = body.radius.value_or(options.radius);
    return options;
}

Polyhedron Shapes::load(const std::filesystem::path& file, const MeshChoice& choice) {
    if (choice.scale == 1) {
        MeshWithUnit mesh = load_with_unit(file, options_of(choice.body), warnings_);
        units_.push_back({file.string(), mesh.unit});
        return mesh.body;
    }
    io::PolygonSoup soup = io::load_polygons(file);
    for (Eigen::Vector3d& vertex : soup.vertices)
        vertex *= choice.scale;
    const Polyhedron body = io::body_of(file, soup, options_of(choice.body));
    io::warn_of_cut_polygons(file, soup, body, warnings_);
    return body;
}

/// The part lies where the scene of its file places it.
Polyhedron Shapes::load_part(const std::filesystem::path& file, const MeshChoice& choice) {
    const auto known = parts_.find(choice.file);
    const auto& parts =
        known != parts_.end() ? known->second : parts_.emplace(choice.file, io::load_mesh_parts(file)).first->second;
    io::MeshPart part = at_place("part", [&]() -> const io::MeshPart& { return part_named(*choice.part, parts); });
    if (choice.scale == 1)
        units_.push_back({choice.file, part.unit});
    for (Eigen::Vector3d& vertex : part.polygons.vertices)
        vertex *= choice.scale;
    const Polyhedron body = io::body_of(file, part, options_of(choice.body));
    io::warn_of_cut_polygons(file, part.polygons, body, warnings_);
    return body;
}

} // namespace chasles::cli
