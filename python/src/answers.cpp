// chasles.FirstContact and chasles.PathContact.
#include "chasles/base/number_text.h"
#include "python/src/answer_members.h"
#include "python/src/bind.h"
#include "python/src/names.h"
#include "view/why_uncertain.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>

namespace chasles::python {

std::string clear_until_text(double until) {
    return until == 0 ? "clear at the start" : fmt::format("clear until {}", until);
}

std::string summary(const FirstContact& found, const std::string& bodies) {
    return summary(found, bodies, view::why_uncertain(found));
}

std::string summary(const FirstContact& found, const std::string& bodies, const std::string& why_uncertain) {
    if (found.verdict == Verdict::unknown)
        return fmt::format("unknown: the limit was reached; proven clear until {}", found.clear_until);
    if (found.verdict == Verdict::clear)
        return found.clear_until < 1 ? clear_until_text(found.clear_until) : "clear";
    std::string text =
        found.verdict == Verdict::contact ? "contact at time " + time_text(found.time.lower) : "contact at the start";
    if (!found.certain)
        text += " (uncertain: " + why_uncertain + ")";
    if (!bodies.empty())
        text += ", " + bodies;
    if (found.overlap && found.overlap->certain)
        text += ", overlapping";
    if (found.inside)
        text += found.inside->moving_is_inside ? ", the moving body inside of the fixed one"
                                               : ", the fixed body inside of the moving one";
    if (!found.contacts.empty())
        text += fmt::format(", {} contact{}: {}{}", found.contacts.size(), found.contacts.size() == 1 ? "" : "s",
                            text_of(found.contacts.front()), found.contacts.size() > 1 ? ", ..." : "");
    return text;
}

namespace {

constexpr MemberDocs member_docs{
    .time =
        "Lower end of the bracket around the time of the first contact (with find='any': of any contact), in [0, 1]; 0 "
        "if clear.",
    .certain = doc("FirstContact.certain"),
    .contacts = "The feature pairs in contact, in the world frame at `time`.",
    .contacts_cut = doc("FirstContact.contacts_cut"),
    .overlap = doc("FirstContact.overlap"),
    .pose = doc("FirstContact.pose"),
    .motion = "The motion of the query; for a path, the motion of `segment`. A swapped answer keeps the motion of the "
              "query.",
};

void bind_first_contact(nb::module_& module) {
    nb::class_<Answer> type(module, "FirstContact", doc("FirstContact"), collected<Answer>());
    bind_members(type, member_docs);
    type.def_prop_ro(
            "verdict", [](const Answer& a) { return member_of(a.found.verdict); },
            nb::sig("def verdict(self) -> chasles.enums.Verdict"), doc("Verdict"))
        .def_prop_ro(
            "held", [](const Answer& a) { return tuple_of(a.found.held); },
            nb::sig("def held(self) -> tuple[Contact, ...]"), doc("FirstContact.held"))
        .def_prop_ro(
            "clear_until", [](const Answer& a) { return a.found.clear_until; }, doc("FirstContact.clear_until"))
        .def_ro("margin", &Answer::margin, "The margin of the query.")
        .def("certificate", certificate_of,
             "A proof of the answer, as text that programs of others can check (docs/certificate.md). Motions are "
             "screws, sweeps, velocities, twists, even hinges and sliders, `TimedPoses`, and products of these; one or "
             "both bodies move. It is found anew, beside the search.\n\nReturns\n-------\nstr\n\nRaises\n"
             "------\nInvalidInput\n    For what cannot be certified, or is not proven: with the reason.")
        .def("__repr__", [](const Answer& a) { return "<chasles.FirstContact: " + summary(a.found) + ">"; });
}

/// Segments before the one of the answer are proven clear, too.
std::string summary_of_path(const PathAnswer& a) {
    const bool is_clear = a.found.verdict == Verdict::clear;
    if (a.found.verdict == Verdict::unknown)
        return fmt::format("unknown: the limit was reached; proven clear until {} in segment {}", a.found.clear_until,
                           a.segment);
    return (is_clear ? "" : fmt::format("segment {}, ", a.segment)) +
           summary(a.found, "", view::why_uncertain(a.found, a.is_last_segment()));
}

} // namespace

void bind_answers(nb::module_& module) {
    bind_first_contact(module);
    nb::class_<PathAnswer, Answer>(module, "PathContact", doc("PathContact"), collected<PathAnswer>())
        .def_ro("segment", &PathAnswer::segment, doc("PathContact.segment"))
        .def("certificate", certificate_of_path, "As `FirstContact.certificate`, for all segments of the path.")
        .def("swapped", swapped<PathAnswer>, doc("FirstContact.swapped"))
        .def("__repr__", [](const PathAnswer& a) { return "<chasles.PathContact: " + summary_of_path(a) + ">"; });
}

} // namespace chasles::python
