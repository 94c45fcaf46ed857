// A checker of certificates about the contact of moving bodies. See verify.cpp.
#pragma once
#include <array>
#include <istream>
#include <string>
#include <vector>

namespace certificate {

using Corner = std::array<double, 3>;
using Mesh = std::vector<std::vector<Corner>>;  // faces in the order of the file, each a list of corners

struct Verified {
    bool holds = false;
    std::string message;  // what is proven, one claim a line; or in one line why nothing is
};

// Reads an OBJ or STL file. Throws std::runtime_error.
Mesh read_mesh(const std::string& path);

// Checks all that the certificate says. Never throws for what the certificate or the meshes contain. Of a pair the
// meshes are the moving and the fixed one, of a scene those of all bodies in any order, each once.
Verified verify(const std::vector<Mesh>& meshes, std::istream& certificate);

}  // namespace certificate
