// The bytes behind a glTF file: its buffers, buffer views and accessors.
#pragma once

#include "chasles/io/gltf_json.h"
#include "chasles/io/mesh_files.h"
#include "chasles/io/scene_graph.h"

#include <Eigen/Core>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// Reads accessors. Each buffer is decoded once.
class GltfBuffers {
public:
    /// `binary` is the chunk of a GLB file. `file_beside` reads the files that buffers refer to.
    GltfBuffers(const Json& file, std::string_view binary, const FileBeside& file_beside)
        : file_(file), binary_(binary), file_beside_(file_beside) {}

    /// Numbers of an accessor, one after another, with sparse values put in. Normalised integers become -1 to 1.
    std::vector<double> numbers(std::size_t accessor, const char* type, SizeBudget& budget);

private:
    struct Layout;

    void copy(const Layout& layout, std::vector<double>& numbers);
    void add_sparse(const GltfItem& accessor, const Layout& layout, std::vector<double>& numbers);
    std::string_view view(std::size_t index);
    std::string_view buffer(std::size_t index);
    std::string decoded_buffer(const GltfItem& item) const;

    const Json& file_;
    std::string_view binary_;
    const FileBeside& file_beside_;
    std::map<std::size_t, std::string> buffers_;
};

} // namespace chasles::io
