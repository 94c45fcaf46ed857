#include "chasles/io/cut_polygons.h"

#include "chasles/base/number_text.h"
#include "chasles/io/read_file.h"
#include "chasles/mesh/polygon_plane.h"

#include <algorithm>

namespace chasles::io {

void warn_of_cut_polygons(const std::filesystem::path& file, const PolygonSoup& given, const Polyhedron& made,
                          std::vector<std::string>& warnings) {
    std::vector<int> parts(given.faces.size());
    for (std::size_t face = 0; face < made.face_count(); ++face)
        ++parts[made.source_face(face)];
    std::size_t count = 0;
    double farthest = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] < 2)
            continue;
        const PolygonProjection polygon = project_polygon(given.vertices, given.faces[i]);
        if (polygon.is_flat || polygon.deviation <= planar_within * std::max(polygon.size, polygon.magnitude))
            continue;
        ++count;
        farthest = std::max(farthest, polygon.deviation);
    }
    if (count == 0)
        return;
    const bool is_one = count == 1;
    warnings.push_back(shown_name(file) + ": " + std::to_string(count) +
                       (is_one ? " polygon leaves its plane by " : " polygons leave their planes by up to ") +
                       number_text(farthest, 3) + (is_one ? ", and was" : ", and were") +
                       " cut into triangles: quads from their first corner, as most programs do");
}

} // namespace chasles::io
