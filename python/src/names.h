// Conversion between the library's enumerators and the members of chasles.enums.
#pragma once

#include "chasles/query/first_contact.h"
#include "view/motion_numbers.h"

#include <nanobind/nanobind.h>

namespace chasles::python {

namespace nb = nanobind;

/// The member of Python's enumeration.
nb::object member_of(Verdict verdict);
nb::object member_of(ContactKind kind);

/// The enumerator of a member or of a name. Throws InvalidInput with a list of the names.
Find find_from(nb::handle argument);

/// Likewise of what is solid.
Solid solid_from(nb::handle argument);
const char* name_of(Solid solid);

/// The kind of motion with this name. Throws InvalidInput with a list of the names.
view::MotionKind kind_from(nb::handle argument);

} // namespace chasles::python
