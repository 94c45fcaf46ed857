#include "chasles/base/limit_of_thread.h"

#include <algorithm>

namespace chasles {
namespace {

thread_local const Limit* limit_of_thread = nullptr;

std::chrono::steady_clock::duration ticks_of(double seconds) {
    constexpr double a_century = 3e9;
    const std::chrono::duration<double> time(seconds > 0 ? std::min(seconds, a_century) : 0);
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(time);
}

} // namespace

Limit::Limit(double seconds, std::function<bool()> goes_on)
    : outer_(limit_of_thread), end_(Clock::time_point::max()), goes_on_(std::move(goes_on)) {
    if (seconds != std::numeric_limits<double>::infinity())
        end_ = Clock::now() + ticks_of(seconds);
    limit_of_thread = this;
}

Limit::~Limit() {
    limit_of_thread = outer_;
}

bool Limit::is_over() const {
    if (is_over_)
        return true;
    const Clock::time_point now = Clock::now();
    if (now >= end_ || asks_to_end(now) || (outer_ && outer_->is_over()))
        is_over_ = true;
    return is_over_;
}

/// One thread at a time asks.
bool Limit::asks_to_end(Clock::time_point now) const {
    constexpr auto interval = std::chrono::milliseconds(20);
    Ticks next = next_look_;
    const Ticks ticks = now.time_since_epoch().count();
    return goes_on_ && ticks >= next &&
           next_look_.compare_exchange_strong(next, ticks + Clock::duration(interval).count()) && !goes_on_();
}

const Limit* LimitOfThread::get() {
    return limit_of_thread;
}

LimitOfThread::LimitOfThread(const Limit* limit) : former_(limit_of_thread) {
    limit_of_thread = limit;
}

LimitOfThread::~LimitOfThread() {
    limit_of_thread = former_;
}

} // namespace chasles
