// Names of the library's enumerators, and the members of chasles.enums that carry them.
#pragma once

#include "chasles/query/first_contact.h"

#include <nanobind/nanobind.h>
#include <string_view>

namespace chasles::python {

namespace nb = nanobind;

std::string_view name_of(Verdict verdict);
std::string_view name_of(ContactKind kind);

/// The member of Python's enumeration.
nb::object member_of(Verdict verdict);
nb::object member_of(ContactKind kind);

/// By its member or its name. Throws InvalidInput that lists the names.
Find find_from(nb::handle argument);

} // namespace chasles::python
