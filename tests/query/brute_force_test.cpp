// The whole query against all feature pairs in exact rationals, without filter, hierarchy, or subdivision of time.
#include "tests/query/bodies.h"
#include "tests/query/exact_answer.h"
#include "tests/support/posed_motions.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

ExactAnswer brute_force(const Polyhedron& a, const Polyhedron& b, const Pose& start, const Pose& goal) {
    return exact_answer(a, b, motion::screw_between(exact(start), exact(goal)));
}

Body random_body(std::mt19937& random) {
    if (random() % 2 == 0)
        return triangle(random_vector(random, 1), random_vector(random, 1), random_vector(random, 1));
    const Vertices corners{random_vector(random, 1), random_vector(random, 1), random_vector(random, 1),
                           random_vector(random, 1)};
    return {corners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// Coordinates on a coarse grid make parallel edges, shared planes and exact touches frequent.
void snap(Body& body) {
    for (Eigen::Vector3d& vertex : body.vertices)
        vertex = (vertex * 2).array().round() / 2;
}

/// The required agreement with the exact answer. `same`: the answer agrees. `safe`, for bodies that miss each other by
/// less than the bound of double-double: the answer is never late, and agrees if it is certain.
enum class Demand { same, safe };

void compare(const Polyhedron& a, const Polyhedron& b, const Pose& start, const Pose& goal, int& contacts,
             Demand demand = Demand::same) {
    const ExactAnswer truth = brute_force(a, b, start, goal);
    const FirstContact found =
        first_contact({.moving = a, .fixed = b, .motion = ScrewMotion::between(start, goal, std::numbers::pi)});
    contacts += found.verdict == Verdict::clear ? 0 : 1;
    if (truth.overlaps) {
        EXPECT_EQ(found.verdict, Verdict::contact_at_start);
        return;
    }
    if (demand == Demand::safe && found.verdict != Verdict::clear && !found.certain) {
        EXPECT_TRUE(!truth.first || found.tau.lower <= truth.first->upper) << "reported too late";
        return;
    }
    ASSERT_EQ(truth.first.has_value(), found.verdict != Verdict::clear);
    if (!truth.first)
        return;
    EXPECT_LE(found.tau.lower, truth.first->upper) << "reported too late";
    EXPECT_GE(found.tau.upper, truth.first->lower) << "reported too early";
}

TEST(BruteForce, RandomBodiesAgreeWithExactRationals) {
    std::mt19937 random(21);
    int contacts = 0;
    for (int i = 0; i < 120; ++i) {
        SCOPED_TRACE("seed 21, case " + std::to_string(i));
        const Polyhedron a = random_body(random).polyhedron();
        const Polyhedron b = random_body(random).polyhedron();
        compare(a, b, random_pose(random, 1.5, 1.5), random_pose(random, 1.5, 1.5), contacts);
    }
    EXPECT_GT(contacts, 30);
    EXPECT_LT(contacts, 110);
}

/// Edges that are parallel up to rounding land on each other, as the flanks of a nut and a bolt do. The volume of their
/// points is only rounding noise; the first contact must still be inside the bracket.
TEST(BruteForce, NearlyParallelEdgesThatLandOnEachOther) {
    std::mt19937 random(23);
    int contacts = 0;
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE("seed 23, case " + std::to_string(i));
        const Eigen::Vector3d along = random_vector(random, 1).normalized();
        const Eigen::Vector3d up = along.unitOrthogonal();
        const Eigen::Vector3d base = random_vector(random, 5);
        const double height = uniform(random, 0.1, 1);
        const Polyhedron fixed = triangle(base, base + along, base + 0.5 * along - 0.3 * up).polyhedron();
        const Eigen::Vector3d low = base + height * up + uniform(random, -0.5, 0.5) * along;
        const Polyhedron moving = triangle(low, low + along, low + 0.4 * along + 0.3 * up).polyhedron();
        const Eigen::Vector3d fall = -2 * height * up;
        compare(moving, fixed, Pose(), shifted(fall.x(), fall.y(), fall.z()), contacts, Demand::safe);
    }
    EXPECT_GT(contacts, 20) << "rounding lets some of them pass each other";
}

TEST(BruteForce, TranslationsOnAGridAgreeWithExactRationals) {
    std::mt19937 random(22);
    int contacts = 0;
    int kept = 0;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE("seed 22, case " + std::to_string(i));
        Body a = random_body(random);
        Body b = random_body(random);
        snap(a);
        snap(b);
        try {
            const Polyhedron pa = a.polyhedron();
            const Polyhedron pb = b.polyhedron();
            const auto grid_pose = [&] {
                const Eigen::Vector3d p = (random_vector(random, 3) * 2).array().round() / 2;
                return shifted(p.x(), p.y(), p.z());
            };
            compare(pa, pb, grid_pose(), grid_pose(), contacts);
            ++kept;
        } catch (const std::exception&) { // the snapped body has no area
        }
    }
    EXPECT_GT(kept, 60);
    EXPECT_GT(contacts, 20);
    EXPECT_LT(contacts, kept - 10);
}

} // namespace
} // namespace chasles::test
