// The answers of a batch, on several threads.
#pragma once

#include "chasles/base/limit_of_thread.h"
#include "chasles/base/parallel_for.h"
#include "chasles/query/batch.h"

namespace chasles::query {

/// `answer(i)` for each of `count` questions, in order; `none` where the limit of the thread leaves no time.
template <class A, class Answer>
std::vector<A> all_answers(std::size_t count, const BatchOptions& options, Answer answer, const A& none = {}) {
    std::vector<A> results(count, none);
    std::size_t done = 0;
    Mutex reporting;
    parallel_for(options.threads, count, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !is_cancelled(); ++i)
            results[i] = answer(i);
        const Lock lock(reporting);
        done += end - begin;
        if (options.progress)
            options.progress(done);
    });
    return results;
}

} // namespace chasles::query
