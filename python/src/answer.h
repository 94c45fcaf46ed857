// Answers as Python objects: the library's answer with the bodies and the motion of its query.
#pragma once

#include "chasles/query/first_contact.h"
#include "python/src/body.h"
#include "python/src/motions.h"

#include <nanobind/nanobind.h>
#include <string>

namespace chasles::python {

struct Answer {
    FirstContact found;
    nanobind::object moving; ///< the bodies of the query, kept alive by the answer
    nanobind::object fixed;
    TypedMotion motion;
    double margin;
    bool is_swapped = false; ///< the bodies have swapped their roles since the query; the motion has not changed
};

struct PathAnswer : Answer {
    std::size_t segment = 0;
};

/// "edge 0-3 on edge 2-6"
std::string text_of(const Contact& contact);

nanobind::tuple tuple_of(const std::vector<Contact>& contacts);

} // namespace chasles::python
