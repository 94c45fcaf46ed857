// chasles.FirstContact and chasles.PathContact.
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"
#include "python/src/names.h"
#include "python/src/poses.h"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

namespace chasles::python {
namespace {

/// "contact at time 0.465661545123, 1 contact: edge 0-3 on edge 2-6"
std::string summary(const FirstContact& found) {
    if (found.verdict == Verdict::clear)
        return found.clear_until < 1 ? fmt::format("clear until {}", found.clear_until) : "clear";
    std::string text = found.verdict == Verdict::contact ? fmt::format("contact at time {:.12g}", found.time.lower)
                                                         : "contact at the start";
    if (!found.certain)
        text += " (uncertain)";
    if (found.overlap)
        text += ", overlapping";
    if (!found.contacts.empty())
        text += fmt::format(", {} contact{}: {}{}", found.contacts.size(), found.contacts.size() == 1 ? "" : "s",
                            text_of(found.contacts.front()), found.contacts.size() > 1 ? ", ..." : "");
    return text;
}

nb::class_<Answer> bind_first_contact(nb::module_& module) {
    nb::class_<Answer> type(module, "FirstContact", doc("FirstContact"));
    type.def_prop_ro(
            "verdict", [](const Answer& a) { return member_of(a.found.verdict); },
            nb::sig("def verdict(self) -> chasles.enums.Verdict"), doc("Verdict"))
        .def_prop_ro(
            "time", [](const Answer& a) { return a.found.time.lower; },
            "Lower end of the bracket around the time of the first contact (with find='any': of any "
            "contact), in [0, 1]; 0 if clear.")
        .def_prop_ro(
            "time_upper", [](const Answer& a) { return a.found.time.upper; }, "Upper end of the bracket of the time.")
        .def_prop_ro(
            "tau", [](const Answer& a) { return a.found.tau.lower; },
            "Lower end of the same bracket in the paper's parameter.")
        .def_prop_ro(
            "tau_upper", [](const Answer& a) { return a.found.tau.upper; }, "Upper end of the bracket of tau.")
        .def_prop_ro(
            "certain", [](const Answer& a) { return a.found.certain; }, doc("FirstContact.certain"))
        .def_prop_ro(
            "contacts", [](const Answer& a) { return tuple_of(a.found.contacts); },
            nb::sig("def contacts(self) -> tuple[Contact, ...]"),
            "The feature pairs in contact, in the world frame at `time`.")
        .def_prop_ro(
            "contacts_cut", [](const Answer& a) { return a.found.contacts_cut; }, doc("FirstContact.contacts_cut"))
        .def_prop_ro(
            "held", [](const Answer& a) { return tuple_of(a.found.held); },
            nb::sig("def held(self) -> tuple[Contact, ...]"), doc("FirstContact.held"))
        .def_prop_ro(
            "clear_until", [](const Answer& a) { return a.found.clear_until; }, doc("FirstContact.clear_until"))
        .def_prop_ro(
            "overlap", [](const Answer& a) { return a.found.overlap; }, doc("FirstContact.overlap"))
        .def_prop_ro(
            "pose", [](const Answer& a) { return matrix_of(a.found.pose); },
            nb::sig("def pose(self) -> " CHASLES_ARRAY), doc("FirstContact.pose"))
        .def_prop_ro(
            "fixed_pose", [](const Answer& a) { return matrix_of(a.found.fixed_pose); },
            nb::sig("def fixed_pose(self) -> " CHASLES_ARRAY),
            "The pose of the fixed body in the world at the same time.")
        .def_prop_ro(
            "work", [](const Answer& a) { return a.found.work; }, doc("Work"));
    return type;
}

/// The answer with the bodies in each other's roles. `AnyAnswer` may be a PathAnswer.
template <typename AnyAnswer>
AnyAnswer swapped(const AnyAnswer& answer) {
    AnyAnswer other = answer;
    other.found = answer.found.swapped();
    std::swap(other.moving, other.fixed);
    other.is_swapped = !answer.is_swapped;
    return other;
}

} // namespace

void bind_answers(nb::module_& module) {
    bind_first_contact(module)
        .def_prop_ro(
            "moving", [](const Answer& a) { return a.moving; }, nb::sig("def moving(self) -> Polyhedron"),
            "The moving body of the query.")
        .def_prop_ro(
            "fixed", [](const Answer& a) { return a.fixed; }, nb::sig("def fixed(self) -> Polyhedron"),
            "The fixed body of the query.")
        .def_prop_ro(
            "motion", [](const Answer& a) { return a.motion; },
            nb::sig("def motion(self) -> ScrewMotion | SweepMotion"),
            "The motion of the query; for a path, the motion of `segment`. A swapped answer keeps the motion of the "
            "query.")
        .def_ro("margin", &Answer::margin, "The margin of the query.")
        .def_ro("is_swapped", &Answer::is_swapped, "Whether the bodies have swapped their roles since the query.")
        .def("swapped", swapped<Answer>, doc("FirstContact.swapped"))
        .def("__repr__", [](const Answer& a) { return "<chasles.FirstContact: " + summary(a.found) + ">"; });
    nb::class_<PathAnswer, Answer>(module, "PathContact", doc("PathContact"))
        .def_ro("segment", &PathAnswer::segment, doc("PathContact.segment"))
        .def("swapped", swapped<PathAnswer>, doc("FirstContact.swapped"))
        .def("__repr__", [](const PathAnswer& a) {
            const bool is_clear = a.found.verdict == Verdict::clear;
            return "<chasles.PathContact: " + (is_clear ? "" : fmt::format("segment {}, ", a.segment)) +
                   summary(a.found) + ">";
        });
}

} // namespace chasles::python
