// Rows of CSV (comma-separated values). Each number is the shortest text that reads back to the same double.
#include "cli/batch_rows.h"

#include "chasles/io/csv_table.h"
#include "view/names.h"

#include <fmt/format.h>

namespace chasles::cli {
namespace {

constexpr int contact_columns = 9; ///< kind, two features, point, normal

std::string text_of(const Feature& feature) {
    const bool is_edge = feature.first != feature.second;
    return is_edge ? fmt::format("{} {}", feature.first, feature.second) : fmt::format("{}", feature.first);
}

std::string text_of(const Eigen::Vector3d& vector) {
    return fmt::format("{},{},{}", vector.x(), vector.y(), vector.z());
}

std::string contact_cells(const Contact& contact) {
    return fmt::format("{},{},{},{},{}", view::name_of(contact.kind), text_of(contact.moving), text_of(contact.fixed),
                       text_of(contact.point), text_of(contact.normal));
}

// An overlap has features and a point, but no kind and no normal.
std::string overlap_cells(const Overlap& overlap) {
    const Feature& moving = overlap.edge_is_moving ? overlap.edge : overlap.face;
    const Feature& fixed = overlap.edge_is_moving ? overlap.face : overlap.edge;
    return fmt::format(",{},{},{},,,", text_of(moving), text_of(fixed), text_of(overlap.point));
}

// A vertex inside has no kind and no normal, and the other body no feature.
std::string inside_cells(const Inside& inside) {
    const std::string vertex = text_of(inside.vertex);
    return fmt::format(",{},{},{},,,", inside.moving_is_inside ? vertex : "", inside.moving_is_inside ? "" : vertex,
                       text_of(inside.point));
}

std::string geometry_cells(const FirstContact& found) {
    if (!found.contacts.empty())
        return contact_cells(found.contacts.front());
    if (found.inside)
        return inside_cells(*found.inside);
    return found.overlap ? overlap_cells(*found.overlap) : std::string(contact_columns - 1, ',');
}

} // namespace

std::string batch_header() {
    return "id,verdict,time,time_upper,tau,tau_upper,certain,kind,moving_feature,fixed_feature,px,py,pz,nx,ny,nz\n";
}

std::string batch_row(const std::string& id, const FirstContact& found, view::MotionKind kind) {
    const std::string start = fmt::format("{},{},", io::csv_cell(id), view::name_of(found.verdict));
    if (found.verdict == Verdict::clear)
        return start + ",,,,," + std::string(contact_columns - 1, ',') + "\n";
    const std::string tau = view::has_tau(kind) ? fmt::format("{},{}", found.tau.lower, found.tau.upper) : ",";
    return start + fmt::format("{},{},{},{},{}\n", found.time.lower, found.time.upper, tau, found.certain,
                               geometry_cells(found));
}

std::string batch_error_row(const std::string& id, const std::string& why) {
    return io::csv_cell(id) + ",error,,,,,," + io::csv_cell(why) + std::string(contact_columns - 1, ',') + "\n";
}

} // namespace chasles::cli
