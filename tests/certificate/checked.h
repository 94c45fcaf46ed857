// Checks certificates by the checker that shares nothing with the library, and makes random bodies.
#pragma once

#include "chasles/certificate/certificate.h"
#include "chasles/mesh/primitives.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"
#include "tools/verify.h"

#include <gtest/gtest.h>
#include <random>
#include <sstream>

namespace chasles::test {

inline ::certificate::Mesh mesh_of(const Polyhedron& body) {
    ::certificate::Mesh mesh;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        mesh.emplace_back();
        for (const std::uint32_t vertex : body.face(face)) {
            const Eigen::Vector3d& corner = body.vertices()[vertex];
            mesh.back().push_back({corner.x(), corner.y(), corner.z()});
        }
    }
    return mesh;
}

inline ::certificate::Verified checked(const Polyhedron& moving, const Polyhedron& fixed, const std::string& text) {
    std::istringstream stream(text);
    return ::certificate::verify({mesh_of(moving), mesh_of(fixed)}, stream);
}

/// Of a scene or a robot.
inline ::certificate::Verified checked(const Certificate& proof) {
    std::vector<::certificate::Mesh> meshes;
    for (const Polyhedron& body : proof.bodies)
        meshes.push_back(mesh_of(body));
    std::istringstream stream(proof.text);
    return ::certificate::verify(meshes, stream);
}

inline std::string word_of(Verdict verdict) {
    return verdict == Verdict::clear     ? "verdict clear\n"
           : verdict == Verdict::contact ? "verdict contact "
                                         : "verdict start\n";
}

/// Asserts that the answer is certified, and that the checker verifies it.
inline Certificate expect_verified(const FirstContactQuery& query, Verdict verdict) {
    const Certificate proof = certify(query);
    EXPECT_EQ(proof.missing, "") << proof.text;
    EXPECT_NE(proof.text.find(word_of(verdict)), std::string::npos) << proof.text;
    const ::certificate::Verified verified = checked(query.moving, query.fixed, proof.text);
    EXPECT_TRUE(verified.holds) << verified.message << "\n" << proof.text;
    EXPECT_TRUE(is_about(proof.text, query.motion));
    return proof;
}

/// Octahedra and boxes of several sizes, some with a radius, some as surfaces; balls and capsules.
class RandomBodies {
public:
    [[nodiscard]] Polyhedron operator()(Random& random) {
        const double radius = random.chance(0.3) ? random.uniform(0, 0.3) : 0;
        PolyhedronOptions options;
        options.radius = radius;
        options.solid = random.chance(0.3) ? Solid::no : Solid::automatic;
        if (random.chance(0.1))
            return random.chance(0.5) ? make_sphere(random.uniform(0.1, 1))
                                      : make_capsule(random.uniform(0.1, 0.5), random.uniform(0.1, 2));
        Body body = random.chance(0.5) ? random_octahedron(shapes_)
                                       : box({random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)});
        const double size = random.chance(0.3) ? 0.1 : random.chance(0.3) ? 3 : 1;
        for (Eigen::Vector3d& vertex : body.vertices)
            vertex *= size;
        return Polyhedron::from_polygons(body.vertices, body.faces, options);
    }

private:
    std::mt19937 shapes_{4747};
};

} // namespace chasles::test
