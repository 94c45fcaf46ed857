// chasles.first_contact and chasles.first_contact_on_path.
#include "chasles/base/invalid_input.h"
#include "chasles/base/limit_of_thread.h"
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/motions.h"
#include "python/src/names.h"
#include "python/src/query_options.h"
#include "python/src/signals.h"

#include <atomic>
#include <mutex>
#include <nanobind/stl/optional.h>
#include <thread>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// A memory that threads of Python may share: a question waits for the one before.
struct SharedMemory {
    PairMemory memory;
    std::timed_mutex in_use;
    std::atomic<std::thread::id> user = {}; ///< the thread whose question has it

    SharedMemory(nb::handle moving, nb::handle fixed)
        : memory(polyhedron_of(moving, "moving"), polyhedron_of(fixed, "fixed")) {}
};

/// The memory for one question. Ctrl-C and limits end the wait for it.
class MemoryOfQuestion {
public:
    /// Throws InvalidInput if the question around this call has the memory: it would wait for itself.
    explicit MemoryOfQuestion(SharedMemory* shared) : shared_(shared) {
        if (!shared)
            return;
        if (shared->user == std::this_thread::get_id())
            throw InvalidInput("memory: the question around this call has it; give this question a memory of its own");
        while (!shared->in_use.try_lock_for(SignalCheck::interval))
            throw_if_cancelled();
        shared->user = std::this_thread::get_id();
    }
    ~MemoryOfQuestion() {
        if (!shared_)
            return;
        shared_->user = std::thread::id();
        shared_->in_use.unlock();
    }
    MemoryOfQuestion(const MemoryOfQuestion&) = delete;
    MemoryOfQuestion& operator=(const MemoryOfQuestion&) = delete;

    [[nodiscard]] PairMemory* get() const { return shared_ ? &shared_->memory : nullptr; }

private:
    SharedMemory* shared_;
};

Answer ask(nb::handle moving, nb::handle fixed, nb::handle start, nb::handle goal, nb::handle motion,
           nb::handle fixed_start, nb::handle fixed_goal, double margin, std::optional<double> hold,
           double time_tolerance, std::optional<double> max_turn, nb::handle find, SharedMemory* memory) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    Answer answer{{},
                  nb::borrow(moving),
                  nb::borrow(fixed),
                  motion_from({start, goal, motion, fixed_start, fixed_goal, max_turn}),
                  margin,
                  hold};
    const QueryOptions options{margin, hold, time_tolerance, find_from(find)};
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    const MemoryOfQuestion own_memory(memory);
    answer.found = first_contact({moving_body, fixed_body, plain(answer.motion), options, own_memory.get()});
    return answer;
}

PathAnswer ask_path(nb::handle moving, nb::handle fixed, nb::handle poses, double margin, std::optional<double> hold,
                    double time_tolerance, std::optional<double> max_turn, nb::handle find, nb::handle motion) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    const std::vector<Pose> path = poses_from(poses, "poses");
    const view::MotionKind kind = kind_from(motion);
    const auto segment = [&](std::size_t i) { return motion_between(kind, path[i], path[i + 1], max_turn); };
    std::vector<Motion> motions = screws_along(path); // checks the poses
    for (std::size_t i = 0; i < motions.size(); ++i)
        motions[i] = plain(segment(i));
    const PathQuery query{.moving = moving_body,
                          .fixed = fixed_body,
                          .motions = motions,
                          .options = {margin, hold, time_tolerance, find_from(find)}};
    PathContact answer;
    {
        const WithoutGil without_gil;
        const EndsBySignals ends_by_signals;
        answer = first_contact_on_path(query);
    }
    return {{std::move(answer.contact), nb::borrow(moving), nb::borrow(fixed), segment(answer.segment), margin, hold},
            answer.segment,
            std::move(motions)};
}

