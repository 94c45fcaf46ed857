// The bodies of the benchmarks: real meshes if the data is present, otherwise generated bodies of the same size.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace chasles::bench {

/// A closed torus with bumps and outer radius 1 about z: `rings` times `sides` quadrangles, each cut into two
/// triangles.
Polyhedron bumpy_torus(std::size_t rings, std::size_t sides);

/// The faces of a body, cut into fans of triangles: three vertex indices per triangle.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const Polyhedron& body);

/// A file of the external data; empty if the file does not exist.
std::optional<std::filesystem::path> data_file(const std::string& path);

/// A body and its source.
struct NamedBody {
    std::string name;
    Polyhedron body;
};

/// The Stanford bunny (69,451 triangles), or a bumpy torus with nearly as many triangles. Prints a line if the bunny is
/// missing.
NamedBody large_body();

/// A nut on its bolt; see assembly-factory/README.md in the data. Empty, with a printed line, if the data is missing.
struct NutAndBolt {
    Polyhedron nut;
    Polyhedron bolt;
};
std::optional<NutAndBolt> m16_nut_and_bolt();

/// The small gear of assembly-factory: 20 teeth of module 1 mm about the vertical line through (0.0505, 0, 0). One
/// tooth points along x. Empty, with a printed line, if the data is missing.
std::optional<Polyhedron> small_gear();

} // namespace chasles::bench
