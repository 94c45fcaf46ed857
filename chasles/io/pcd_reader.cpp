// Reads PCD files: a header of lines, then points as text or as bytes. Source: the PCD file format 0.7 of the Point
// Cloud Library.
#include "chasles/base/invalid_input.h"
#include "chasles/io/bytes.h"
#include "chasles/io/csv_table.h"
#include "chasles/io/point_files.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace chasles::io {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::string_view, 3> coordinates{"x", "y", "z"};

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
    std::optional<std::size_t> width, height, given_points;
    std::size_t points = 0;
    std::string data;
    std::size_t end = 0;  ///< of the header, bytes
    std::size_t line = 0; ///< of DATA

    [[nodiscard]] const Field& field(std::string_view name) const {
        const auto found = std::ranges::find(fields, name, &Field::name);
        if (found == fields.end())
            throw InvalidInput("there is no field " + std::string(name));
        if (found->type != 'F' || (found->size != 4 && found->size != 8) || found->count != 1)
            throw InvalidInput("the field " + std::string(name) + " needs the TYPE F, the SIZE 4 or 8 and the COUNT 1");
        return *found;
    }
    [[nodiscard]] std::size_t point_size() const {
        return fields.empty() ? 0 : fields.back().offset + fields.back().size * fields.back().count;
    }
    [[nodiscard]] std::size_t columns() const {
        return fields.empty() ? 0 : fields.back().column + fields.back().count;
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
    /// By POINTS, or by WIDTH and HEIGHT, which must agree with it.
    void count_points() {
        const auto of_image = width ? std::optional(*width * height.value_or(1)) : std::nullopt;
        if (!given_points && !of_image)
            throw InvalidInput("has no line POINTS, and no line WIDTH");
        if (given_points && of_image && *given_points != *of_image)
            throw InvalidInput("WIDTH times HEIGHT is " + std::to_string(*of_image) + ", but POINTS is " +
                               std::to_string(*given_points));
        points = given_points.value_or(of_image.value_or(0));
    }
    [[noreturn]] void fail_by_more_points() const {
        throw InvalidInput("has more points than its header says (" + std::to_string(points) + ")");
    }
};

std::size_t count_in(std::string_view word, std::size_t line) {
    constexpr std::int64_t most = 1'000'000'000;
    const auto number = parse_integer(word);
    if (!number || *number < 0 || *number > most)
        fail_at_line(line, in_quotes(word) + " is no count");
    return std::size_t(*number);
}

/// Reads the lines of the header.
class PcdHeaderReader {
public:
    explicit PcdHeaderReader(std::string_view bytes) : lines_(bytes) {}

    PcdHeader read() {
        while (header_.data.empty()) {
            if (!lines_.next())
                throw InvalidInput("ends before DATA");
            words_ = split_cells(lines_.line(), Separator::blanks);
            if (!words_.empty() && !words_[0].empty() && words_[0][0] != '#')
                read_line();
        }
        header_.end = lines_.position();
        header_.line = lines_.number();
        header_.place_fields();
        header_.count_points();
        return std::move(header_);
    }

private:
    void read_line() {
        const std::string& key = words_[0];
        if (key == "FIELDS" && header_.fields.empty())
            for (std::size_t i = 1; i < words_.size(); ++i)
                header_.fields.push_back({words_[i]});
        else if (key == "SIZE")
            for_each_field([&](auto& field, const std::string& word) {
                field.size = count(word);
                if (field.size != 1 && field.size != 2 && field.size != 4 && field.size != 8)
                    fail_at_line(lines_.number(), "a number has 1, 2, 4 or 8 bytes, not " + word);
            });
        else if (key == "TYPE")
            for_each_field([](auto& field, const std::string& word) { field.type = word[0]; });
        else if (key == "COUNT")
            for_each_field([&](auto& field, const std::string& word) { field.count = count(word); });
        else if (words_.size() == 2)
            read_number_or_data();
    }
    void read_number_or_data() {
        if (words_[0] == "POINTS")
            header_.given_points = count(words_[1]);
        else if (words_[0] == "WIDTH")
            header_.width = count(words_[1]);
        else if (words_[0] == "HEIGHT")
            header_.height = count(words_[1]);
        else if (words_[0] == "DATA")
            header_.data = words_[1];
    }
    template <class Set>
    void for_each_field(const Set& set) {
        if (header_.fields.empty())
            fail_at_line(lines_.number(), "there is no line FIELDS before " + words_[0]);
        if (words_.size() != header_.fields.size() + 1)
            fail_at_line(lines_.number(), words_[0] + " has another number of values than FIELDS");
        for (std::size_t i = 0; i < header_.fields.size(); ++i)
            set(header_.fields[i], words_[i + 1]);
    }
    [[nodiscard]] std::size_t count(std::string_view word) const { return count_in(word, lines_.number()); }

