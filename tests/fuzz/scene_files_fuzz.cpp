// Any byte sequence as glTF, GLB, COLLADA and 3MF, and as the model within a 3MF whose archive is whole: checksums
// would keep nearly all damaged models from being read.
#include "tests/fuzz/sound_mesh.h"
#include "tests/io/file_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace chasles;
    const std::string_view bytes = fuzz::text_of(data, size);
    fuzz::read_or_refuse([&] { return io::merged(io::read_gltf(bytes)); });
    fuzz::read_or_refuse([&] { return io::merged(io::read_collada(bytes)); });
    fuzz::read_or_refuse([&] { return io::merged(io::read_3mf(bytes)); });
    fuzz::read_or_refuse([&] { return io::merged(io::read_3mf(tests::threemf(std::string(bytes)))); });
    return 0;
}
