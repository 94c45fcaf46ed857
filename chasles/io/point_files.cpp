#include "chasles/io/point_files.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/bytes.h"
#include "chasles/io/column_table.h"
#include "chasles/io/mesh_bytes.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"
#include "chasles/mesh/primitives.h"

#include <algorithm>
#include <array>
#include <optional>

namespace chasles {
namespace io {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};

std::vector<Vector3d> points_in(const std::filesystem::path& file, const std::string& bytes) {
    const std::string extension = lower_case(file.extension().string());
    refuse_other_content(bytes, extension);
    if (extension == ".pcd")
        return read_pcd(bytes);
    if (extension == ".ply" || extension == ".obj" || extension == ".off")
        return reader_for(extension)(bytes).vertices;
    if (extension == ".xyz" || extension == ".csv" || extension == ".txt")
        return read_point_table(bytes);
    if (extension == ".bt" || extension == ".ot")
        throw InvalidInput("is a map of cubes, not of points; it is read wherever a mesh is");
    throw InvalidInput("no reader of points for the extension " + in_quotes(extension) +
                       "; .ply, .pcd, .xyz, .csv, .txt, .obj and .off are read");
}

} // namespace

std::vector<Vector3d> read_point_table(std::string_view text) {
    constexpr std::string_view mark_of_names = "//"; // "//X Y Z", as CloudCompare writes
    if (text.starts_with(mark_of_names))
        text.remove_prefix(mark_of_names.size());
    const auto axis_of = [](std::string_view name) { return lower_case(split_unit(name).name); };
    const auto is_axis = [&](std::string_view name) { return std::ranges::find(axes, axis_of(name)) != axes.end(); };
    ColumnTable table(text, is_axis);
    std::array<std::size_t, 3> places{0, 1, 2};
    if (!table.names().empty()) {
        const std::array<std::string, 3> wanted{"x", "y", "z"};
        const NamedColumns found = find_columns(table.names(), wanted, wanted.size(), [&](std::string_view name) {
            return is_axis(name) ? axis_of(name) : std::string();
        });
        for (std::size_t axis = 0; axis < 3; ++axis)
            places[axis] = *found.places[axis];
    }
    std::vector<Vector3d> points;
    while (const auto row = table.next()) {
        if (!row->doubt.empty())
            fail_at_line(row->line, row->doubt);
        Vector3d& point = points.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t place = places[axis];
            const std::string cell = place < row->cells.size() ? row->cells[place] : std::string();
            const auto number = parse_finite(cell);
            if (!number)
                fail_at_line(row->line, "has no number " + std::string(axes[axis]) + " in column " +
                                            std::to_string(place + 1) + decimal_comma_hint(cell));
            point[Eigen::Index(axis)] = *number;
        }
    }
    return points;
}

} // namespace io

Polyhedron load_points(const std::filesystem::path& file, double radius) {
    const std::string bytes = io::read_file(file);
    try {
        return make_points(io::points_in(file, bytes), radius);
    } catch (const InvalidInput& error) {
        io::fail_in_file(file, error.what());
    }
}

} // namespace chasles