    Lines lines_;
    std::vector<std::string> words_; ///< of the current line
    PcdHeader header_;
};

std::vector<Vector3d> read_binary_points(std::string_view bytes, const PcdHeader& header) {
    const std::string_view data = bytes.substr(std::min(header.end, bytes.size()));
    const std::size_t size = header.point_size();
    if (size == 0 || data.size() / size < header.points)
        throw InvalidInput("ends after " + std::to_string(size == 0 ? 0 : data.size() / size) + " of " +
                           std::to_string(header.points) + " points");
    if (data.size() / size > header.points)
        header.fail_by_more_points();
    std::vector<Vector3d> points(header.points);
    for (int axis = 0; axis < 3; ++axis) {
        const PcdHeader::Field& field = header.field(coordinates[std::size_t(axis)]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::string_view number = data.substr(i * size + field.offset);
            points[i][axis] = field.size == 4 ? double(load<float>(number, std::endian::little))
                                              : load<double>(number, std::endian::little);
        }
    }
    return points;
}

/// "nan" stands for what a camera did not see; a number that is too large is a fault.
double coordinate_in(const std::string& cell, std::string_view axis, std::size_t line) {
    const auto number = parse_number(cell);
    const bool is_too_large = number && std::isinf(*number) && cell.find_first_of("0123456789") != std::string::npos;
    if (!number || is_too_large)
        fail_at_line(line, "has no number " + std::string(axis) + ": " + in_quotes(cell) + decimal_comma_hint(cell));
    return *number;
}

std::vector<Vector3d> read_ascii_points(std::string_view bytes, const PcdHeader& header) {
    std::vector<Vector3d> points;
    Lines lines(bytes.substr(std::min(header.end, bytes.size())));
    while (lines.next()) {
        const std::vector<std::string> cells = split_cells(lines.line(), Separator::blanks);
        if (cells.empty() || (cells.size() == 1 && cells[0].empty()))
            continue;
        if (points.size() == header.points)
            header.fail_by_more_points();
        const std::size_t line = header.line + lines.number();
        if (cells.size() != header.columns())
            fail_at_line(line, "has " + std::to_string(cells.size()) + " numbers, and its fields have " +
                                   std::to_string(header.columns()));
        Vector3d& point = points.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis)
            point[Eigen::Index(axis)] =
                coordinate_in(cells[header.field(coordinates[axis]).column], coordinates[axis], line);
    }
    if (points.size() < header.points)
        throw InvalidInput("ends after " + std::to_string(points.size()) + " of " + std::to_string(header.points) +
                           " points");
    return points;
}

} // namespace

std::vector<Vector3d> read_pcd(std::string_view bytes) {
    const PcdHeader header = PcdHeaderReader(bytes).read();
    if (header.data != "binary" && header.data != "ascii")
        throw InvalidInput("DATA " + one_line(header.data) +
                           " is not read; write the cloud as binary or ascii (pcl_convert_pcd_ascii_binary)");
    std::vector<Vector3d> points =
        header.data == "binary" ? read_binary_points(bytes, header) : read_ascii_points(bytes, header);
    std::erase_if(points, [](const Vector3d& point) { return !point.allFinite(); });
    return points;
}

} // namespace chasles::io
