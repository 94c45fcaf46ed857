#include "python/src/names.h"

#include "chasles/base/invalid_input.h"
#include "python/src/arrays.h"
#include "view/names.h"

#include <array>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <string>

namespace chasles::python {
namespace {

constexpr std::array<std::string_view, 3> finds{"first", "any", "first_with_all_contacts"};
constexpr std::array<const char*, 3> solids{"automatic", "yes", "no"};

/// The members of a Python enumeration in the order of the library's enumerators. They are never destroyed, because
/// Python may have ended before static objects are destroyed.
template <typename Enumeration, std::size_t count>
const std::array<nb::object, count>& members(const char* type) {
    auto* const found = new std::array<nb::object, count>;
    const nb::object enumeration = nb::module_::import_("chasles.enums").attr(type);
    for (std::size_t i = 0; i < count; ++i)
        (*found)[i] = enumeration.attr(nb::cast(view::name_of(Enumeration(i))));
    return *found;
}

} // namespace

nb::object member_of(Verdict verdict) {
    static const auto& found = members<Verdict, 4>("Verdict");
    return found[std::size_t(verdict)];
}

nb::object member_of(ContactKind kind) {
    static const auto& found = members<ContactKind, 6>("ContactKind");
    return found[std::size_t(kind)];
}

Find find_from(nb::handle argument) {
    std::string_view name;
    if (nb::try_cast(argument, name)) // members are strings too
        for (std::size_t i = 0; i < finds.size(); ++i)
            if (name == finds[i])
                return Find(i);
    throw InvalidInput("find: " + text_of_argument(argument) + ": must be 'first', 'any' or 'first_with_all_contacts'");
}

const char* name_of(Solid solid) {
    return solids[std::size_t(solid)];
}

Solid solid_from(nb::handle argument) {
    std::string_view name;
    if (nb::try_cast(argument, name))
        for (std::size_t i = 0; i < solids.size(); ++i)
            if (name == solids[i])
                return Solid(i);
    throw InvalidInput("solid: " + text_of_argument(argument) + ": must be 'automatic', 'yes' or 'no'");
}

view::MotionKind kind_from(nb::handle argument) {
    constexpr std::array kinds{view::MotionKind::screw, view::MotionKind::sweep, view::MotionKind::velocity,
                               view::MotionKind::twist};
    std::string_view name;
    if (nb::try_cast(argument, name))
        for (const view::MotionKind kind : kinds)
            if (name == view::name_of(kind))
                return kind;
    throw InvalidInput("motion: " + text_of_argument(argument) + ": must be 'screw', 'sweep', 'velocity' or 'twist'");
}

} // namespace chasles::python
