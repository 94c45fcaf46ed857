// Changes that must not change an answer: which body is called moving, the direction of time, the position of the
// world, the unit, the order of faces, and the triangulation of polygons.
#include "tests/query/bodies.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace chasles::test {
namespace {

constexpr int cases = 150;
using std::numbers::pi;

struct Case {
    Body a;
    Body b;
    Pose start;
    Pose goal;
};

Case random_case(std::mt19937& random) {
    Case one{random_octahedron(random), box(Eigen::Vector3d(0.4, 0.6, 0.5)), {}, {}};
    one.start = random_pose(random, 2.5, 1.2);
    one.goal = random_pose(random, 2.5, 1.2);
    return one;
}

FirstContact answer(const Body& moving, const Body& fixed, const ScrewMotion& motion) {
    return first_contact(
        {.moving = moving.polyhedron(), .fixed = fixed.polyhedron(), .motion = motion.with_max_turn(pi)});
}

bool overlap(const Bracket& a, const Bracket& b) {
    return a.lower <= b.upper && b.lower <= a.upper;
}

/// Runs a comparison on random cases. Fails if too few of them touch or too few are clear.
template <class Compare>
void on_random_cases(unsigned seed, Compare compare) {
    std::mt19937 random(seed);
    int contacts = 0;
    for (int i = 0; i < cases; ++i) {
        const Case one = random_case(random);
        const FirstContact found = answer(one.a, one.b, ScrewMotion::between(one.start, one.goal));
        contacts += found.verdict == Verdict::clear ? 0 : 1;
        SCOPED_TRACE("seed " + std::to_string(seed) + ", case " + std::to_string(i));
        compare(one, found, random);
    }
    EXPECT_GT(contacts, cases / 5);
    EXPECT_LT(contacts, cases - cases / 5);
}

TEST(Properties, SwappingTheBodiesSwapsTheContact) {
    on_random_cases(1, [](const Case& one, const FirstContact& found, std::mt19937&) {
        const FirstContact swapped = answer(one.b, one.a, ScrewMotion::relative(Pose(), Pose(), one.start, one.goal));
        ASSERT_EQ(found.verdict, swapped.verdict);
        EXPECT_TRUE(overlap(found.tau, swapped.tau));
        if (found.contacts.empty() || swapped.contacts.empty())
            return;
        const Contact& there = found.contacts[0];
        const Contact& back = swapped.contacts[0];
        EXPECT_EQ(there.moving, back.fixed);
        EXPECT_EQ(there.fixed, back.moving);
        EXPECT_NEAR(there.approach_speed, back.approach_speed, 1e-6 * (1 + there.approach_speed));
    });
}

/// A sweep has the same poses in both directions. The paper's screw has not, because its slide is not symmetric.
TEST(Properties, ASweepThatIsClearForwardsIsClearBackwards) {
    on_random_cases(2, [](const Case& one, const FirstContact&, std::mt19937&) {
        const Polyhedron a = one.a.polyhedron();
        const Polyhedron b = one.b.polyhedron();
        const FirstContact there =
            first_contact({.moving = a, .fixed = b, .motion = SweepMotion::between(one.start, one.goal)});
        const FirstContact back =
            first_contact({.moving = a, .fixed = b, .motion = SweepMotion::between(one.goal, one.start)});
        EXPECT_EQ(there.verdict == Verdict::clear, back.verdict == Verdict::clear);
        if (there.verdict == Verdict::contact && back.verdict == Verdict::contact) {
            EXPECT_LE(there.time.lower, 1 - back.time.lower + 1e-11) << "the first is not after the last";
        }
    });
}

TEST(Properties, MovingTheWorldMovesTheContact) {
    on_random_cases(3, [](const Case& one, const FirstContact& found, std::mt19937& random) {
        const Pose world = random_pose(random, 10, 3);
        const FirstContact moved = answer(
            one.a, one.b, ScrewMotion::relative(composed(world, one.start), composed(world, one.goal), world, world));
        ASSERT_EQ(found.verdict, moved.verdict);
        EXPECT_NEAR(found.tau.lower, moved.tau.lower, 1e-9) << "the poses were rounded";
        if (found.contacts.empty() || moved.contacts.empty())
            return;
        const Eigen::Isometry3d there = world.isometry();
        EXPECT_TRUE((there * found.contacts[0].point).isApprox(moved.contacts[0].point, 1e-7));
        EXPECT_TRUE((there.linear() * found.contacts[0].normal).isApprox(moved.contacts[0].normal, 1e-6));
    });
}

TEST(Properties, AnotherUnitByAPowerOfTwoChangesNoBit) {
    for (const double unit : {0x1p-30, 0x1p40}) {
        on_random_cases(4, [unit](Case one, const FirstContact& found, std::mt19937&) {
            for (Body* body : {&one.a, &one.b})
                for (Eigen::Vector3d& vertex : body->vertices)
                    vertex *= unit;
            for (Pose* pose : {&one.start, &one.goal})
                pose->translation *= unit;
            const FirstContact scaled = answer(one.a, one.b, ScrewMotion::between(one.start, one.goal));
            EXPECT_EQ(found.verdict, scaled.verdict);
            EXPECT_EQ(found.time.lower, scaled.time.lower);
            EXPECT_EQ(found.time.upper, scaled.time.upper);
            EXPECT_EQ(found.certain, scaled.certain);
        });
    }
}

/// The same surface with vertices and faces in another order, and another first corner of each face.
Body shuffled(const Body& body, std::mt19937& random) {
    std::vector<std::uint32_t> order(body.vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), random);
    Body result = body;
    for (std::size_t i = 0; i < order.size(); ++i)
        result.vertices[order[i]] = body.vertices[i];
    for (auto& face : result.faces) {
        for (std::uint32_t& vertex : face)
            vertex = order[vertex];
        std::rotate(face.begin(), face.begin() + 1, face.end());
    }
    std::shuffle(result.faces.begin(), result.faces.end(), random);
    return result;
}

