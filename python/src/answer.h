// Answers as Python objects: the library's answer with the bodies and the motion of its query.
#pragma once

#include "chasles/query/distance_gradient.h"
#include "python/src/body.h"
#include "python/src/computed_once.h"
#include "python/src/motions.h"

#include <nanobind/nanobind.h>
#include <optional>
#include <string>
#include <utility>

namespace chasles::python {

struct Answer {
    FirstContact found;
    nanobind::object moving; ///< the bodies of the query, kept alive by the answer
    nanobind::object fixed;
    TypedMotion motion;
    double margin;
    std::optional<double> hold = {};
    bool is_swapped = false; ///< the bodies have swapped their roles since the query; the motion has not changed
};

struct PathAnswer : Answer {
    std::size_t segment = 0;
    std::vector<Motion> path = {}; ///< all segments

    [[nodiscard]] bool is_last_segment() const { return segment + 1 == path.size(); }
};

struct LeastAnswer {
    LeastDistance found;
    nanobind::object moving; ///< as in Answer
    nanobind::object fixed;
    TypedMotion motion;
    bool is_swapped = false;
    std::optional<std::pair<std::string, std::string>> pair = {}; ///< of bodies of a scene: the first one moves
    ComputedOnce<DistanceGradient> gradient = {};
};

/// The references of an answer about two bodies. The bodies stay when the collector clears the others.
template <typename AnyAnswer, typename Visit>
    requires requires(AnyAnswer& answer) {
        answer.found;
        answer.moving;
        answer.motion;
    }
void for_each_reference(AnyAnswer& answer, const Visit& visit) {
    for_each_reference(answer.motion, visit);
}

/// The text of a certificate. Throws InvalidInput where it cannot be made.
std::string certificate_of(const Answer& answer);
std::string certificate_of_path(const PathAnswer& answer);

/// "clear until 0.5", or "clear at the start" where nothing else was asked.
std::string clear_until_text(double until);

/// "contact at time 0.25 (uncertain: ...), bolt on nut, overlapping, 1 contact: edge 0-3 on edge 2-6". `bodies` is
/// empty or "bolt on nut". Times are in [0, 1].
std::string summary(const FirstContact& found, const std::string& bodies = "");
/// The same with times that may be stamps: `why_uncertain` was asked before.
std::string summary(const FirstContact& found, const std::string& bodies, const std::string& why_uncertain);

/// What the text of a least distance that is not certain says about it: " (uncertain: ...)".
const char* doubt_about(const Bracket& distance);

/// "edge 0-3 on edge 2-6"
std::string text_of(const Contact& contact);

nanobind::tuple tuple_of(const std::vector<Contact>& contacts);

} // namespace chasles::python
