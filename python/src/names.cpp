#include "python/src/names.h"

#include "chasles/invalid_input.h"

#include <array>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <string>

namespace chasles::python {
namespace {

constexpr std::array<std::string_view, 3> verdicts{"clear", "contact", "contact_at_start"};
constexpr std::array<std::string_view, 6> kinds{"vertex_face", "face_vertex", "edge_edge",
                                                "vertex_edge", "edge_vertex", "vertex_vertex"};
constexpr std::array<std::string_view, 3> finds{"first", "any", "first_with_all_contacts"};

/// The members of one enumeration in the order of the library's, looked up once. Never destroyed: Python may be gone by
/// then.
template <std::size_t count>
using Members = std::array<nb::object, count>;

template <std::size_t count>
const Members<count>& members(const char* type, const std::array<std::string_view, count>& names) {
    auto* const found = new Members<count>;
    const nb::object enumeration = nb::module_::import_("chasles.enums").attr(type);
    for (std::size_t i = 0; i < count; ++i)
        (*found)[i] = enumeration.attr(names[i].data());
    return *found;
}

} // namespace

std::string_view name_of(Verdict verdict) {
    return verdicts[std::size_t(verdict)];
}

std::string_view name_of(ContactKind kind) {
    return kinds[std::size_t(kind)];
}

nb::object member_of(Verdict verdict) {
    static const Members<3>& found = members("Verdict", verdicts);
    return found[std::size_t(verdict)];
}

nb::object member_of(ContactKind kind) {
    static const Members<6>& found = members("ContactKind", kinds);
    return found[std::size_t(kind)];
}

Find find_from(nb::handle argument) {
    std::string_view name;
    if (nb::try_cast(argument, name)) // members are strings too
        for (std::size_t i = 0; i < finds.size(); ++i)
            if (name == finds[i])
                return Find(i);
    throw InvalidInput("find: " + nb::cast<std::string>(nb::repr(argument)) +
                       ": must be 'first', 'any' or 'first_with_all_contacts'");
}

} // namespace chasles::python
