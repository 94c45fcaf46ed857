// The lines of shared/data/screw-known-answers: two small meshes, a screw, and its first contact.
#pragma once

#include "tests/data/shared_data.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

namespace chasles::test {

using Json = nlohmann::json;

inline std::vector<Eigen::Vector3d> vertices_of(const Json& mesh) {
    std::vector<Eigen::Vector3d> vertices;
    for (const auto& v : mesh["v"].get<std::vector<std::vector<double>>>())
        vertices.emplace_back(v[0], v[1], v[2]);
    return vertices;
}

inline std::vector<std::vector<std::uint32_t>> faces_of(const Json& mesh) {
    return mesh["f"].get<std::vector<std::vector<std::uint32_t>>>();
}

inline Pose pose(const Json& numbers) {
    const auto n = numbers.get<std::vector<double>>();
    return {Eigen::Vector3d(n[0], n[1], n[2]), Eigen::Quaterniond(n[3], n[4], n[5], n[6])};
}

/// Calls function(case) for each case.
template <class Function>
void for_each_known_answer(Function function) {
    const std::filesystem::path file = shared_data("screw-known-answers/cases.jsonl.gz");
    std::string line;
    const gzFile stream = gzopen(file.c_str(), "rb");
    for (int c = gzgetc(stream); c != -1; c = gzgetc(stream)) {
        if (c != '\n') {
            line.push_back(static_cast<char>(c));
            continue;
        }
        function(Json::parse(line));
        line.clear();
    }
    gzclose(stream);
}

} // namespace chasles::test