TEST(Properties, OrderOfVerticesAndFacesDoesNotMatter) {
    on_random_cases(5, [](const Case& one, const FirstContact& found, std::mt19937& random) {
        const FirstContact other =
            answer(shuffled(one.a, random), shuffled(one.b, random), ScrewMotion::between(one.start, one.goal));
        ASSERT_EQ(found.verdict, other.verdict);
        EXPECT_TRUE(overlap(found.time, other.time));
    });
}

TEST(Properties, CuttingPolygonsIntoTrianglesDoesNotMatter) {
    on_random_cases(6, [](Case one, const FirstContact& found, std::mt19937&) {
        Faces triangles;
        for (const auto& face : one.b.faces)
            for (std::size_t i = 1; i + 1 < face.size(); ++i)
                triangles.push_back({face[0], face[i], face[i + 1]});
        one.b.faces = triangles;
        const FirstContact cut = answer(one.a, one.b, ScrewMotion::between(one.start, one.goal));
        ASSERT_EQ(found.verdict, cut.verdict);
        EXPECT_TRUE(overlap(found.time, cut.time));
    });
}

TEST(Properties, AScrewCutByMaxTurnIsThePathOfItsPieces) {
    on_random_cases(7, [](const Case& one, const FirstContact&, std::mt19937&) {
        const ScrewMotion whole = ScrewMotion::between(one.start, one.goal, 0.2);
        const Polyhedron a = one.a.polyhedron();
        const Polyhedron b = one.b.polyhedron();
        const FirstContact cut = first_contact({.moving = a, .fixed = b, .motion = whole});
        const std::vector<ScrewMotion> pieces = whole.pieces();
        Verdict verdict = Verdict::clear;
        double time = 0;
        for (std::size_t i = 0; i < pieces.size() && verdict == Verdict::clear; ++i) {
            const FirstContact piece = first_contact({.moving = a, .fixed = b, .motion = pieces[i].with_max_turn(pi)});
            verdict = piece.verdict == Verdict::contact_at_start && i > 0 ? Verdict::contact : piece.verdict;
            time = (double(i) + piece.time.lower) / double(pieces.size());
        }
        ASSERT_EQ(verdict, cut.verdict);
        if (verdict == Verdict::contact) {
            EXPECT_NEAR(time, cut.time.lower, 1e-12);
        }
    });
}

} // namespace
} // namespace chasles::test
