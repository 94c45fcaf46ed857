// Options that several queries share, with their docstrings.
#pragma once

#include "chasles/query/path.h"
#include "python/src/docstrings.h"

#include <string>

namespace chasles::python {

inline constexpr double default_time_tolerance = QueryOptions().time_tolerance;

#define CHASLES_OPTION_TYPES "margin: float = 0.0, hold: float | None = None, time_tolerance: float = 1e-12, "
#define CHASLES_FIND_TYPE "find: chasles.enums.Find | str = 'first'"

/// A paragraph, indented as the description of a parameter.
inline std::string indented(std::string text) {
    for (std::size_t line = text.find('\n'); line != std::string::npos; line = text.find('\n', line + 5))
        text.insert(line + 1, "    ");
    return "    " + text + "\n";
}

/// The descriptions of the shared options for a docstring. `max_turn` is the text of the option of that name.
inline std::string option_docs(const std::string& max_turn) {
    return "margin : float\n" + indented(doc("QueryOptions.margin")) + "hold : float, optional\n" +
           indented(doc("QueryOptions.hold")) + "time_tolerance : float\n" +
           indented(doc("QueryOptions.time_tolerance")) + max_turn + "find : Find or str\n" +
           indented(std::string("'first': ") + doc("Find.first") + ";\n'any': " + doc("Find.any") +
                    ";\n'first_with_all_contacts': " + doc("Find.first_with_all_contacts"));
}

} // namespace chasles::python
