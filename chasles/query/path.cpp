#include "chasles/query/path.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit_of_thread.h"
#include "chasles/memory/orbit_filter.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"

namespace chasles {

PathContact first_contact_on_path(const PathQuery& query) {
    if (query.motions.empty())
        throw InvalidInput("path: motions: at least one is needed");
    query::check_options(query.options);
    query::require_near(query.moving.body(), query.fixed.body(), query.motions);
    PathContact result;
    Work work;
    memory::OrbitFilter orbits(query.moving.body(), query.fixed.body());
    for (std::size_t segment = 0; segment < query.motions.size(); ++segment) {
        const motion::AnyTrajectory& trajectory = query.motions[segment].trajectory();
        result.segment = segment;
        // A segment that is far apart is answered without a look at the limit, and a path may have millions.
        result.contact = is_cancelled() ? query::unanswered(trajectory, 0)
                                        : query::answer_or_unknown({query.moving.body(), query.fixed.body(), trajectory,
                                                                    query.options, 1, orbits});
        work += result.contact.work;
        if (query.progress)
            query.progress(segment + 1);
        if (result.contact.verdict != Verdict::clear)
            break;
    }
    result.contact.work = work;
    return result;
}

} // namespace chasles
