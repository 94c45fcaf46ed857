// Parts of the data of every page: packed arrays, meshes, and text that is safe in a page.
#pragma once

#include "view/answer_json.h"
#include "view/base64.h"

#include <span>
#include <string>

namespace chasles::view {

/// The numbers of an array in base64.
template <class Rows>
std::string packed(const Rows& rows) {
    return base64(std::as_bytes(std::span(rows)));
}

/// The drawn mesh of a body: origin, vertices, triangles and creases, and what is drawn of it (`drawn`) if not all is.
Json mesh_json(const Polyhedron& body);

/// Whether two handles share one body. A page holds its mesh once.
bool is_same_body(const Polyhedron& a, const Polyhedron& b);

/// The JSON in ASCII without "<", safe inside a script element of a page. Invalid UTF-8 is replaced.
std::string page_text(const Json& json);

} // namespace chasles::view
