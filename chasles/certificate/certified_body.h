// What a certificate says of a body. Source: docs/certificate.md, "Bodies" and "Outside".
#pragma once

#include "chasles/certificate/face_tree.h"
#include "chasles/mesh/polyhedron.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace chasles::certificate {

/// Throws InvalidInput "certificate: NAME: WHY" for a body whose faces are not those of its file.
void check_body(const Polyhedron& body, const std::string& name);

/// SHA-256 of the corners of all faces.
std::string hash_of(const Polyhedron& body);

struct CertifiedBody {
    explicit CertifiedBody(const Polyhedron& body);
    CertifiedBody(const CertifiedBody&) = delete;
    CertifiedBody& operator=(const CertifiedBody&) = delete;

    Polyhedron shape;
    FaceTree tree; ///< of `shape`
    std::string hash;
};

/// Bodies that may share their shapes.
class CertifiedBodies {
public:
    void add(const Polyhedron& body);
    const CertifiedBody& operator[](std::size_t index) const { return *bodies_[index]; }
    /// Those of different content.
    [[nodiscard]] std::vector<Polyhedron> different() const;

private:
    std::vector<std::shared_ptr<const CertifiedBody>> bodies_;
};

/// A corner of each connected part of the surface: a face, and a number in its outline.
std::vector<std::pair<std::size_t, std::size_t>> corners_of_parts(const Polyhedron& body);

} // namespace chasles::certificate
