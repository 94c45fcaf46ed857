// What a certificate says of a body. Source: docs/certificate.md, "Bodies" and "Outside".
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <string>
#include <utility>
#include <vector>

namespace chasles::certificate {

/// Throws InvalidInput "certificate: the NAME body: WHY" for a body whose faces are not those of its file.
void check_body(const Polyhedron& body, const std::string& name);

/// SHA-256 of the corners of all faces.
std::string hash_of(const Polyhedron& body);

/// A corner of each connected part of the surface: a face, and a number in its outline.
std::vector<std::pair<std::size_t, std::size_t>> corners_of_parts(const Polyhedron& body);

} // namespace chasles::certificate
