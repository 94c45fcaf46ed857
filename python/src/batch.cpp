// The compiled part of chasles.first_contact_batch and chasles.path_is_clear_batch (python/chasles/batch.py).
#include "chasles/base/invalid_input.h"
#include "chasles/query/path.h"
#include "python/src/bind.h"
#include "python/src/body.h"
#include "python/src/names.h"
#include "python/src/rows.h"

#include <algorithm>
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <vector>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// A row that was not answered in time stays as it is.
void write_answer(const FirstContact& found, Row& row) {
    if (found.verdict != Verdict::unknown)
        write(found, row);
}

void first_contact_rows(const BodyPair& bodies, const RowMotions& motions, nb::handle array, const QueryOptions& query,
                        const RowOptions& options, nb::handle report) {
    motion_rows<Row>(
        bodies, motions, array, options, report,
        [&](const Polyhedron& triangle, const Motion& rest) {
            static_cast<void>(first_contact({triangle, triangle, rest, query}));
        },
        [&](const Motion& motion, Row& row) {
            write_answer(first_contact({bodies.moving, bodies.fixed, motion, query}), row);
        });
}

/// "paths[PATH][POSE]"
std::string name_in_paths(std::span<const std::int64_t> offsets, std::size_t pose) {
    const auto end = std::ranges::upper_bound(offsets, std::int64_t(pose));
    return fmt::format("paths[{}][{}]", end - offsets.begin() - 1, std::int64_t(pose) - end[-1]);
}

/// The poses of path i are those from offsets[i] to offsets[i + 1].
void path_rows(const BodyPair& bodies, nb::handle poses, nb::handle offset_array, nb::handle array,
               const QueryOptions& query, const RowOptions& options, nb::handle report) {
    const PoseArray pose_array(poses, "paths");
    const IndexArray offsets(offset_array, "offsets");
    const Table<PathRow> table(array);
    check(options, [&](const Polyhedron& triangle, const Motion& rest) {
        static_cast<void>(first_contact({triangle, triangle, rest, query}));
    });
    const auto work = [&](Progress& progress) {
        const ReadPoses path(pose_array, options, progress,
                             [&](std::size_t i) { return name_in_paths(offsets.numbers(), i); });
        answer_rows(table, options, progress, [&](std::size_t i) {
            const auto begin = std::size_t(offsets.numbers()[i]), end = std::size_t(offsets.numbers()[i + 1]);
            const PathQuery path_query{bodies.moving, bodies.fixed,
                                       screws_along(path.range(begin, end), options.max_turn.value()), query};
            const PathContact found = first_contact_on_path(path_query);
            if (found.contact.verdict != Verdict::unknown)
                write(found, table[i]);
        });
    };
    run_interruptibly(work, report);
}

} // namespace

void bind_batches(nb::module_& module) {
    module.def("_refuse_masked", refuse_masked, "argument"_a.none(), "name"_a);
    module.def(
        "_first_contact_batch",
        [](nb::handle moving, nb::handle fixed, nb::handle starts, nb::handle goals, nb::handle motions,
           nb::handle table, double margin, std::optional<double> hold, double time_tolerance, nb::handle motion,
           std::optional<double> max_turn, nb::handle find, unsigned threads, bool marks_errors, nb::handle report) {
            first_contact_rows({polyhedron_of(moving, "moving"), polyhedron_of(fixed, "fixed")},
                               {starts, goals, motions}, table, {margin, hold, time_tolerance, find_from(find)},
                               {kind_from(motion), max_turn, threads, marks_errors}, report);
        },
        "moving"_a.none(), "fixed"_a.none(), "starts"_a.none(), "goals"_a.none(), "motions"_a.none(), "table"_a,
        nb::kw_only(), "margin"_a, "hold"_a.none(), "time_tolerance"_a, "motion"_a.none(), "max_turn"_a.none(),
        "find"_a.none(), "threads"_a, "marks_errors"_a, "report"_a.none());
    module.def(
        "_path_is_clear_batch",
        [](nb::handle moving, nb::handle fixed, nb::handle poses, nb::handle offsets, nb::handle table, double margin,
           double time_tolerance, double max_turn, nb::handle find, unsigned threads, bool marks_errors,
           nb::handle report) {
            path_rows({polyhedron_of(moving, "moving"), polyhedron_of(fixed, "fixed")}, poses, offsets, table,
                      {margin, {}, time_tolerance, find_from(find)},
                      {view::MotionKind::screw, max_turn, threads, marks_errors}, report);
        },
        "moving"_a.none(), "fixed"_a.none(), "poses"_a, "offsets"_a, "table"_a, nb::kw_only(), "margin"_a,
        "time_tolerance"_a, "max_turn"_a, "find"_a.none(), "threads"_a, "marks_errors"_a, "report"_a.none());
}

} // namespace chasles::python