std::string first_contact_doc() {
    return "When do two polyhedra first touch, where, and how?\n\n" + motion_docs() + option_docs(max_turn_docs) +
           "memory : PairMemory, optional\n    Of both bodies. Saves time where questions with a margin follow each "
           "other at "
           "nearby places.\n"
           "\nReturns\n-------\nFirstContact\n    Its verdict states the proven result.\n\n" +
           invalid_input_docs;
}

std::string path_doc() {
    return "The first contact on a path of poses. Each segment between two poses is one motion.\n\n"
           "Parameters\n----------\nmoving, fixed : Polyhedron\nposes : array (n, 4, 4) or (n, 7)\n"
           "    At least two poses of the moving body in the frame of the fixed body.\n"
           "motion : str\n    From pose to pose: 'screw', 'sweep', 'velocity' or 'twist', about the body's origin.\n" +
           option_docs(max_turn_docs) +
           "\nReturns\n-------\nPathContact\n    Its time runs from 0 to 1 within its segment. Its work covers the "
           "whole "
           "path.";
}

} // namespace

void bind_queries(nb::module_& module) {
    nb::class_<SharedMemory>(
        module, "PairMemory",
        "What questions about the same two bodies keep for the next ones.\n\n"
        "A body that slides, or is driven by a simulation in small steps, is asked about at nearly the same place "
        "each\n"
        "time. The memory changes the time that the next answers take, and no verdict. It helps questions with a\n"
        "margin, and screws about one axis.\n\n"
        "Parameters\n----------\nmoving, fixed : Polyhedron\n    Of all questions with this memory, in these roles.")
        .def(nb::init<nb::handle, nb::handle>(), "moving"_a.none(), "fixed"_a.none(),
             nb::sig("def __init__(self, moving: Polyhedron, fixed: Polyhedron) -> None"));
    static const std::string first_contact_text = first_contact_doc(), path_text = path_doc();
    module.def(
        "first_contact", ask, "moving"_a.none(), "fixed"_a.none(), "start"_a = nb::none(), "goal"_a = nb::none(),
        nb::kw_only(), "motion"_a = nb::none(), "fixed_start"_a = nb::none(), "fixed_goal"_a = nb::none(),
        "margin"_a = 0.0, "hold"_a = nb::none(), "time_tolerance"_a = default_time_tolerance, "max_turn"_a = nb::none(),
        "find"_a.none() = "first", "memory"_a = nb::none(),
        nb::sig(
            "def first_contact(moving: Polyhedron, fixed: Polyhedron, "
            "start: numpy.typing.ArrayLike | None = None, goal: numpy.typing.ArrayLike | None = None, *, "
            "motion: ScrewMotion | SweepMotion | ConstantVelocity | ConstantTwist | TimedPoses | Trajectory | Motion | "
            "typing.Literal['screw', 'sweep', 'velocity', 'twist'] | None = None, "
            "fixed_start: numpy.typing.ArrayLike | None = None, "
            "fixed_goal: numpy.typing.ArrayLike | None = None, " CHASLES_OPTION_TYPES
            "max_turn: float | None = None, " CHASLES_FIND_TYPE ", memory: PairMemory | None = None) -> FirstContact"),
        first_contact_text.c_str());
    module.def("first_contact_on_path", ask_path, "moving"_a.none(), "fixed"_a.none(), "poses"_a.none(), nb::kw_only(),
               "margin"_a = 0.0, "hold"_a = nb::none(), "time_tolerance"_a = default_time_tolerance,
               "max_turn"_a = nb::none(), "find"_a.none() = "first", "motion"_a.none() = "screw",
               nb::sig("def first_contact_on_path(moving: Polyhedron, fixed: Polyhedron, "
                       "poses: numpy.typing.ArrayLike, *, " CHASLES_OPTION_TYPES
                       "max_turn: float | None = None, " CHASLES_FIND_TYPE
                       ", motion: typing.Literal['screw', 'sweep', 'velocity', 'twist'] = 'screw') -> PathContact"),
               path_text.c_str());
}

} // namespace chasles::python
