#include "cli/untested_text.h"

#include "cli/report.h"

#include <algorithm>
#include <fmt/format.h>

namespace chasles::cli {
namespace {

constexpr std::size_t most_shown = 3; // of each reason; --json lists more

std::string why(UntestedReason reason) {
    switch (reason) {
    case UntestedReason::no_shapes:
        return "without shapes";
    case UntestedReason::at_rest:
        return "at rest";
    case UntestedReason::adjacent:
        return "adjacent";
    case UntestedReason::disabled:
        return "disabled by a file";
    case UntestedReason::ignored:
        return "ignored";
    case UntestedReason::touching_at_start:
        break;
    }
    return "touching at the start";
}

std::string names_of(const UntestedPairs& untested, UntestedReason reason) {
    if (reason == UntestedReason::no_shapes)
        return shortened(untested.without_shapes, most_shown, untested.without_shapes.size());
    std::vector<std::string> names;
    for (const UntestedPair& pair : untested.named)
        if (pair.reason == reason)
            names.push_back(pair.first + " and " + pair.second + (pair.is_with_scene ? " (scene)" : ""));
    return shortened(names, most_shown, untested.count(reason));
}

} // namespace

std::string clear_headline(const UntestedPairs& untested, const QueryOptions& options, double until) {
    if (untested.tested == 0)
        return "CLEAR: no pair is tested";
    const bool is_all = untested.total() == 0;
    if (options.hold)
        return fmt::format("CLEAR: proven that {} comes within {:.9g}, or nearer than at the start if that is less, "
                           "and {} within {:.9g}{}",
                           is_all ? "no pair that is held" : "no tested pair that is held", *options.hold,
                           is_all ? "no other pair" : "no other tested pair", options.margin,
                           until < 1 ? ", " + during(until) : "");
    return fmt::format("CLEAR: proven that {} {} {}", is_all ? "nothing" : "no tested pair",
                       options.margin > 0 ? fmt::format("comes within {:.9g}", options.margin) : "touches",
                       during(until));
}

std::string report(const UntestedPairs& untested) {
    if (untested.total() == 0)
        return {};
    std::string text;
    for (std::size_t i = 0; i < UntestedPairs::reasons; ++i)
        if (const auto reason = UntestedReason(i); untested.count(reason) > 0)
            text += fmt::format("{}{} {} ({})", text.empty() ? "" : ", ", untested.count(reason), why(reason),
                                names_of(untested, reason));
    return labelled("untested", fmt::format("{}: {}", counted(untested.total(), "pair"), text));
}

std::string report_of_scene(const UntestedPairs& untested, std::string_view option) {
    const bool all_rest = untested.tested == 0 && untested.count(UntestedReason::at_rest) > 0;
    if (!all_rest)
        return report(untested);
    return report(untested) +
           labelled("", option.empty() ? "--until 0 tests bodies at rest, too"
                                       : fmt::format("--all --until 0, without {}, tests bodies at rest", option));
}

} // namespace chasles::cli
