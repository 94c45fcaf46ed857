// The bodies that the queries are timed on: real meshes where the data is, generated ones of the same size where not.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace chasles::bench {

/// A torus with bumps, closed, of outer radius 1 about z; `rings` times `sides` quadrangles, each cut in two.
Polyhedron bumpy_torus(std::size_t rings, std::size_t sides);

/// Its faces, cut into fans: three vertex indices each.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const Polyhedron& body);

/// A file of the data from outside the project; empty if it is not there.
std::optional<std::filesystem::path> data_file(const std::string& path);

/// A body and where it comes from.
struct NamedBody {
    std::string name;
    Polyhedron body;
};

/// The Stanford bunny, 69,451 triangles, or a bumpy torus of as many. Says what is skipped on standard output.
NamedBody large_body();

/// A nut on its bolt; see assembly-factory/README.md in the data. Empty, and said on standard output, if not there.
struct NutAndBolt {
    Polyhedron nut;
    Polyhedron bolt;
};
std::optional<NutAndBolt> m16_nut_and_bolt();

/// The small gear of assembly-factory: 20 teeth of module 1 mm about the upright through (0.0505, 0, 0), a tooth along
/// x. Empty, and said on standard output, if not there.
std::optional<Polyhedron> small_gear();

} // namespace chasles::bench
