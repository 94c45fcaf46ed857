#include "python/src/table.h"

#include "chasles/base/invalid_input.h"
#include "view/names.h"
#include "view/proven_verdict.h"

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

/// `Found` is FirstContact or LeastDistance.
template <typename Found>
void write_times(const Found& found, Row& row) {
    row.time = found.time.lower;
    row.time_upper = found.time.upper;
    row.tau = found.tau.lower;
    row.tau_upper = found.tau.upper;
    row.certain = found.certain;
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

/// A vertex inside has no kind and no normal, and the other body no feature.
void write_geometry(const Inside& inside, Row& row) {
    write_feature(inside.vertex, inside.moving_is_inside ? row.moving_feature : row.fixed_feature);
    write_vector(inside.point, row.point);
}

template <typename Found>
void write_geometry_of(const Found& found, Row& row) {
    clear_geometry(row);
    if (!found.contacts.empty())
        write_geometry(found.contacts.front(), row);
    else if (found.overlap)
        write_geometry(*found.overlap, row);
    else if (found.inside)
        write_geometry(*found.inside, row);
}

/// The last cell to write, because the verdict marks the row as answered.
void write_verdict(Verdict verdict, Row& row) {
    write_text(view::name_of(verdict), row.verdict);
}

} // namespace

void write(const FirstContact& found, Row& row) {
    write_times(found, row);
    if (found.verdict == Verdict::clear)
        row.time = row.time_upper = row.tau = row.tau_upper = no_number;
    row.clear_until = found.clear_until;
    write_geometry_of(found, row);
    write_verdict(found.verdict, row);
}

void write(const PathContact& found, PathRow& row) {
    row.segment = found.contact.verdict == Verdict::clear ? -1 : std::int64_t(found.segment);
    write(found.contact, static_cast<Row&>(row));
}

void write(const LeastDistance& found, LeastRow& row) {
    const Verdict verdict = view::proven_verdict(found);
    row.distance = found.distance.lower;
    row.distance_upper = found.distance.upper;
    write_times(found, row);
    row.clear_until = verdict == Verdict::clear ? 1 : verdict == Verdict::unknown ? 0 : found.time.lower;
    write_geometry_of(found, row);
    write_verdict(verdict, row);
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
