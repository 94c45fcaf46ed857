// Faces as Python hands them over: an array, or lists of any lengths.
#pragma once

#include "python/src/body.h"

#include <nanobind/nanobind.h>

namespace chasles::python {

/// From an array of shape (m, k), or a sequence of m sequences of vertex indices. Throws InvalidInput "faces: WHY".
Faces faces_from(nanobind::handle argument);

} // namespace chasles::python
