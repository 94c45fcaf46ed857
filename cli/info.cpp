// chasles info: the content of a mesh file and the topology of its surface, or the parts of a robot.
#include "chasles/io/mesh_files.h"
#include "chasles/io/text_scan.h"
#include "cli/commands.h"
#include "cli/contact_table.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/robot_info.h"
#include "view/answer_json.h"

#include <fmt/format.h>
#include <memory>
#include <string>
#include <vector>

namespace chasles::cli {
namespace {

struct InfoOptions {
    std::string mesh;
    PolyhedronOptions polyhedron;
    RobotOptions robot;
    bool json = false;
};

view::Json body_json(const Polyhedron& body) {
    const MeshReport mesh = body.report();
    return {{"vertices", mesh.vertices},
            {"distinct_vertices", mesh.distinct_vertices},
            {"faces", mesh.faces},
            {"triangles", mesh.triangles},
            {"polygons", mesh.polygons},
            {"edges", mesh.edges},
            {"boundary_edges", mesh.boundary_edges},
            {"nonmanifold_edges", mesh.nonmanifold_edges},
            {"dropped_faces", mesh.dropped_faces},
            {"segments", mesh.segments},
            {"closed", mesh.closed},
            {"unpaired_edges", mesh.unpaired_edges},
            {"surface_parts", mesh.parts},
            {"solid_parts", mesh.solid_parts},
            {"inward_parts", mesh.inward_parts},
            {"volume", mesh.volume},
            {"radius", mesh.radius},
            {"moved_inwards", mesh.moved_inwards},
            {"bounding_box", {{"lower", view::vector_json(mesh.lower)}, {"upper", view::vector_json(mesh.upper)}}},
            {"hierarchy", {{"nodes", mesh.bvh_nodes}, {"depth", mesh.bvh_depth}, {"bytes", mesh.bvh_bytes}}},
            {"bytes", body.memory()}};
}

// Which parts of the surface enclose a volume, and why others do not.
std::string solid_text(const MeshReport& mesh, Solid solid) {
    const std::string volume =
        fmt::format("volume {:.9g}", mesh.volume) +
        (mesh.volume < 0 ? ": more of it is turned inwards, where nothing is solid, than outwards" : "");
    const std::string why =
        fmt::format("along {} edges, faces do not run equally often in both directions", mesh.unpaired_edges);
    if (solid == Solid::no)
        return "no, as asked";
    const std::size_t closed_parts = mesh.solid_parts + mesh.inward_parts;
    if (closed_parts == 0)
        return "no: " + (mesh.unpaired_edges > 0 ? why : "no face has an area");
    const std::string inwards =
        mesh.inward_parts > 0 && mesh.parts > 1 ? fmt::format(", {} of them turned inwards", mesh.inward_parts) : "";
    if (closed_parts == mesh.parts && (mesh.solid_parts == 0 || mesh.volume >= 0))
        return (mesh.solid_parts == 0 ? "no: turned inwards, " : "yes, ") + volume +
               (mesh.closed ? "" : ", closed up to rounding") +
               (mesh.parts > 1 ? fmt::format(", {} connected parts", mesh.parts) + inwards : "");
    return fmt::format("{} of {} connected parts, {}{}", mesh.solid_parts, mesh.parts, volume,
                       closed_parts < mesh.parts ? "; " + why : "") +
           (mesh.inward_parts > 0 ? fmt::format("; {} turned inwards", mesh.inward_parts) : "");
}

std::string body_report(const std::string& name, const Polyhedron& body, Solid solid) {
    const MeshReport mesh = body.report();
    std::string text = name + ": " +
                       (mesh.closed            ? "closed\n"
                        : mesh.solid_parts > 0 ? "open\n"
                                               : "open: the surface encloses no volume\n");
    text += labelled("faces", fmt::format("{}, {} of them polygons of more than three sides; {} triangles in all",
                                          mesh.faces, mesh.polygons, mesh.triangles));
    if (mesh.dropped_faces > 0)
        text +=
            labelled("", fmt::format("{} without area dropped: edges of other faces cover them, so nothing is missing",
                                     mesh.dropped_faces));
    if (mesh.segments > 0)
        text += labelled("", fmt::format("{} of them segments without area", mesh.segments));
    text += labelled("vertices", fmt::format("{}, {} distinct", mesh.vertices, mesh.distinct_vertices));
    text += labelled("edges", fmt::format("{}, {} with one face, {} with more than two", mesh.edges,
                                          mesh.boundary_edges, mesh.nonmanifold_edges));
    text += labelled("solid", solid_text(mesh, solid));
    if (mesh.radius > 0)
        text += labelled("radius", fmt::format("{:.9g}: all points within it belong to the body", mesh.radius));
    if (mesh.moved_inwards > 0)
        text += labelled("radius", fmt::format("{:.9g}: faces have moved inwards", -mesh.moved_inwards));
    text += labelled("box", vector_text(mesh.lower) + " to " + vector_text(mesh.upper));
    text += labelled("size", vector_text(mesh.upper - mesh.lower));
    return text + labelled("hierarchy", fmt::format("{} boxes, {} deep; {} bytes with the topology", mesh.bvh_nodes,
                                                    mesh.bvh_depth, body.memory()));
}

// The parts of an assembly, in the order of the file. A file with one part is described as a body only.
struct PartSummary {
    std::string name;
    std::size_t faces;
};

view::Json parts_json(const std::vector<PartSummary>& parts) {
    view::Json list = view::Json::array();
    for (const PartSummary& part : parts)
        list.push_back({{"name", part.name}, {"faces", part.faces}});
    return list;
}

std::string parts_report(const std::vector<PartSummary>& parts) {
    std::string text = fmt::format("{}, merged into one body:", parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
        text += fmt::format("{} {} ({}{})", i == 0 ? "" : ",", io::one_line(parts[i].name), parts[i].faces,
                            i == 0 ? " faces" : "");
    return labelled("parts", text);
}

/// NAME=FILE is how other commands name a robot of a cell.
void refuse_named_robot(const std::string& given) {
    const std::size_t sign = given.find('=');
    std::error_code ignored;
    if (sign != std::string::npos && is_robot_file(given) && !std::filesystem::exists(given, ignored))
        throw InvalidInput(io::one_line(given) + ": no such file; info is about one file: ask for " +
                           io::one_line(given.substr(sign + 1)));
}

int run_info(const InfoOptions& options) {
    refuse_named_robot(options.mesh);
    if (is_robot_file(options.mesh))
        return run_robot_info({options.mesh,
                               options.robot.srdf,
                               options.robot.packages,
                               options.polyhedron.solid,
                               {options.polyhedron.radius, 0}},
                              options.json);
    if (!options.robot.srdf.empty() || !options.robot.packages.empty())
        throw InvalidInput("--srdf, --packages: are for robots, and " + io::in_quotes(options.mesh) +
                           " does not end in .urdf");
    std::vector<io::MeshPart> parts = io::load_mesh_parts(options.mesh);
    const std::string unit = parts.front().unit; // all parts of a file have the same
    std::vector<PartSummary> summaries;
    for (const io::MeshPart& part : parts)
        summaries.push_back({part.name, part.polygons.faces.size()});
    const Polyhedron body = io::body_of(options.mesh, io::merged(std::move(parts)), options.polyhedron);
    view::Json json = body_json(body);
    std::string report = body_report(options.mesh, body, options.polyhedron.solid);
    if (!unit.empty()) {
        json["unit"] = unit;
        report += labelled("unit", unit);
    }
    if (summaries.size() > 1) {
        json["parts"] = parts_json(summaries);
        report += parts_report(summaries);
    }
    print(options.json ? json.dump() + "\n" : report);
    return is_clear;
}

} // namespace

void add_info(CLI::App& app, Task& task) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App& command =
        *app.add_subcommand("info", "Describes a mesh file and the topology of its surface, or a robot.");
    command.add_option("MESH", options->mesh, "mesh file, or a robot: a URDF file")->required()->type_name("FILE");
    add_robot_file_options(command, options->robot);
    add_mesh_options(command, options->polyhedron);
    add_radius_option(command, options->polyhedron.radius);
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_info(*options); }; });
}

} // namespace chasles::cli
