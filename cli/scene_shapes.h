// The shapes of the bodies of a scene file.
#pragma once

#include "chasles/io/mesh_files.h"
#include "cli/mesh_units.h"

#include <map>
#include <optional>
#include <tuple>

namespace chasles::cli {

/// What makes a body of a surface; as for all bodies where there is none.
struct BodyChoice {
    std::optional<Solid> solid = {};
    std::optional<double> radius = {};

    friend auto operator<=>(const BodyChoice&, const BodyChoice&) = default;
};

/// What a body takes from a mesh file.
struct MeshChoice {
    std::string file;
    std::optional<std::string> part; ///< all parts as one body if there is none
    double scale = 1;
    BodyChoice body = {};

    friend auto operator<=>(const MeshChoice&, const MeshChoice&) = default;
};

/// Meshes by file, part and scale, and robots that do not move, each loaded once.
class Shapes {
public:
    Shapes(std::filesystem::path folder, const PolyhedronOptions& options)
        : folder_(std::move(folder)), options_(options) {}

    Polyhedron get(const MeshChoice& choice);
    /// All links of a robot whose joints do not move, as one body.
    Polyhedron get_urdf(const std::string& name, const BodyChoice& body);
    /// The points of a file, with the radius of the body, to which that of the options is added.
    [[nodiscard]] Polyhedron get_points(const std::string& name, const BodyChoice& body) const;
    /// A sphere or a capsule with the radius of the options on top of its own.
    [[nodiscard]] Polyhedron grown(const Polyhedron& shape) const;
    /// The options of a body that is a surface: its own radius counts in the place of that of all bodies. Its scale
    /// does not change its radius.
    [[nodiscard]] PolyhedronOptions options_of(const BodyChoice& body) const;

    /// About the robots, polygons that were cut, and units that differ. A mesh with a scale counts as one without a
    /// unit.
    [[nodiscard]] std::vector<std::string> warnings() const;

private:
    Polyhedron load(const std::filesystem::path& file, const MeshChoice& choice);
    Polyhedron load_part(const std::filesystem::path& file, const MeshChoice& choice);

    std::filesystem::path folder_;
    PolyhedronOptions options_;
    std::map<std::string, std::vector<io::MeshPart>> parts_; ///< many bodies are parts of one file
    std::map<MeshChoice, Polyhedron> shapes_;
    std::map<std::pair<std::string, BodyChoice>, Polyhedron> robots_;
    std::vector<std::string> warnings_;
    std::vector<StatedUnit> units_;
};

} // namespace chasles::cli
