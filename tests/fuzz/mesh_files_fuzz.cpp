// Any byte sequence as OBJ, OFF, PLY, STL and OctoMap: each reader reads or refuses it, and the mesh makes a body or is
// refused.
#include "tests/fuzz/sound_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = chasles::fuzz::text_of(data, size);
    for (const auto read : {chasles::io::read_obj, chasles::io::read_off, chasles::io::read_ply, chasles::io::read_stl,
                            chasles::io::read_octomap})
        chasles::fuzz::read_or_refuse([&] { return read(text); });
    return 0;
}
