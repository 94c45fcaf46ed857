// Contacts as aligned columns.
#include "cli/contact_table.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace chasles::cli {
namespace {

constexpr std::size_t most_rows = 10;

using Row = std::array<std::string, 5>;

std::string name_of(FeatureKind kind, const Feature& feature) {
    switch (kind) {
    case FeatureKind::vertex:
        return fmt::format("vertex {}", feature.first);
    case FeatureKind::edge:
        return edge_name(feature);
    case FeatureKind::face:
        break;
    }
    return face_name(feature);
}

std::string pair_name(const Contact& contact) {
    return name_of(moving_feature_kind(contact.kind), contact.moving) + " on " +
           name_of(fixed_feature_kind(contact.kind), contact.fixed);
}

Row row_of(const Contact& contact) {
    return {pair_name(contact), vector_text(contact.point), vector_text(contact.normal),
            fmt::format("{:.6g}", contact.approach_speed + 0.0), fmt::format("{:.9g}", contact.gap)};
}

std::size_t width_of(const std::vector<Row>& rows, std::size_t column) {
    const auto is_shorter = [&](const Row& a, const Row& b) { return a[column].size() < b[column].size(); };
    return std::max_element(rows.begin(), rows.end(), is_shorter)->at(column).size();
}

} // namespace

std::vector<std::string> contact_table(const std::vector<Contact>& contacts, bool shows_gaps) {
    std::vector<Row> rows = {{"moving on fixed", "point", "normal", "approach speed", "gap"}};
    for (std::size_t i = 0; i < std::min(contacts.size(), most_rows); ++i)
        rows.push_back(row_of(contacts[i]));
    std::vector<std::string> lines;
    for (const Row& row : rows) {
        lines.push_back(fmt::format("{:<{}}   {:<{}}   {:<{}}   ", row[0], width_of(rows, 0), row[1], width_of(rows, 1),
                                    row[2], width_of(rows, 2)));
        lines.back() += shows_gaps ? fmt::format("{:<{}}   {}", row[3], width_of(rows, 3), row[4]) : row[3];
    }
    if (contacts.size() > most_rows)
        lines.push_back(fmt::format("and {} more (--json lists them all)", contacts.size() - most_rows));
    return lines;
}

std::string edge_name(const Feature& edge) {
    return fmt::format("edge {}-{}", edge.first, edge.second);
}

std::string face_name(const Feature& face) {
    return fmt::format("face {}", face.first);
}

// Adding zero turns -0 into 0.
std::string vector_text(const Eigen::Vector3d& vector) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0);
}

} // namespace chasles::cli
