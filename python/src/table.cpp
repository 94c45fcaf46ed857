#include "python/src/table.h"

#include "chasles/base/invalid_input.h"
#include "view/names.h"

#include <algorithm>
#include <limits>

namespace chasles::python {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view not_done = "not_done"; ///< as table.py fills new tables

template <std::size_t size>
void write_text(std::string_view text, char32_t (&cell)[size]) {
    static_assert(sizeof(char32_t) == 4); // as NumPy's
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
    row.time = is_clear ? nothing : found.time.lower;
    row.time_upper = is_clear ? nothing : found.time.upper;
    row.tau = is_clear ? nothing : found.tau.lower;
    row.tau_upper = is_clear ? nothing : found.tau.upper;
    row.certain = found.certain;
    row.clear_until = found.clear_until;
}

void write_nowhere(Row& row) {
    write_text("", row.kind);
    for (auto* const feature : {row.moving_feature, row.fixed_feature})
        std::fill_n(feature, 2, -1);
    for (auto* const vector : {row.point, row.normal})
        std::fill_n(vector, 3, nothing);
}

void write_place(const Contact& contact, Row& row) {
    write_text(view::name_of(contact.kind), row.kind);
    write_feature(contact.moving, row.moving_feature);
    write_feature(contact.fixed, row.fixed_feature);
    write_vector(contact.point, row.point);
    write_vector(contact.normal, row.normal);
}

/// An overlap has features and a point, but neither kind nor normal.
void write_place(const Overlap& overlap, Row& row) {
    write_feature(overlap.edge_is_moving ? overlap.edge : overlap.face, row.moving_feature);
    write_feature(overlap.edge_is_moving ? overlap.face : overlap.edge, row.fixed_feature);
    write_vector(overlap.point, row.point);
}

} // namespace

void write(const FirstContact& found, Row& row) {
    write_times(found, row);
    write_nowhere(row);
    if (!found.contacts.empty())
        write_place(found.contacts.front(), row);
    else if (found.overlap)
        write_place(*found.overlap, row);
    write_text(view::name_of(found.verdict), row.verdict); // last: now it is answered
}

void write(const PathContact& found, PathRow& row) {
    row.segment = found.contact.verdict == Verdict::clear ? -1 : std::int64_t(found.segment);
    write(found.contact, static_cast<Row&>(row));
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
        throw InvalidInput("table: must be one that an earlier batch of the same kind left");
    }
}

template class Table<Row>;
template class Table<PathRow>;

} // namespace chasles::python
