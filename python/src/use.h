// Who is using an object that can change: any number of questions, or one change.
//
// Questions release the GIL (Python's global interpreter lock), so another thread may run while one is answered. A
// change then, or a second change, is refused: the searches read the object without locks.
//
// An answer that is shown with the object, as on a page, keeps the state that the object was in.
#pragma once

#include "chasles/base/invalid_input.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>

namespace chasles::python {

/// The questions and the change of one object that are running now. Read and written with the GIL only. A copy of an
/// object is not in use, and is in the same state.
class Use {
public:
    Use() = default;
    Use(const Use& other) : state_(other.state_) {}
    Use& operator=(const Use& other) {
        state_ = other.state_;
        return *this;
    }
    ~Use() = default;

    /// Of no other object of this process but its copies, and another one after each change.
    [[nodiscard]] std::uint64_t state() const { return state_; }
    void renew_state() { state_ = new_state(); }

    /// Throws InvalidInput "WHAT: WHY" if a change of the object is running.
    void begin_question(const std::string& what) {
        refuse_if_changing(what);
        ++questions_;
    }
    void end_question() { --questions_; }

    /// Throws InvalidInput "WHAT: WHY" if a question about the object or another change of it is running.
    void begin_change(const std::string& what) {
        refuse_if_changing(what);
        if (questions_ > 0)
            throw InvalidInput(what + ": a question about it is still running, in another thread or around this call; "
                                      "change it after the answer, or change a copy");
        is_changing_ = true;
    }
    /// A change that was refused has changed nothing.
    void end_change(bool was_refused) {
        is_changing_ = false;
        if (!was_refused)
            renew_state();
    }

    [[nodiscard]] bool is_changing() const { return is_changing_; }

private:
    static std::uint64_t new_state() {
        static std::atomic<std::uint64_t> last = 0;
        return ++last;
    }

    void refuse_if_changing(const std::string& what) const {
        if (is_changing_)
            throw InvalidInput(what + ": a change of it is still running, in another thread or around this call; wait "
                                      "until it is done");
    }

    std::size_t questions_ = 0;
    bool is_changing_ = false;
    std::uint64_t state_ = new_state();
};

/// While it exists, a question about the object is running. Made and destroyed with the GIL.
class Asking {
public:
    Asking(Use& use, const std::string& what) : use_(use) { use.begin_question(what); }
    ~Asking() { use_.end_question(); }
    Asking(const Asking&) = delete;
    Asking& operator=(const Asking&) = delete;

private:
    Use& use_;
};

/// While it exists, a change of the object is running. Made and destroyed with the GIL.
class Changing {
public:
    Changing(Use& use, const std::string& what) : use_(use) { use.begin_change(what); }
    ~Changing() { use_.end_change(std::uncaught_exceptions() > exceptions_); }
    Changing(const Changing&) = delete;
    Changing& operator=(const Changing&) = delete;

private:
    Use& use_;
    int exceptions_ = std::uncaught_exceptions();
};

} // namespace chasles::python
