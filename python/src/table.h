// The rows of the structured arrays that batches return. python/chasles/table.py describes the columns and has the same
// layout as a NumPy type.
#pragma once

#include "chasles/query/least_distance.h"
#include "chasles/query/path.h"

#include <cstdint>
#include <nanobind/nanobind.h>
#include <span>

namespace chasles::python {

/// Missing values are NaN, -1 or "".
struct Row {
    std::int64_t id;
    char32_t verdict[16];
    double time;
    double time_upper;
    double tau;
    double tau_upper;
    bool certain;
    char32_t kind[13];
    std::int64_t moving_feature[2];
    std::int64_t fixed_feature[2];
    double point[3];
    double normal[3];
    double clear_until;
};

struct PathRow : Row {
    std::int64_t segment;
};

/// The verdict is that of view::proven_verdict. If it is "clear", the times and the features are those of the least
/// distance.
struct LeastRow : Row {
    double distance;
    double distance_upper;
};

void write(const FirstContact& found, Row& row);
void write(const PathContact& found, PathRow& row);
void write(const LeastDistance& found, LeastRow& row);
/// Marks a row whose input is invalid.
void write_error(Row& row);
/// Whether an earlier batch has answered the row.
bool is_answered(const Row& row);

/// The rows of a structured array, in place. Throws InvalidInput if the array does not have rows of this type.
template <typename AnyRow>
class Table {
public:
    explicit Table(nanobind::handle array);
    ~Table() { PyBuffer_Release(&view_); }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    [[nodiscard]] std::size_t size() const { return std::size_t(view_.shape[0]); }
    AnyRow& operator[](std::size_t row) const { return static_cast<AnyRow*>(view_.buf)[row]; }

private:
    Py_buffer view_;
};

} // namespace chasles::python
