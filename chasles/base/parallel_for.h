// Runs independent pieces of work on several threads. The results do not depend on the number of threads.
// This file is not part of the public interface. A build with CHASLES_ONE_THREAD (a machine without threads, as
// WebAssembly) needs neither oneTBB nor locks; this file is the only one that knows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#if !defined(CHASLES_ONE_THREAD)
#include "chasles/base/limit_of_thread.h"

#include <mutex>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace chasles {

#if defined(CHASLES_ONE_THREAD)

/// There is no other thread to lock out.
struct Mutex {};
struct Lock {
    explicit Lock(Mutex& /*mutex*/) {}
};

/// Calls work(0, count) if count is not 0.
template <typename Work>
void parallel_for(unsigned /*threads*/, std::size_t count, const Work& work) {
    if (count > 0)
        work(std::size_t{0}, count);
}

#else

/// What one thread at a time may hold, by a Lock.
using Mutex = std::mutex;
using Lock = std::lock_guard<std::mutex>;

/// Calls work(begin, end) for ranges that together make up [0, count), concurrently on at most `threads` threads (0:
/// all cores), within the limit of this thread. The calling thread does the work if `threads` or count is 1.
template <typename Work>
void parallel_for(unsigned threads, std::size_t count, const Work& work) {
    if (threads == 1 || count < 2) {
        if (count > 0)
            work(std::size_t{0}, count);
        return;
    }
    // More threads than cores save no time, and oneTBB would print a warning on standard error.
    const auto cores = static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
    oneapi::tbb::task_arena arena(int(threads == 0 ? cores : std::min(threads, cores)));
    arena.execute([&] {
        using Range = oneapi::tbb::blocked_range<std::size_t>;
        oneapi::tbb::parallel_for(Range(0, count, 1), [&, limit = LimitOfThread::get()](const Range& range) {
            const LimitOfThread same_limit(limit);
            work(range.begin(), range.end());
        });
    });
}

#endif

/// Calls work(index, begin, end) for consecutive chunks of [0, count) with `piece` elements each. The chunks do not
/// depend on the number of threads.
template <typename Work>
void parallel_chunks(unsigned threads, std::size_t count, std::size_t piece, const Work& work) {
    parallel_for(threads, (count + piece - 1) / piece, [&](std::size_t first, std::size_t last) {
        for (std::size_t index = first; index < last; ++index)
            work(index, index * piece, std::min((index + 1) * piece, count));
    });
}

/// What `append(begin, end, items)` appends for each chunk, one after another.
template <typename Item, typename Append>
std::vector<Item> joined_chunks(unsigned threads, std::size_t count, std::size_t piece, const Append& append) {
    std::vector<std::vector<Item>> chunks((count + piece - 1) / piece);
    parallel_chunks(threads, count, piece,
                    [&](std::size_t index, std::size_t begin, std::size_t end) { append(begin, end, chunks[index]); });
    std::vector<Item> items;
    for (const std::vector<Item>& chunk : chunks)
        items.insert(items.end(), chunk.begin(), chunk.end());
    return items;
}

} // namespace chasles
