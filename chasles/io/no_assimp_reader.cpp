// Takes the place of assimp_reader.cpp in a build without Assimp (the CMake option CHASLES_ASSIMP).
#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/text_scan.h"

namespace chasles::io {

PolygonSoup read_with_assimp(const std::filesystem::path& file, bool /*keeps_axes*/) {
    throw InvalidInput("no reader for the extension " + in_quotes(file.extension().string()) +
                       "; this build, without Assimp, reads OBJ, OFF, PLY and STL only");
}

} // namespace chasles::io
