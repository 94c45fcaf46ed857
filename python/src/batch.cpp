// The compiled part of chasles.first_contact_batch and chasles.path_is_clear_batch (python/chasles/batch.py).
#include "chasles/base/invalid_input.h"
#include "chasles/base/parallel_for.h"
#include "chasles/query/path.h"
#include "python/src/bind.h"
#include "python/src/body.h"
#include "python/src/interruptible.h"
#include "python/src/names.h"
#include "python/src/poses.h"
#include "python/src/table.h"

#include <algorithm>
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <vector>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// The options of a batch.
struct RowOptions {
    QueryOptions query;
    double max_turn;
    unsigned threads;
    bool marks_errors; ///< whether an invalid pose marks its row instead of ending the batch
};

/// Refuses invalid options before any row is answered, by one query about two triangles.
void check(const RowOptions& options) {
    const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::vector<std::uint32_t>> face{{0, 1, 2}};
    const Polyhedron triangle = Polyhedron::from_polygons(corners, face);
    const Pose beside({4, 0, 0}, Eigen::Quaterniond::Identity());
    const Motion rest = ScrewMotion::between(beside, beside, options.max_turn);
    static_cast<void>(first_contact({triangle, triangle, rest, options.query}));
}

/// Calls answer(i) for each unanswered row until the batch ends or is stopped.
template <typename AnyRow, typename AnswerRow>
void answer_rows(const Table<AnyRow>& table, const RowOptions& options, Progress& progress, const AnswerRow& answer) {
    parallel_for(options.threads, table.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !progress.is_stopping; ++i) {
            if (!is_answered(table[i]))
                try {
                    answer(i);
                } catch (const InvalidInput&) {
                    if (!options.marks_errors)
                        throw;
                    write_error(table[i]);
                }
            ++progress.done;
        }
    });
}

/// All poses of a batch, read and checked before the first query.
class ReadPoses {
public:
    /// `name_of(index)` is the name of a pose in messages.
    template <typename NameOf>
    ReadPoses(const PoseArray& array, const RowOptions& options, const Progress& progress, const NameOf& name_of)
        : poses_(array.size()), is_bad_(array.size()) {
        parallel_for(options.threads, array.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !progress.is_stopping; ++i)
                try {
                    poses_[i] = array[i];
                } catch (const InvalidInput&) {
                    is_bad_[i] = true;
                }
        });
        const auto bad = std::ranges::find(is_bad_, 1);
        if (bad != is_bad_.end() && !options.marks_errors)
            throw_reason(array, std::size_t(bad - is_bad_.begin()), name_of);
    }

    const Pose& operator[](std::size_t i) const {
        if (is_bad_[i])
            throw InvalidInput("pose " + std::to_string(i));
        return poses_[i];
    }

    /// Throws InvalidInput if operator[] throws for any pose of the range.
    std::span<const Pose> range(std::size_t begin, std::size_t end) const {
        const auto bad = std::span(is_bad_).subspan(begin, end - begin);
        if (const auto first = std::ranges::find(bad, 1); first != bad.end())
            static_cast<void>((*this)[begin + std::size_t(first - bad.begin())]);
        return std::span(poses_).subspan(begin, end - begin);
    }

private:
    template <typename NameOf>
    [[noreturn]] static void throw_reason(const PoseArray& array, std::size_t index, const NameOf& name_of) {
        try {
            static_cast<void>(array[index]);
        } catch (const InvalidInput& error) {
            throw InvalidInput(name_of(index) + ": " + error.what());
        }
        throw InvalidInput(name_of(index) + ": changed while the batch read it");
    }

    std::vector<Pose> poses_;
    std::vector<std::uint8_t> is_bad_;
};

