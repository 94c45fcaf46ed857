// Lists of the pairs of faces in parts of a piece, against the distances of all pairs of triangles at many times.
#include "chasles/search/part_pairs.h"

#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"
#include "tests/support/surface_distance.h"

#include <gtest/gtest.h>
#include <map>

namespace chasles::search {
namespace {

using test::uniform;
using Faces = std::pair<std::uint32_t, std::uint32_t>;

Polyhedron ring(std::uint32_t around, std::uint32_t across) {
    const test::Soup soup = test::torus(around, across);
    return Polyhedron::from_polygons(soup.vertices, soup.faces);
}

struct Scene {
    Polyhedron moving = ring(14, 7);
    Polyhedron fixed = ring(15, 8);
    Motion motion;
    PieceContext context{moving.body(), fixed.body(), motion.trajectory().pieces()->at(0)};

    [[nodiscard]] test::Triangle3<double> triangle(const Polyhedron& shape, std::uint32_t face, double tau) const {
        const contact::RelativeConfiguration bodies = context.configuration_at(tau);
        test::Triangle3<double> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const Eigen::Vector3d& corner = shape.body().vertices()[shape.body().face(face)[i]];
            corners[i] = &shape == &moving ? bodies.moved(corner) : corner;
        }
        return corners;
    }
};

/// Two linked rings. Some motions are short, and some pass through the other ring.
Scene random_scene(std::mt19937& random) {
    const double step = uniform(random, 0, 1) < 0.3 ? 0.4 : 0.02;
    const Pose start = test::composed(test::turned({1.39, 0, 0}, Eigen::Vector3d::UnitX(), 1.5),
                                      test::turned(test::random_vector(random, 0.05), {0, 0, 1}, 0.1));
    const Pose goal =
        test::composed(start, test::turned(test::random_vector(random, step),
                                           test::random_vector(random, 1).normalized(), uniform(random, 0, 2 * step)));
    return {.motion = ScrewMotion::between(start, goal)};
}

/// What a list tells about two faces: the least bound of all their windows.
std::map<Faces, std::vector<PartPair>> by_faces(const PartPairs& pairs) {
    std::map<Faces, std::vector<PartPair>> result;
    for (const PartPair& pair : pairs.all())
        result[{pair.faces.moving, pair.faces.fixed}].push_back(pair);
    return result;
}

/// Compares all pairs of triangles at one time with the list of its part. Returns the number of near ones.
int check_at(const Scene& scene, const PartPairs& pairs, double tau, double reach) {
    const auto listed = by_faces(pairs);
    int near = 0;
    for (std::uint32_t f = 0; f < scene.moving.face_count(); ++f) {
        const test::Triangle3<double> moving = scene.triangle(scene.moving, f, tau);
        for (std::uint32_t g = 0; g < scene.fixed.face_count(); ++g) {
            const double distance =
                std::sqrt(test::squared_distance_of_triangles<double>(moving, scene.triangle(scene.fixed, g, tau)));
            if (distance >= reach * (1 - 1e-9))
                continue;
            ++near;
            const auto found = listed.find({f, g});
            EXPECT_TRUE(found != listed.end()) << "faces " << f << ", " << g << " at " << tau;
            EXPECT_TRUE(found != listed.end() &&
                        std::ranges::any_of(found->second,
                                            [&](const PartPair& pair) {
                                                return may_be_within(pair, tau, distance * (1 + 1e-9) + 1e-12);
                                            }))
                << "faces " << f << ", " << g << " at " << tau << ", distance " << distance;
        }
    }
    return near;
}

TEST(PartPairs, ListAllThatComesNearPartByPartWithBoundsOfItsDistance) {
    std::mt19937 random(5);
    int near = 0, parts = 0, beyond = 0, bounds = 0;
    for (int i = 0; i < 12; ++i) {
        Scene scene = random_scene(random);
        const double reach = uniform(random, 0.004, 0.03);
        PartPairs pairs(scene.context, {0.3 * reach, reach}, {});
        double end = 0;
        do {
            EXPECT_EQ(pairs.part().lower, end);
            end = pairs.part().upper;
            ++parts;
            for (const double share : {0.0, 0.4, 1.0})
                near += check_at(scene, pairs, pairs.part().at(share), reach);
            for (const PartPair& pair : pairs.all()) {
                ++bounds;
                beyond += pair.least > 0.3 * reach ? 1 : 0;
                EXPECT_LE(pair.least, reach);
            }
        } while (pairs.go_on());
        EXPECT_EQ(end, 1);
    }
    EXPECT_GT(near, 700);
    EXPECT_GT(parts, 13) << "some ways are long";
    EXPECT_GT(beyond, bounds / 6) << "some pairs are proven to stay beyond the smaller distance";
}

TEST(PartPairs, AreTheSameByAMemory) {
    std::mt19937 random(6);
    int lists = 0;
    for (int i = 0; i < 8; ++i) {
        Scene scene = random_scene(random);
        NeighbourList neighbours(scene.moving.body(), scene.fixed.body());
        PartPairs pairs(scene.context, {0.003, 0.02}, {.neighbours = &neighbours});
        if (pairs.part().upper == 1)
            ++lists;
        EXPECT_GT(pairs.take_work().node_pairs, 0U);
        EXPECT_EQ(pairs.take_work().node_pairs, 0U);
        check_at(scene, pairs, 0, 0.02);
        check_at(scene, pairs, pairs.part().upper, 0.02);
    }
    EXPECT_GT(lists, 1);
}

} // namespace
} // namespace chasles::search
