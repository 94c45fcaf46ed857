#include "view/page_data.h"

#include "view/drawn_mesh.h"
#include "view/round_surface.h"

namespace chasles::view {

Json mesh_json(const Polyhedron& body) {
    const DrawnMesh mesh = drawn_mesh(body);
    Json json = {{"origin", vector_json(mesh.origin)},
                 {"vertices", packed(mesh.vertices)},
                 {"triangles", packed(mesh.triangles)},
                 {"creases", packed(mesh.creases)}};
    if (const std::string part = drawn_in_part(body); !part.empty())
        json["drawn"] = part;
    return json;
}

bool is_same_body(const Polyhedron& a, const Polyhedron& b) {
    return a.vertices().data() == b.vertices().data();
}

// In JSON "<" occurs only inside strings, where an escape sequence may replace it. Without "<" no text can end the
// script element of the page.
std::string page_text(const Json& json) {
    const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text)
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    return safe;
}

} // namespace chasles::view
