// A limit for questions: of time, or until the caller has enough. Every layer may include this file.
#pragma once

#include "chasles/base/export.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <limits>

namespace chasles {

/// Thrown by a question that a Limit ends and that has no answer "unknown".
struct CHASLES_EXPORT Cancelled : std::exception {
    explicit Cancelled(double proven_until = 0) : clear_until(proven_until) {}
    [[nodiscard]] const char* what() const noexcept override {
        return "a limit was reached before the answer, and nothing of it is known: ask again with more time";
    }

    double clear_until; ///< what the question has proven, where it is one about a motion: a time in [0, 1]
};

/// Limits all questions of the thread that makes it, while it exists. It limits the threads that they start, too. A
/// question that reaches the limit ends soon, mostly within milliseconds. First contacts of pairs, paths, batches,
/// scenes and robots then have the verdict `unknown`, and `clear_until` says what is proven. Least distances of pairs
/// and robots have the bracket so far; where time is limited, they begin with rough ones. Proofs of pairs of links stay
/// open. All others throw Cancelled. A limit inside another one shortens it.
///
///     const Limit limit(2.0); // seconds
///     const FirstContact found = first_contact({peg, hole, motion});
class CHASLES_EXPORT Limit {
public:
    /// The time counts from now; one that is not positive, or NaN, is over at once. `goes_on` is called some fifty
    /// times a second, from any one of the threads. The limit is reached where it returns false. If it throws, the
    /// question ends with this exception. It may be empty.
    explicit Limit(double seconds = std::numeric_limits<double>::infinity(), std::function<bool()> goes_on = {});
    ~Limit();
    Limit(const Limit&) = delete;
    Limit& operator=(const Limit&) = delete;

    /// Whether it, or one around it, limits the time.
    [[nodiscard]] bool has_end() const { return end_ != Clock::time_point::max() || (outer_ && outer_->has_end()); }
    /// Whether the limit is reached. For any thread.
    [[nodiscard]] bool is_over() const;

private:
    using Clock = std::chrono::steady_clock;
    using Ticks = Clock::duration::rep;

    [[nodiscard]] bool asks_to_end(Clock::time_point now) const;

    const Limit* outer_; ///< of the same thread; null if there is none
    Clock::time_point end_;
    std::function<bool()> goes_on_;
    mutable std::atomic<bool> is_over_ = false;
    mutable std::atomic<Ticks> next_look_ = 0; ///< when `goes_on` is to be called again
};

} // namespace chasles
