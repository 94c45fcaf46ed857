// The members of chasles.enums that carry the names of the library's enumerators.
#pragma once

#include "chasles/query/first_contact.h"

#include <nanobind/nanobind.h>

namespace chasles::python {

namespace nb = nanobind;

/// The member of Python's enumeration.
nb::object member_of(Verdict verdict);
nb::object member_of(ContactKind kind);

/// By its member or its name. Throws InvalidInput that lists the names.
Find find_from(nb::handle argument);

} // namespace chasles::python
