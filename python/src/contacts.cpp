// chasles.Contact, chasles.Overlap, chasles.Work and the rows of constraints.
#include "chasles/contact/constraint_rows.h"
#include "python/src/answer.h"
#include "python/src/arrays.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"
#include "python/src/names.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

nb::tuple tuple_of(FeatureKind kind, const Feature& feature) {
    return kind == FeatureKind::edge ? nb::make_tuple(feature.first, feature.second) : nb::make_tuple(feature.first);
}

std::string name_of(FeatureKind kind, const Feature& feature) {
    if (kind == FeatureKind::edge)
        return fmt::format("edge {}-{}", feature.first, feature.second);
    return fmt::format("{} {}", kind == FeatureKind::vertex ? "vertex" : "face", feature.first);
}

std::string repr_of_contact(const Contact& contact) {
    return fmt::format("<chasles.Contact: {} at {}, normal {}, gap {:.3g}, approach speed {:.6g}>", text_of(contact),
                       text_of(contact.point), text_of(contact.normal), contact.gap, contact.approach_speed);
}

std::string repr_of_overlap(const Overlap& overlap) {
    return fmt::format("<chasles.Overlap: edge {}-{} of the {} body through face {} of the other, at {}{}>",
                       overlap.edge.first, overlap.edge.second, overlap.edge_is_moving ? "moving" : "fixed",
                       overlap.face.first, text_of(overlap.point),
                       overlap.certain ? "" : " (uncertain: the edge may just miss the rim of the face)");
}

std::string repr_of_work(const Work& work) {
    return fmt::format(
        "Work(node_pairs={}, face_pairs={}, elementary_tests={}, root_brackets={}, refined={}, exact={})",
        work.node_pairs, work.face_pairs, work.elementary_tests, work.root_brackets, work.refined, work.exact);
}

nb::object constraint_rows_of(const std::vector<Contact>& contacts) {
    const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> rows = constraint_rows(contacts);
    return array_of({rows.data(), std::size_t(rows.size())}, {std::size_t(rows.rows()), 6});
}

void bind_contact(nb::module_& module) {
    nb::class_<Contact>(module, "Contact", doc("Contact"))
        .def_prop_ro(
            "kind", [](const Contact& c) { return member_of(c.kind); },
            nb::sig("def kind(self) -> chasles.enums.ContactKind"), doc("ContactKind"))
        .def_prop_ro(
            "moving", [](const Contact& c) { return tuple_of(moving_feature_kind(c.kind), c.moving); },
            nb::sig("def moving(self) -> tuple[int, ...]"),
            "The feature of the moving body: the id of a vertex or a face, or the two vertices of an edge. Ids count "
            "what\n"
            "was given, from 0: faces that were left out or cut are those of Polyhedron.source_faces.")
        .def_prop_ro(
            "fixed", [](const Contact& c) { return tuple_of(fixed_feature_kind(c.kind), c.fixed); },
            nb::sig("def fixed(self) -> tuple[int, ...]"), "The feature of the fixed body, in the same form.")
        .def_prop_ro(
            "point", [](const Contact& c) { return array_of(c.point); }, nb::sig("def point(self) -> " CHASLES_ARRAY),
            doc("Contact.point"))
        .def_prop_ro(
            "normal", [](const Contact& c) { return array_of(c.normal); },
            nb::sig("def normal(self) -> " CHASLES_ARRAY), doc("Contact.normal"))
        .def_ro("gap", &Contact::gap, doc("Contact.gap"))
        .def_ro("approach_speed", &Contact::approach_speed, doc("Contact.approach_speed"))
        .def("__repr__", repr_of_contact);
}

void bind_overlap(nb::module_& module) {
    nb::class_<Overlap>(module, "Overlap", doc("Overlap"))
        .def_ro("edge_is_moving", &Overlap::edge_is_moving, doc("Overlap.edge_is_moving"))
        .def_prop_ro(
            "edge", [](const Overlap& o) { return tuple_of(FeatureKind::edge, o.edge); },
            nb::sig("def edge(self) -> tuple[int, int]"), "The two vertices of the edge.")
        .def_prop_ro(
            "face", [](const Overlap& o) { return o.face.first; },
            "The id of the face among those that were given, as in Polyhedron.source_faces.")
        .def_prop_ro(
            "point", [](const Overlap& o) { return array_of(o.point); }, nb::sig("def point(self) -> " CHASLES_ARRAY),
            doc("Overlap.point"))
        .def_ro("certain", &Overlap::certain, doc("Overlap.certain"))
        .def("__repr__", repr_of_overlap);
}

void bind_work(nb::module_& module) {
    nb::class_<Work>(module, "Work", doc("Work"))
        .def_ro("node_pairs", &Work::node_pairs, doc("Work.node_pairs"))
        .def_ro("face_pairs", &Work::face_pairs, doc("Work.face_pairs"))
        .def_ro("elementary_tests", &Work::elementary_tests, doc("Work.elementary_tests"))
        .def_ro("root_brackets", &Work::root_brackets, doc("Work.root_brackets"))
        .def_ro("refined", &Work::refined, doc("Work.refined"))
        .def_ro("exact", &Work::exact, doc("Work.exact"))
        .def("__repr__", repr_of_work);
}

} // namespace

std::string text_of(const Contact& contact) {
    return name_of(moving_feature_kind(contact.kind), contact.moving) + " on " +
           name_of(fixed_feature_kind(contact.kind), contact.fixed);
}

nb::tuple tuple_of(const std::vector<Contact>& contacts) {
    nb::list list;
    for (const Contact& contact : contacts)
        list.append(nb::cast(contact));
    return nb::tuple(list);
}

void bind_contacts(nb::module_& module) {
    bind_contact(module);
    bind_overlap(module);
    bind_work(module);
    module.def("constraint_rows", constraint_rows_of, "contacts"_a,
               nb::sig("def constraint_rows(contacts: collections.abc.Sequence[Contact]) -> " CHASLES_ARRAY),
               doc("constraint_rows"));
}

} // namespace chasles::python
