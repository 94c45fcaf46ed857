// The only exception type that the library throws: for input that cannot be used.
// Every layer may include this file.
#pragma once

#include "chasles/base/export.h"

#include <stdexcept>
#include <string>

namespace chasles {

/// Wrong input from the caller. `what()` is one line "WHAT: WHERE: WHY" without a line break, for example
/// "peg.obj: line 12: a vertex needs three finite numbers". The library throws no other type.
class CHASLES_EXPORT InvalidInput : public std::invalid_argument {
public:
    explicit InvalidInput(const std::string& message) : std::invalid_argument(message) {}
};

} // namespace chasles
