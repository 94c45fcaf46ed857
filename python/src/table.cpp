#include "python/src/table.h"

#include "chasles/base/invalid_input.h"
#include "view/names.h"

#include <algorithm>
#include <limits>

namespace chasles::python {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view not_done = "not_done"; ///< the verdict of a new row (python/chasles/table.py)

template <std::size_t size>
void write_text(std::string_view text, char32_t (&cell)[size]) {
    static_assert(sizeof(char32_t) == 4); // the size of NumPy's characters
    const auto end = std::ranges::copy(text.substr(0, size), cell).out;
    std::fill(end, cell + size, U'\0');
}

void write_feature(const Feature& feature, std::int64_t (&cell)[2]) {
    cell[0] = feature.first;
    cell[1] = feature.second;
}

void write_vector(const Eigen::Vector3d& vector, double (&cells)[3]) {
    std::ranges::copy(std::span(vector.data(), 3), cells);
}

void write_times(const FirstContact& found, Row& row) {
    const bool is_clear = found.verdict == Verdict::clear;
    row.time = is_clear ? no_number : found.time.lower;
    row.time_upper = is_clear ? no_number : found.time.upper;
    row.tau = is_clear ? no_number : found.tau.lower;
    row.tau_upper = is_clear ? no_number : found.tau.upper;
}

void clear_geometry(Row& row) {
    write_text("", row.kind);
    for (auto* const feature : {row.moving_feature, row.fixed_feature})
        std::fill_n(feature, 2, -1);
    for (auto* const vector : {row.point, row.normal})
        std::fill_n(vector, 3, no_number);
}

void write_geometry(const Contact& contact, Row& row) {
    write_text(view::name_of(contact.kind), row.kind);
    write_feature(contact.moving, row.moving_feature);
    write_feature(contact.fixed, row.fixed_feature);
    write_vector(contact.point, row.point);
    write_vector(contact.normal, row.normal);
}

/// An overlap has features and a point, but no kind and no normal.
void write_geometry(const Overlap& overlap, Row& row) {
    write_feature(overlap.edge_is_moving ? overlap.edge : overlap.face, row.moving_feature);
    write_feature(overlap.edge_is_moving ? overlap.face : overlap.edge, row.fixed_feature);
    write_vector(overlap.point, row.point);
}

void write_all_but_times(const FirstContact& found, Row& row) {
    row.certain = found.certain;
    row.clear_until = found.clear_until;
    clear_geometry(row);
    if (!found.contacts.empty())
        write_geometry(found.contacts.front(), row);
    else if (found.overlap)
        write_geometry(*found.overlap, row);
    write_text(view::name_of(found.verdict), row.verdict); // last, because the verdict marks the row as answered
}

} // namespace

void write(const FirstContact& found, Row& row) {
    write_times(found, row);
    write_all_but_times(found, row);
}
void write(const PathContact& found, PathRow& row) {
    row.segment = found.contact.verdict == Verdict::clear ? -1 : std::int64_t(found.segment);
    write(found.contact, static_cast<Row&>(row));
}

void write(const LeastDistance& found, LeastRow& row) {
    const bool is_apart = found.distance.lower > 0;
    row.distance = found.distance.lower;
    row.distance_upper = found.distance.upper;
    FirstContact contact;
    contact.verdict = is_apart ? Verdict::clear : found.time.upper <= 0 ? Verdict::contact_at_start : Verdict::contact;
    contact.certain = found.certain;
    contact.clear_until = is_apart ? 1 : found.time.lower;
    contact.contacts = found.contacts;
    contact.overlap = found.overlap;
    row.time = found.time.lower;
    row.time_upper = found.time.upper;
    row.tau = found.tau.lower;
    row.tau_upper = found.tau.upper;
    write_all_but_times(contact, row);
}

void write_error(Row& row) {
    write_text("error", row.verdict);
}

bool is_answered(const Row& row) {
    return !std::ranges::equal(not_done, std::span(row.verdict).first(not_done.size()));
}

template <typename AnyRow>
Table<AnyRow>::Table(nanobind::handle array) {
    if (PyObject_GetBuffer(array.ptr(), &view_, PyBUF_CONTIG | PyBUF_FORMAT) != 0) {
        PyErr_Clear();
        throw InvalidInput("table: must be a contiguous array that can be written to");
    }
    const bool fits = view_.ndim == 1 && view_.itemsize == sizeof(AnyRow) &&
                      reinterpret_cast<std::uintptr_t>(view_.buf) % alignof(AnyRow) == 0;
    if (!fits) {
        PyBuffer_Release(&view_);
        throw InvalidInput("table: must come from an earlier batch of the same function");
    }
}

template class Table<Row>;
template class Table<PathRow>;
template class Table<LeastRow>;

} // namespace chasles::python
