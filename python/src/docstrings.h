// The comments of the public headers as docstrings (tools/docstrings.py). doc() of an undocumented name is a compile
// error.
#pragma once

#include <string_view>

namespace chasles::python {

struct Documented {
    std::string_view name; ///< "Scope.member"
    const char* text;
};

inline constexpr Documented documented[] = {
#include <docstrings_table.inl> // generated
};

consteval const char* doc(std::string_view name) {
    for (const Documented& entry : documented)
        if (entry.name == name)
            return entry.text;
    throw "no public header documents this name";
}

} // namespace chasles::python
