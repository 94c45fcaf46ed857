// Contacts as aligned columns.
#include "cli/contact_table.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace chasles::cli {
namespace {

constexpr std::size_t most_contacts = 10;

using Row = std::array<std::string, 4>;

std::string vertex_name(const Feature& vertex) {
    return fmt::format("vertex {}", vertex.first);
}

std::string pair_name(const Contact& contact) {
    switch (contact.kind) {
    case ContactKind::vertex_face:
        return vertex_name(contact.moving) + " on " + face_name(contact.fixed);
    case ContactKind::face_vertex:
        return face_name(contact.moving) + " on " + vertex_name(contact.fixed);
    case ContactKind::edge_edge:
        break;
    }
    return edge_name(contact.moving) + " on " + edge_name(contact.fixed);
}

Row row_of(const Contact& contact) {
    return {pair_name(contact), vector_text(contact.point), vector_text(contact.normal),
            fmt::format("{:.6g}", contact.approach_speed + 0.0)};
}

std::size_t width_of(const std::vector<Row>& rows, std::size_t column) {
    const auto is_shorter = [&](const Row& a, const Row& b) { return a[column].size() < b[column].size(); };
    return std::max_element(rows.begin(), rows.end(), is_shorter)->at(column).size();
}

} // namespace

std::vector<std::string> contact_table(const std::vector<Contact>& contacts) {
    std::vector<Row> rows = {{"moving on fixed", "point", "normal", "closing speed"}};
    for (std::size_t i = 0; i < std::min(contacts.size(), most_contacts); ++i)
        rows.push_back(row_of(contacts[i]));
    std::vector<std::string> lines;
    for (const Row& row : rows)
        lines.push_back(fmt::format("{:<{}}   {:<{}}   {:<{}}   {}", row[0], width_of(rows, 0), row[1],
                                    width_of(rows, 1), row[2], width_of(rows, 2), row[3]));
    if (contacts.size() > most_contacts)
        lines.push_back(fmt::format("and {} more (--json lists them all)", contacts.size() - most_contacts));
    return lines;
}

std::string edge_name(const Feature& edge) {
    return fmt::format("edge {}-{}", edge.first, edge.second);
}

std::string face_name(const Feature& face) {
    return fmt::format("face {}", face.first);
}

// Adding zero turns -0 into 0, which is easier on the eye.
std::string vector_text(const Eigen::Vector3d& vector) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0);
}

} // namespace chasles::cli
