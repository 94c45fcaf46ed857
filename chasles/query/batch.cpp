#include "chasles/query/batch.h"

#include "chasles/base/parallel_for.h"
#include "chasles/query/pair_query.h"

#include <mutex>

namespace chasles {

namespace {

/// Fills `count` results, on several threads.
template <class Answer>
std::vector<FirstContact> all_answers(std::size_t count, const BatchOptions& options, Answer answer) {
    std::vector<FirstContact> results(count);
    std::size_t done = 0;
    std::mutex reporting;
    parallel_for(options.threads, count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            results[i] = answer(i);
        const std::lock_guard lock(reporting);
        done += end - begin;
        if (options.progress)
            options.progress(done);
    });
    return results;
}

} // namespace

std::vector<FirstContact> first_contact_batch(const BatchQuery& query) {
    query::check_options(query.options);
    const Body& moving = query.moving.body();
    const Body& fixed = query.fixed.body();
    return all_answers(query.motions.size(), query.batch, [&](std::size_t i) {
        return query::answer({moving, fixed, query.motions[i].trajectory(), query.options});
    });
}

std::vector<FirstContact> first_contact_batch(std::span<const FirstContactQuery> queries, const BatchOptions& options) {
    for (const FirstContactQuery& query : queries)
        query::check_options(query.options);
    return all_answers(queries.size(), options, [&](std::size_t i) {
        const FirstContactQuery& query = queries[i];
        return query::answer({query.moving.body(), query.fixed.body(), query.motion.trajectory(), query.options});
    });
}

} // namespace chasles
