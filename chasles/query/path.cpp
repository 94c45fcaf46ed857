#include "chasles/query/path.h"

#include "chasles/invalid_input.h"

#include <algorithm>
#include <mutex>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace chasles {

PathContact first_contact_on_path(const PathQuery& query) {
    if (query.poses.size() < 2)
        throw InvalidInput("path: poses: at least two are needed");
    PathContact result;
    Work work;
    for (std::size_t segment = 0; segment + 1 < query.poses.size(); ++segment) {
        result.segment = segment;
        result.contact = first_contact({.moving = query.moving,
                                        .fixed = query.fixed,
                                        .motion = ScrewMotion::between(query.poses[segment], query.poses[segment + 1]),
                                        .margin = query.margin,
                                        .time_tolerance = query.time_tolerance,
                                        .max_turn = query.max_turn,
                                        .find = query.find});
        work += result.contact.work;
        if (query.progress)
            query.progress(segment + 1);
        if (result.contact.verdict != Verdict::clear)
            break;
    }
    result.contact.work = work;
    return result;
}

std::vector<FirstContact> first_contact_batch(const BatchQuery& query) {
    std::vector<FirstContact> results(query.motions.size());
    std::size_t done = 0;
    std::mutex reporting;
    const auto answer = [&](const oneapi::tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            results[i] = first_contact({.moving = query.moving,
                                        .fixed = query.fixed,
                                        .motion = query.motions[i],
                                        .margin = query.margin,
                                        .time_tolerance = query.time_tolerance,
                                        .max_turn = query.max_turn,
                                        .find = query.find});
        const std::lock_guard lock(reporting);
        done += range.size();
        if (query.progress)
            query.progress(done);
    };
    // More threads than cores gain nothing, and oneTBB would warn on standard error.
    const auto cores = static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
    oneapi::tbb::task_arena arena(int(query.threads == 0 ? cores : std::min(query.threads, cores)));
    arena.execute(
        [&] { oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, results.size(), 1), answer); });
    return results;
}

} // namespace chasles