void first_contact_rows(const BodyPair& bodies, nb::handle starts, nb::handle goals, nb::handle array,
                        const RowOptions& options, nb::handle report) {
    const PoseArray start_array(starts, "starts"), goal_array(goals, "goals");
    const Table<Row> table(array);
    if (goal_array.size() != start_array.size())
        throw InvalidInput(fmt::format("goals: there are {} for {} starts", goal_array.size(), start_array.size()));
    if (table.size() != start_array.size())
        throw InvalidInput(fmt::format("table: has {} rows for {} starts", table.size(), start_array.size()));
    check(options);
    const auto work = [&](Progress& progress) {
        const auto named = [](const char* name) {
            return [name](std::size_t i) { return fmt::format("{}[{}]", name, i); };
        };
        const ReadPoses from(start_array, options, progress, named("starts")),
            to(goal_array, options, progress, named("goals"));
        answer_rows(table, options, progress, [&](std::size_t i) {
            const Motion motion = ScrewMotion::between(from[i], to[i], options.max_turn);
            write(first_contact({bodies.moving, bodies.fixed, motion, options.query}), table[i]);
        });
    };
    run_interruptibly(work, report);
}

/// "paths[PATH][POSE]"
std::string name_in_paths(std::span<const std::int64_t> offsets, std::size_t pose) {
    const auto end = std::ranges::upper_bound(offsets, std::int64_t(pose));
    return fmt::format("paths[{}][{}]", end - offsets.begin() - 1, std::int64_t(pose) - end[-1]);
}

/// Thrown to end the query of a path.
struct Stopped {};

/// The poses of path i are those from offsets[i] to offsets[i + 1].
void path_rows(const BodyPair& bodies, nb::handle poses, nb::handle offset_array, nb::handle array,
               const RowOptions& options, nb::handle report) {
    const PoseArray pose_array(poses, "paths");
    const IndexArray offsets(offset_array, "offsets");
    const Table<PathRow> table(array);
    check(options);
    const auto work = [&](Progress& progress) {
        const ReadPoses path(pose_array, options, progress,
                             [&](std::size_t i) { return name_in_paths(offsets.numbers(), i); });
        const auto stop_if_interrupted = [&](std::size_t) {
            if (progress.is_stopping)
                throw Stopped();
        };
        answer_rows(table, options, progress, [&](std::size_t i) {
            const auto begin = std::size_t(offsets.numbers()[i]), end = std::size_t(offsets.numbers()[i + 1]);
            const PathQuery query{bodies.moving, bodies.fixed, screws_along(path.range(begin, end), options.max_turn),
                                  options.query, stop_if_interrupted};
            try {
                write(first_contact_on_path(query), table[i]);
            } catch (const Stopped&) {
            }
        });
    };
    run_interruptibly(work, report);
}

} // namespace

void bind_batches(nb::module_& module) {
    module.def(
        "_first_contact_batch",
        [](nb::handle moving, nb::handle fixed, nb::handle starts, nb::handle goals, nb::handle table, double margin,
           std::optional<double> hold, double time_tolerance, double max_turn, nb::handle find, unsigned threads,
           bool marks_errors, nb::handle report) {
            first_contact_rows({polyhedron_of(moving, "moving"), polyhedron_of(fixed, "fixed")}, starts, goals, table,
                               {{margin, hold, time_tolerance, find_from(find)}, max_turn, threads, marks_errors},
                               report);
        },
        "moving"_a.none(), "fixed"_a.none(), "starts"_a, "goals"_a, "table"_a, nb::kw_only(), "margin"_a,
        "hold"_a.none(), "time_tolerance"_a, "max_turn"_a, "find"_a.none(), "threads"_a, "marks_errors"_a,
        "report"_a.none());
    module.def(
        "_path_is_clear_batch",
        [](nb::handle moving, nb::handle fixed, nb::handle poses, nb::handle offsets, nb::handle table, double margin,
           double time_tolerance, double max_turn, nb::handle find, unsigned threads, bool marks_errors,
           nb::handle report) {
            path_rows({polyhedron_of(moving, "moving"), polyhedron_of(fixed, "fixed")}, poses, offsets, table,
                      {{margin, {}, time_tolerance, find_from(find)}, max_turn, threads, marks_errors}, report);
        },
        "moving"_a.none(), "fixed"_a.none(), "poses"_a, "offsets"_a, "table"_a, nb::kw_only(), "margin"_a,
        "time_tolerance"_a, "max_turn"_a, "find"_a.none(), "threads"_a, "marks_errors"_a, "report"_a.none());
}

} // namespace chasles::python
