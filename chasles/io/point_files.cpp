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

/// What the header of a PCD file says.
struct PcdHeader {
    struct Field {
        std::string name;
        std::size_t size = 4;
        char type = 'F';
        std::size_t count = 1;
        std::size_t offset = 0; ///< in a point, bytes
        std::size_t column = 0; ///< in a line of numbers
    };
    std::vector<Field> fields;
    std::size_t points = 0;
    std::string data;
    std::size_t end = 0;  ///< of the header, bytes
    std::size_t line = 0; ///< of DATA

    [[nodiscard]] const Field& field(std::string_view name) const {
        const auto found = std::ranges::find(fields, name, &Field::name);
        if (found == fields.end())
            throw InvalidInput("there is no field " + std::string(name));
        if (found->type != 'F' || (found->size != 4 && found->size != 8) || found->count != 1)
            throw InvalidInput("the field " + std::string(name) + " is no number of 4 or 8 bytes");
        return *found;
    }
    [[nodiscard]] std::size_t point_size() const {
        return fields.empty() ? 0 : fields.back().offset + fields.back().size * fields.back().count;
    }
    void place_fields() {
        std::size_t offset = 0, column = 0;
        for (Field& field : fields) {
            field.offset = offset;
            field.column = column;
            offset += field.size * field.count;
            column += field.count;
        }
    }
};

std::size_t count_in(std::string_view word, std::size_t line) {
    constexpr std::int64_t most = 1'000'000'000;
    const auto number = parse_integer(word);
    if (!number || *number < 0 || *number > most)
        fail_at_line(line, in_quotes(word) + " is no count");
    return std::size_t(*number);
}

PcdHeader read_pcd_header(std::string_view bytes) {
    PcdHeader header;
    Lines lines(bytes);
    while (header.data.empty()) {
        if (!lines.next())
            throw InvalidInput("ends before DATA");
        const std::vector<std::string> words = split_cells(lines.line(), Separator::blanks);
        if (words.empty() || words[0].empty() || words[0][0] == '#')
            continue;
        const std::size_t values = words.size() - 1;
        const auto for_each_field = [&](auto set) {
            if (values != header.fields.size())
                fail_at_line(lines.number(), words[0] + " has another number of values than FIELDS");
            for (std::size_t i = 0; i < values; ++i)
                set(header.fields[i], words[i + 1]);
        };
        if (words[0] == "FIELDS" && header.fields.empty())
            for (std::size_t i = 0; i < values; ++i)
                header.fields.push_back({words[i + 1]});
        else if (words[0] == "SIZE")
            for_each_field([&](auto& field, const std::string& word) {
                field.size = count_in(word, lines.number());
                if (field.size != 1 && field.size != 2 && field.size != 4 && field.size != 8)
                    fail_at_line(lines.number(), "a number has 1, 2, 4 or 8 bytes, not " + word);
            });
        else if (words[0] == "TYPE")
            for_each_field([&](auto& field, const std::string& word) { field.type = word[0]; });
        else if (words[0] == "COUNT")
            for_each_field([&](auto& field, const std::string& word) { field.count = count_in(word, lines.number()); });
        else if (words[0] == "POINTS" && values == 1)
            header.points = count_in(words[1], lines.number());
        else if (words[0] == "DATA" && values == 1)
            header.data = words[1];
    }
    header.end = lines.position();
    header.line = lines.number();
    header.place_fields();
    return header;
}

std::vector<Vector3d> read_binary_points(std::string_view bytes, const PcdHeader& header) {
    const std::string_view data = bytes.substr(std::min(header.end, bytes.size()));
    const std::size_t size = header.point_size();
    if (size == 0 || data.size() / size < header.points)
        throw InvalidInput("ends after " + std::to_string(size == 0 ? 0 : data.size() / size) + " of " +
                           std::to_string(header.points) + " points");
    std::vector<Vector3d> points(header.points);
    for (int axis = 0; axis < 3; ++axis) {
        const PcdHeader::Field& field = header.field(axes[std::size_t(axis)]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::string_view number = data.substr(i * size + field.offset);
            points[i][axis] = field.size == 4 ? double(load<float>(number, std::endian::little))
                                              : load<double>(number, std::endian::little);
        }
    }
    return points;
}

std::vector<Vector3d> read_ascii_points(std::string_view bytes, const PcdHeader& header) {
    std::vector<Vector3d> points;
    Lines lines(bytes.substr(std::min(header.end, bytes.size())));
    while (points.size() < header.points && lines.next()) {
        const std::vector<std::string> cells = split_cells(lines.line(), Separator::blanks);
        Vector3d point;
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t column = header.field(axes[std::size_t(axis)]).column;
            const auto number = column < cells.size() ? parse_number(cells[column]) : std::nullopt;
            if (!number)
                fail_at_line(header.line + lines.number(), "has no number " + std::string(axes[std::size_t(axis)]));
            point[axis] = *number;
        }
        points.push_back(point);
    }
    if (points.size() < header.points)
        throw InvalidInput("ends after " + std::to_string(points.size()) + " of " + std::to_string(header.points) +
                           " points");
    return points;
}

std::vector<Vector3d> points_in(const std::filesystem::path& file, const std::string& bytes) {
    const std::string extension = lower_case(file.extension().string());
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

std::vector<Vector3d> read_pcd(std::string_view bytes) {
    const PcdHeader header = read_pcd_header(bytes);
    if (header.data != "binary" && header.data != "ascii")
        throw InvalidInput("DATA " + one_line(header.data) +
                           " is not read; write the cloud as binary or ascii (pcl_convert_pcd_ascii_binary)");
    std::vector<Vector3d> points =
        header.data == "binary" ? read_binary_points(bytes, header) : read_ascii_points(bytes, header);
    std::erase_if(points, [](const Vector3d& point) { return !point.allFinite(); });
    return points;
}

std::vector<Vector3d> read_point_table(std::string_view text) {
    const auto is_axis = [](std::string_view name) { return std::ranges::find(axes, lower_case(name)) != axes.end(); };
    ColumnTable table(text, is_axis);
    std::array<std::size_t, 3> places{0, 1, 2};
    if (!table.names().empty()) {
        const std::array<std::string, 3> wanted{"x", "y", "z"};
        const NamedColumns found = find_columns(table.names(), wanted, wanted.size(), [&](std::string_view name) {
            return is_axis(name) ? lower_case(name) : std::string();
        });
        for (std::size_t axis = 0; axis < 3; ++axis)
            places[axis] = *found.places[axis];
    }
    std::vector<Vector3d> points;
    while (const auto row = table.next()) {
        Vector3d& point = points.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t place = places[axis];
            const auto number = place < row->cells.size() ? parse_finite(row->cells[place]) : std::nullopt;
            if (!number)
                fail_at_line(row->line,
                             "has no number " + std::string(axes[axis]) + " in column " + std::to_string(place + 1));
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
