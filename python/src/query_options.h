// Options that several queries share, with their docstrings.
#pragma once

#include "chasles/query/path.h"
#include "python/src/docstrings.h"

#include <functional>
#include <optional>
#include <span>
#include <string>

namespace chasles::python {

struct QueryOptions {
    double margin;
    std::optional<double> hold;
    double time_tolerance;
    double max_turn;
    Find find;

    [[nodiscard]] FirstContact ask(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion) const {
        return first_contact({.moving = moving,
                              .fixed = fixed,
                              .motion = motion,
                              .margin = margin,
                              .hold = hold,
                              .time_tolerance = time_tolerance,
                              .max_turn = max_turn,
                              .find = find});
    }

    [[nodiscard]] PathContact ask_path(const Polyhedron& moving, const Polyhedron& fixed, std::span<const Pose> poses,
                                       const std::function<void(std::size_t)>& progress) const {
        return first_contact_on_path({.moving = moving,
                                      .fixed = fixed,
                                      .poses = poses,
                                      .margin = margin,
                                      .time_tolerance = time_tolerance,
                                      .max_turn = max_turn,
                                      .find = find,
                                      .progress = progress});
    }
};

inline constexpr double default_time_tolerance = 1e-12;
inline constexpr double default_max_turn = std::numbers::pi / 18;

#define CHASLES_OPTION_TYPES                                                                                           \
    "margin: float = 0.0, hold: float | None = None, time_tolerance: float = 1e-12, "                                  \
    "max_turn: float = math.pi / 18, find: chasles.enums.Find | str = "

/// A paragraph, indented as the description of a parameter.
inline std::string indented(std::string text) {
    for (std::size_t line = text.find('\n'); line != std::string::npos; line = text.find('\n', line + 5))
        text.insert(line + 1, "    ");
    return "    " + text + "\n";
}

/// The descriptions of the shared options for a docstring.
inline std::string option_docs(bool with_hold = true) {
    const std::string hold = "hold : float, optional\n" + indented(doc("FirstContactQuery.hold"));
    return "margin : float\n" + indented(doc("FirstContactQuery.margin")) + (with_hold ? hold : "") +
           "time_tolerance : float\n" + indented(doc("FirstContactQuery.time_tolerance")) + "max_turn : float\n" +
           indented(doc("FirstContactQuery.max_turn")) + "find : Find or str\n" +
           indented(std::string("'first': ") + doc("Find.first") + ";\n'any': " + doc("Find.any") +
                    ";\n'first_with_all_contacts': " + doc("Find.first_with_all_contacts"));
}

} // namespace chasles::python
