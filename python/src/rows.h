// The rows of a batch: their poses, and how they are answered on several threads.
#pragma once

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit_of_thread.h"
#include "chasles/base/parallel_for.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/motion.h"
#include "chasles/query/first_contact.h"
#include "python/src/body.h"
#include "python/src/interruptible.h"
#include "python/src/motions.h"
#include "python/src/names.h"
#include "python/src/poses.h"
#include "python/src/table.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <vector>

namespace chasles::python {

/// The options of a batch.
struct RowOptions {
    view::MotionKind motion;        ///< from the start of a row to its goal
    std::optional<double> max_turn; ///< of a screw between poses; none for other motions
    unsigned threads;
    bool marks_errors; ///< whether an invalid pose marks its row instead of ending the batch
};

/// Refuses invalid options before any row is answered, by one query about two triangles: ask(triangle, motion).
template <typename Ask>
void check(const RowOptions& options, const Ask& ask) {
    const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::vector<std::uint32_t>> face{{0, 1, 2}};
    const Pose beside({4, 0, 0}, Eigen::Quaterniond::Identity());
    ask(Polyhedron::from_polygons(corners, face),
        Motion(ScrewMotion::between(beside, beside, max_turn_of(options.motion, options.max_turn))));
}

/// Calls answer(i) for each unanswered row until the batch ends or reaches the limit of its thread.
template <typename AnyRow, typename AnswerRow>
void answer_rows(const Table<AnyRow>& table, const RowOptions& options, Progress& progress, const AnswerRow& answer) {
    parallel_for(options.threads, table.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !is_cancelled(); ++i) {
            if (!is_answered(table[i]))
                try {
                    answer(i);
                } catch (const Cancelled&) { // stays unanswered
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

/// Motions of any kinds, read before the first query.
class GivenMotions {
public:
    GivenMotions(nb::handle list, const RowOptions& options) {
        for (const nb::handle item : list)
            try {
                motions_.emplace_back(given_motion(item));
            } catch (const InvalidInput& error) {
                if (!options.marks_errors)
                    throw InvalidInput(fmt::format("motions[{}]: {}", motions_.size(), error.what()));
                motions_.emplace_back();
            }
    }
    [[nodiscard]] std::size_t size() const { return motions_.size(); }
    /// Throws InvalidInput for what is no motion.
    const TypedMotion& operator[](std::size_t i) const {
        if (!motions_[i])
            throw InvalidInput(fmt::format("motions[{}]", i));
        return *motions_[i];
    }

private:
    std::vector<std::optional<TypedMotion>> motions_;
};

/// Whether the motion has the paper's parameter.
inline bool has_tau(const TypedMotion& motion) {
    return std::holds_alternative<PythonScrew>(motion) || std::holds_alternative<SweepMotion>(motion);
}

template <typename AnyRow>
void remove_tau(AnyRow& row) {
    row.tau = row.tau_upper = std::numeric_limits<double>::quiet_NaN();
}

/// Where the motions of a batch come from: starts and goals, or a list of motions; the others are None.
struct RowMotions {
    nb::handle starts, goals, motions;
};

/// The motion of a row. About the body's origin, if it has a centre.
inline Motion row_motion(const RowOptions& options, const Pose& start, const Pose& goal) {
    switch (options.motion) {
    case view::MotionKind::sweep:
        return SweepMotion::between(start, goal);
    case view::MotionKind::velocity:
        return ConstantVelocity::between(start, goal);
    case view::MotionKind::twist:
        return ConstantTwist::between(start, goal);
    default:
        return ScrewMotion::between(start, goal, max_turn_of(options.motion, options.max_turn));
    }
}

/// Refuses motions that no question about the bodies takes, before any row is answered. Where errors are marked, the
/// answers of their rows do so.
template <typename NameOf, typename MotionOf>
void require_motions(const BodyPair& bodies, std::size_t rows, const RowOptions& options, const NameOf& name_of,
                     const MotionOf& motion_of) {
    const auto check_row = [&](std::size_t i) { check_motion(bodies.moving, bodies.fixed, motion_of(i)); };
    std::vector<std::uint8_t> is_refused(options.marks_errors ? 0 : rows);
    parallel_for(options.threads, is_refused.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            try {
                check_row(i);
            } catch (const InvalidInput&) {
                is_refused[i] = true;
            }
    });
    const auto first = std::size_t(std::ranges::find(is_refused, 1) - is_refused.begin());
    try {
        if (first < is_refused.size())
            check_row(first);
    } catch (const InvalidInput& error) {
        throw InvalidInput(name_of(first) + ": " + error.what());
    }
}

/// The rows of given motions.
template <typename AnyRow, typename Answer>
void given_rows(const BodyPair& bodies, nb::handle motions, const Table<AnyRow>& table, const RowOptions& options,
                nb::handle report, const Answer& answer) {
    const GivenMotions given(motions, options);
    RowOptions with_gil = options; // in this thread: motions may be functions of Python
    with_gil.threads = 1;
    require_motions(
        bodies, given.size(), with_gil, [](std::size_t i) { return fmt::format("motions[{}]", i); },
        [&](std::size_t i) { return plain(given[i]); });
    if (table.size() != given.size())
        throw InvalidInput(fmt::format("table: has {} rows for {} motions", table.size(), given.size()));
    const auto work = [&](Progress& progress) {
        answer_rows(table, options, progress, [&](std::size_t i) {
            answer(plain(given[i]), table[i]);
            if (!has_tau(given[i]))
                remove_tau(table[i]);
        });
    };
    run_interruptibly(work, report);
}

/// The rows of motions from starts to goals, or of given motions. `try_options(triangle, motion)` refuses invalid
/// options; `answer(motion, row)` answers one row.
template <typename AnyRow, typename TryOptions, typename Answer>
void motion_rows(const BodyPair& bodies, const RowMotions& motions, nb::handle array, const RowOptions& options,
                 nb::handle report, const TryOptions& try_options, const Answer& answer) {
    const Table<AnyRow> table(array);
    if (!motions.motions.is_none()) {
        if (options.max_turn)
            throw InvalidInput("max_turn: belongs to the motions, which are given");
        check(options, try_options);
        return given_rows(bodies, motions.motions, table, options, report, answer);
    }
    const PoseArray start_array(motions.starts, "starts"), goal_array(motions.goals, "goals");
    if (goal_array.size() != start_array.size())
        throw InvalidInput(fmt::format("goals: there are {} for {} starts", goal_array.size(), start_array.size()));
    if (table.size() != start_array.size())
        throw InvalidInput(fmt::format("table: has {} rows for {} starts", table.size(), start_array.size()));
    check(options, try_options);
    const auto work = [&](Progress& progress) {
        const auto named = [](const char* name) {
            return [name](std::size_t i) { return fmt::format("{}[{}]", name, i); };
        };
        const ReadPoses from(start_array, options, progress, named("starts")),
            to(goal_array, options, progress, named("goals"));
        if (!view::has_tau(options.motion))
            require_motions(
                bodies, table.size(), options, [](std::size_t i) { return fmt::format("starts[{}], goals[{}]", i, i); },
                [&](std::size_t i) { return row_motion(options, from[i], to[i]); });
        answer_rows(table, options, progress, [&](std::size_t i) {
            answer(row_motion(options, from[i], to[i]), table[i]);
            if (!view::has_tau(options.motion))
                remove_tau(table[i]);
        });
    };
    run_interruptibly(work, report);
}

} // namespace chasles::python
