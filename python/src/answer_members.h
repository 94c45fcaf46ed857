// The Python members that all answers about one motion have.
#pragma once

#include "python/src/answer.h"
#include "python/src/docstrings.h"
#include "python/src/poses.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/variant.h>
#include <utility>

namespace chasles::python {

/// The answer with the bodies in each other's roles.
template <typename AnyAnswer>
AnyAnswer swapped(const AnyAnswer& answer) {
    AnyAnswer other = answer;
    other.found = answer.found.swapped();
    std::swap(other.moving, other.fixed);
    other.is_swapped = !answer.is_swapped;
    return other;
}

/// Docstrings of members whose meaning depends on the question.
struct MemberDocs {
    const char* time;
    const char* certain;
    const char* contacts;
    const char* contacts_cut;
    const char* overlap;
    const char* pose;
    const char* motion;
};

template <typename AnyAnswer>
void bind_times(nb::class_<AnyAnswer>& type, const MemberDocs& docs) {
    type.def_prop_ro(
            "time", [](const AnyAnswer& a) { return a.found.time.lower; }, docs.time)
        .def_prop_ro(
            "time_upper", [](const AnyAnswer& a) { return a.found.time.upper; },
            "Upper end of the bracket of the time.")
        .def_prop_ro(
            "tau", [](const AnyAnswer& a) { return a.found.tau.lower; },
            "Lower end of the same bracket in the paper's parameter.")
        .def_prop_ro(
            "tau_upper", [](const AnyAnswer& a) { return a.found.tau.upper; }, "Upper end of the bracket of tau.")
        .def_prop_ro(
            "certain", [](const AnyAnswer& a) { return a.found.certain; }, docs.certain);
}

/// `inside_of(answer)` is what is inside, optional.
template <typename AnyAnswer, typename InsideOf>
void bind_inside(nb::class_<AnyAnswer>& type, InsideOf inside_of) {
    type.def_prop_ro(
            "inside",
            [inside_of](const AnyAnswer& a) {
                const std::optional<Inside>& inside = inside_of(a);
                return inside ? std::optional(inside->moving_is_inside ? "moving" : "fixed") : std::nullopt;
            },
            nb::sig("def inside(self) -> str | None"),
            "'moving' or 'fixed': at time 0 this body, or a part of its surface, is inside of the other one, and the "
            "surfaces do "
            "not\nmeet. None if neither is. See the option `solid` of Polyhedron.")
        .def_prop_ro(
            "inside_vertex",
            [inside_of](const AnyAnswer& a) {
                const std::optional<Inside>& inside = inside_of(a);
                return inside ? std::optional(inside->vertex.first) : std::nullopt;
            },
            "With `inside`: the id of a vertex of that body in the other one.")
        .def_prop_ro(
            "inside_point",
            [inside_of](const AnyAnswer& a) {
                const std::optional<Inside>& inside = inside_of(a);
                return inside ? nb::object(array_of(inside->point)) : nb::object(nb::none());
            },
            nb::sig("def inside_point(self) -> " CHASLES_ARRAY " | None"),
            "With `inside`: the place of that vertex in the world.");
}

template <typename AnyAnswer>
void bind_places(nb::class_<AnyAnswer>& type, const MemberDocs& docs) {
    type.def_prop_ro(
            "contacts", [](const AnyAnswer& a) { return tuple_of(a.found.contacts); },
            nb::sig("def contacts(self) -> tuple[Contact, ...]"), docs.contacts)
        .def_prop_ro(
            "contacts_cut", [](const AnyAnswer& a) { return a.found.contacts_cut; }, docs.contacts_cut)
        .def_prop_ro(
            "overlap", [](const AnyAnswer& a) { return a.found.overlap; }, docs.overlap)
        .def_prop_ro(
            "pose", [](const AnyAnswer& a) { return matrix_of(a.found.pose); },
            nb::sig("def pose(self) -> " CHASLES_ARRAY), docs.pose)
        .def_prop_ro(
            "fixed_pose", [](const AnyAnswer& a) { return matrix_of(a.found.fixed_pose); },
            nb::sig("def fixed_pose(self) -> " CHASLES_ARRAY),
            "The pose of the fixed body in the world at the same time.");
    bind_inside(type, [](const AnyAnswer& a) -> const std::optional<Inside>& { return a.found.inside; });
}

template <typename AnyAnswer>
void bind_query(nb::class_<AnyAnswer>& type, const MemberDocs& docs) {
    type.def_prop_ro(
            "work", [](const AnyAnswer& a) { return a.found.work; }, doc("Work"))
        .def_prop_ro(
            "moving", [](const AnyAnswer& a) { return a.moving; }, nb::sig("def moving(self) -> Polyhedron"),
            "The moving body of the query.")
        .def_prop_ro(
            "fixed", [](const AnyAnswer& a) { return a.fixed; }, nb::sig("def fixed(self) -> Polyhedron"),
            "The fixed body of the query.")
        .def_prop_ro(
            "motion", [](const AnyAnswer& a) { return a.motion; },
            nb::sig("def motion(self) -> ScrewMotion | SweepMotion | ConstantVelocity | ConstantTwist | TimedPoses | "
                    "Trajectory | Motion"),
            docs.motion)
        .def_ro("is_swapped", &AnyAnswer::is_swapped, "Whether the bodies have swapped their roles since the query.")
        .def("swapped", swapped<AnyAnswer>, doc("FirstContact.swapped"));
}

template <typename AnyAnswer>
void bind_members(nb::class_<AnyAnswer>& type, const MemberDocs& docs) {
    bind_times(type, docs);
    bind_places(type, docs);
    bind_query(type, docs);
}

} // namespace chasles::python
