// The limit that holds for what a thread does. Not part of the public interface.
#pragma once

#include "chasles/base/limit.h"

namespace chasles {

/// Takes a limit over to another thread, for the time of its existence.
class LimitOfThread {
public:
    /// That of this thread; null if there is none.
    static const Limit* get();

    explicit LimitOfThread(const Limit* limit);
    ~LimitOfThread();
    LimitOfThread(const LimitOfThread&) = delete;
    LimitOfThread& operator=(const LimitOfThread&) = delete;

private:
    const Limit* former_;
};

/// Whether the limit of this thread is reached.
inline bool is_cancelled() {
    const Limit* const limit = LimitOfThread::get();
    return limit && limit->is_over();
}
inline void throw_if_cancelled() {
    if (is_cancelled())
        throw Cancelled();
}

/// Counts work, and looks at the limit of the thread now and then: a look takes as long as several steps.
class Watch {
public:
    /// After so much more work; one unit is a pair of nodes.
    [[nodiscard]] bool is_over(int work) {
        if (!limit_)
            return false;
        left_ -= work;
        if (left_ > 0)
            return false;
        left_ = between_looks;
        return limit_->is_over();
    }

private:
    static constexpr int between_looks = 256;

    const Limit* limit_ = LimitOfThread::get();
    int left_ = between_looks;
};

} // namespace chasles
