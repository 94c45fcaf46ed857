// Real meshes for the tests of this layer, which does not include the file readers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace chasles::test {

/// Unchecked vertices and faces.
struct Soup {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
};

/// The folder of external real inputs. If the folder does not exist, tests that need it are skipped.
inline std::filesystem::path shared_data() {
#ifdef CHASLES_DATA_DIR
    return CHASLES_DATA_DIR;
#else
    return std::filesystem::path(__FILE__).parent_path() / "../../../shared/data";
#endif
}

inline Soup read_obj(const std::filesystem::path& file) {
    Soup soup;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            Eigen::Vector3d& vertex = soup.vertices.emplace_back();
            words >> vertex.x() >> vertex.y() >> vertex.z();
        } else if (word == "f") {
            auto& face = soup.faces.emplace_back();
            while (words >> word)
                face.push_back(static_cast<std::uint32_t>(std::stoul(word) - 1));
        }
    }
    return soup;
}

/// One mesh of mesh-manifest.csv with the counts of other programs.
struct ManifestRow {
    std::string file;
    std::size_t vertices = 0;
    std::size_t distinct_vertices = 0;
    std::size_t faces = 0;
    std::size_t triangles = 0;
    std::size_t degenerate = 0; ///< with a repeated vertex
    std::size_t zero_area = 0;  ///< further faces without area
    std::size_t boundary_edges = 0;
    std::size_t nonmanifold_edges = 0;
};

/// The OBJ files of the manifest, in its order. Empty if the folder does not exist.
inline std::vector<ManifestRow> obj_files_of_manifest() {
    std::vector<ManifestRow> rows;
    std::ifstream lines(shared_data() / "mesh-manifest.csv");
    for (std::string line; std::getline(lines, line);) {
        std::ranges::replace(line, ',', ' ');
        std::istringstream words(line);
        ManifestRow row;
        std::size_t bytes = 0;
        std::size_t ngons = 0;
        std::size_t duplicate = 0;
        words >> row.file >> bytes >> row.vertices >> row.distinct_vertices >> row.faces >> ngons >> row.triangles >>
            row.degenerate >> row.zero_area >> duplicate >> row.boundary_edges >> row.nonmanifold_edges;
        if (row.file.ends_with(".obj"))
            rows.push_back(row);
    }
    return rows;
}

} // namespace chasles::test
