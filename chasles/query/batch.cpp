#include "chasles/query/batch.h"

#include "chasles/query/all_answers.h"
#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"

namespace chasles {

std::vector<FirstContact> first_contact_batch(const BatchQuery& query) {
    query::check_options(query.options);
    const Body& moving = query.moving.body();
    const Body& fixed = query.fixed.body();
    query::require_near(moving, fixed, query.motions);
    return query::all_answers<FirstContact>(query.motions.size(), query.batch, [&](std::size_t i) {
        return query::answer_or_unknown({moving, fixed, query.motions[i].trajectory(), query.options});
    });
}

std::vector<FirstContact> first_contact_batch(std::span<const FirstContactQuery> queries, const BatchOptions& options) {
    for (const FirstContactQuery& query : queries) {
        query::check_options(query.options);
        query::require(!query.memory, "memory", "serves one thread, and a batch has several: ask one by one");
        check_motion(query.moving, query.fixed, query.motion);
    }
    return query::all_answers<FirstContact>(queries.size(), options, [&](std::size_t i) {
        const FirstContactQuery& query = queries[i];
        return query::answer_or_unknown(
            {query.moving.body(), query.fixed.body(), query.motion.trajectory(), query.options});
    });
}

} // namespace chasles
