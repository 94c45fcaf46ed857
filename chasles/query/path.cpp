#include "chasles/query/path.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/parallel_for.h"

#include <mutex>

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
    parallel_for(query.threads, results.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            results[i] = first_contact({.moving = query.moving,
                                        .fixed = query.fixed,
                                        .motion = query.motions[i],
                                        .margin = query.margin,
                                        .hold = query.hold,
                                        .time_tolerance = query.time_tolerance,
                                        .max_turn = query.max_turn,
                                        .find = query.find});
        const std::lock_guard lock(reporting);
        done += end - begin;
        if (query.progress)
            query.progress(done);
    });
    return results;
}

} // namespace chasles
