// chasles info: what a mesh file holds, and how its surface hangs together.
#include "cli/commands.h"
#include "cli/contact_table.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/report.h"
#include "view/answer_json.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <memory>

namespace chasles::cli {
namespace {

struct InfoOptions {
    std::string mesh;
    PolyhedronOptions polyhedron;
    bool json = false;
};

Eigen::AlignedBox3d bounds_of(const Polyhedron& body) {
    Eigen::AlignedBox3d bounds;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        for (const std::uint32_t vertex : body.face(face))
            bounds.extend(body.vertices()[vertex]);
    return bounds;
}

// Children always stand behind their parent, so that one pass from front to back suffices.
std::size_t depth_of(std::span<const BoxNode> nodes) {
    std::vector<std::size_t> depths(nodes.size(), 1);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!nodes[i].is_leaf())
            depths[nodes[i].first] = depths[nodes[i].first + 1] = depths[i] + 1;
    return nodes.empty() ? 0 : *std::max_element(depths.begin(), depths.end());
}

view::Json body_json(const Polyhedron& body) {
    const MeshReport mesh = body.report();
    const Eigen::AlignedBox3d bounds = bounds_of(body);
    return {{"vertices", mesh.vertices},
            {"distinct_vertices", mesh.distinct_vertices},
            {"faces", mesh.faces},
            {"triangles", mesh.triangles},
            {"polygons", mesh.polygons},
            {"edges", mesh.edges},
            {"boundary_edges", mesh.boundary_edges},
            {"nonmanifold_edges", mesh.nonmanifold_edges},
            {"dropped_faces", mesh.dropped_faces},
            {"closed", mesh.closed},
            {"bounding_box", {{"lower", view::vector_json(bounds.min())}, {"upper", view::vector_json(bounds.max())}}},
            {"hierarchy",
             {{"nodes", body.hierarchy().nodes().size()},
              {"depth", depth_of(body.hierarchy().nodes())},
              {"bytes", body.hierarchy().memory()}}},
            {"bytes", body.memory()}};
}

std::string body_report(const std::string& name, const Polyhedron& body) {
    const MeshReport mesh = body.report();
    const Eigen::AlignedBox3d bounds = bounds_of(body);
    const auto nodes = body.hierarchy().nodes();
    std::string text = name + ": " + (mesh.closed ? "closed\n" : "open: a surface without inside\n");
    text += labelled("faces", fmt::format("{}, {} of them polygons of more than three sides; {} triangles in all",
                                          mesh.faces, mesh.polygons, mesh.triangles));
    if (mesh.dropped_faces > 0)
        text += labelled("", fmt::format("{} without area dropped", mesh.dropped_faces));
    text += labelled("vertices", fmt::format("{}, {} distinct", mesh.vertices, mesh.distinct_vertices));
    text += labelled("edges", fmt::format("{}, {} with one face, {} with more than two", mesh.edges,
                                          mesh.boundary_edges, mesh.nonmanifold_edges));
    text += labelled("box", vector_text(bounds.min()) + " to " + vector_text(bounds.max()));
    text += labelled("size", vector_text(bounds.sizes()));
    return text + labelled("hierarchy", fmt::format("{} boxes, {} deep; {} bytes with the topology", nodes.size(),
                                                    depth_of(nodes), body.memory()));
}

int run_info(const InfoOptions& options) {
    const Polyhedron body = Polyhedron::load(options.mesh, options.polyhedron);
    print(options.json ? body_json(body).dump() + "\n" : body_report(options.mesh, body));
    return is_clear;
}

} // namespace

void add_info(CLI::App& app, Task& task) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App& command = *app.add_subcommand("info", "What a mesh file holds, and how its surface hangs together.");
    command.add_option("MESH", options->mesh, "mesh file")->required()->type_name("FILE");
    add_mesh_options(command, options->polyhedron);
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_info(*options); }; });
}

} // namespace chasles::cli
