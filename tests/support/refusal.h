// The error message of a call.
#pragma once

#include "chasles/base/invalid_input.h"

#include <string>

namespace chasles::test {

/// The message of the exception that `call` throws, or "accepted".
template <class Refused = InvalidInput, class Call>
std::string refusal(const Call& call) {
    try {
        call();
    } catch (const Refused& refused) {
        return refused.what();
    }
    return "accepted";
}

} // namespace chasles::test
