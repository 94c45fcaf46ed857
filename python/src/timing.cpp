// Times of the library without the Python layer, for bench/python. Not part of the public interface.
#include "chasles/query/batch.h"
#include "python/src/bind.h"
#include "python/src/body.h"
#include "python/src/motions.h"
#include "python/src/names.h"
#include "python/src/without_gil.h"

#include <chrono>

namespace chasles::python {
namespace {

using namespace nb::literals;

double seconds_of(const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The time of `times` identical queries. Each query includes making the motion from its poses.
double query_seconds(const Body& moving, const Body& fixed, nb::handle start, nb::handle goal, nb::handle find,
                     std::size_t times) {
    const QueryOptions options{.find = find_from(find)};
    const Pose from = pose_from(start, "start"), to = pose_from(goal, "goal");
    return seconds_of([&] {
        for (std::size_t i = 0; i < times; ++i)
            static_cast<void>(
                first_contact({moving.polyhedron, fixed.polyhedron, ScrewMotion::between(from, to), options}));
    });
}

double batch_seconds(const Body& moving, const Body& fixed, nb::handle starts, nb::handle goals, unsigned threads) {
    const std::vector<Pose> from = poses_from(starts, "starts"), to = poses_from(goals, "goals");
    std::vector<Motion> motions;
    for (std::size_t i = 0; i < from.size(); ++i)
        motions.emplace_back(ScrewMotion::between(from[i], to[i]));
    const WithoutGil without_gil;
    return seconds_of([&] {
        static_cast<void>(first_contact_batch({.moving = moving.polyhedron,
                                               .fixed = fixed.polyhedron,
                                               .motions = motions,
                                               .batch = {.threads = threads}}));
    });
}

} // namespace

void bind_timing(nb::module_& module) {
    module.def("_query_seconds", query_seconds, "moving"_a, "fixed"_a, "start"_a, "goal"_a, "find"_a, "times"_a);
    module.def("_batch_seconds", batch_seconds, "moving"_a, "fixed"_a, "starts"_a, "goals"_a, "threads"_a = 0);
}

} // namespace chasles::python
