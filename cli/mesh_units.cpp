#include "cli/mesh_units.h"

#include "chasles/io/cut_polygons.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <fmt/format.h>

namespace chasles::cli {

MeshWithUnit load_with_unit(const std::filesystem::path& file, const PolyhedronOptions& options,
                            std::vector<std::string>& warnings) {
    std::vector<io::MeshPart> parts = io::load_mesh_parts(file);
    std::string unit = parts.front().unit; // a file states one for all its parts
    const io::PolygonSoup polygons = io::merged(std::move(parts));
    const Polyhedron body = io::body_of(file, polygons, options);
    io::warn_of_cut_polygons(file, polygons, body, warnings);
    return {body, std::move(unit)};
}

std::vector<std::string> unit_warnings(const std::vector<StatedUnit>& files) {
    const auto first = std::ranges::find_if(files, [](const StatedUnit& file) { return !file.unit.empty(); });
    const auto other = std::find_if(
        first, files.end(), [&](const StatedUnit& file) { return !file.unit.empty() && file.unit != first->unit; });
    if (other == files.end())
        return {};
    return {
        fmt::format("{} is in the unit {}, and {} in the unit {}; numbers are not converted: export both in one unit",
                    io::valid_utf8(first->file), io::in_quotes(first->unit), io::valid_utf8(other->file),
                    io::in_quotes(other->unit))};
}

} // namespace chasles::cli
