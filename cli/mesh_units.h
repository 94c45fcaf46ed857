// The units that mesh files state. Numbers are never converted.
#pragma once

#include "chasles/chasles.h"

#include <filesystem>
#include <string>
#include <vector>

namespace chasles::cli {

/// The body of a file, and the unit of its numbers.
struct MeshWithUnit {
    Polyhedron body;
    std::string unit; ///< as "meter" or "inch"; empty if the file states none
};

/// Warns of polygons that were cut.
MeshWithUnit load_with_unit(const std::filesystem::path& file, const PolyhedronOptions& options,
                            std::vector<std::string>& warnings);

/// What a file states.
struct StatedUnit {
    std::string file;
    std::string unit; ///< empty: none
};

/// A warning if two of the files state different units; it names the first two that do. Otherwise empty.
std::vector<std::string> unit_warnings(const std::vector<StatedUnit>& files);

} // namespace chasles::cli
