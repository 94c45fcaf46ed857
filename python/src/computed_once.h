// What an answer computes when it is asked for, and keeps.
#pragma once

#include "chasles/base/limit_of_thread.h"
#include "python/src/signals.h"

#include <memory>
#include <mutex>
#include <optional>

namespace chasles::python {

/// Shared by all copies of an answer.
template <class Value>
class ComputedOnce {
public:
    /// The value, computed without the GIL on the first call; once more if a limit ended that one. Ctrl-C ends it.
    template <class Compute>
    Value get(const Compute& compute) const {
        const WithoutGil without_gil; // first: who waits for the other thread must not hold it
        const EndsBySignals ends_by_signals;
        const std::lock_guard lock(kept_->mutex);
        if (kept_->value)
            return *kept_->value;
        Value value = compute();
        if (!is_cancelled())
            kept_->value = value;
        return value;
    }

private:
    struct Kept {
        std::mutex mutex;
        std::optional<Value> value;
    };
    std::shared_ptr<Kept> kept_ = std::make_shared<Kept>();
};

} // namespace chasles::python
