// The only exception type that the library throws: for input that cannot be used.
// Every layer may include this file.
#pragma once

#include "chasles/base/export.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace chasles {

/// Wrong input from the caller. `what()` is one line "WHAT: WHERE: WHY" without a line break, for example
/// "peg.obj: line 12: a vertex needs three finite numbers". The library throws no other type.
class CHASLES_EXPORT InvalidInput : public std::invalid_argument {
public:
    explicit InvalidInput(std::string message) : std::invalid_argument(whole(std::move(message))) {}

private:
    /// A name in the message may have a character with the code 0, where `what()` would end.
    static std::string whole(std::string message) {
        std::replace(message.begin(), message.end(), '\0', '?');
        return message;
    }
};

} // namespace chasles
