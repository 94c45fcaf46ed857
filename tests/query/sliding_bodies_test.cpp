// Bodies that rest on each other: in thousands of small steps with `hold` no body gets stuck or comes too close.
#include "scenes/nut_motions.h"
#include "scenes/threaded_fastener.h"
#include "tests/query/bodies.h"
#include "tests/support/random.h"
#include "tests/support/sliding_body.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using std::numbers::pi;
constexpr double margin = 0.01;
constexpr double hold = 0.004;
constexpr double slack = 1e-11;

double uniform(Random& random, double size) {
    return random.uniform(-size, size);
}

/// A table with its top at z = 0, in many triangles: corners slide over edges and diagonals.
Body triangulated_table() {
    Body table = box({3, 3, 0.5});
    table.faces.pop_back(); // the top: 4 5 7 6
    constexpr std::uint32_t count = 6;
    const auto first = std::uint32_t(table.vertices.size());
    for (std::uint32_t i = 0; i <= count; ++i)
        for (std::uint32_t j = 0; j <= count; ++j)
            table.vertices.emplace_back(-3.0 + i, -3.0 + j, 0.5);
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = 0; j < count; ++j) {
            const std::uint32_t a = first + i * (count + 1) + j;
            table.faces.push_back({a, a + count + 1, a + count + 2});
            table.faces.push_back({a, a + count + 2, a + 1});
        }
    for (Eigen::Vector3d& v : table.vertices)
        v.z() -= 0.5;
    return table;
}

SlidingBody on_table(const Polyhedron& moving, const Polyhedron& table, double height) {
    SlidingBody body{.moving = moving, .fixed = table, .margin = margin, .hold = hold, .slack = slack, .samples = 2};
    EXPECT_TRUE(body.approach(shifted(0, 0, height + 1), shifted(0, 0, height - 1)));
    return body;
}

/// A nearby pose at the same height, turned about z.
Pose beside(const Pose& at, Random& random) {
    Eigen::Vector3d p = at.translation + Eigen::Vector3d(uniform(random, 0.1), uniform(random, 0.1), 0);
    p = p.cwiseMax(Eigen::Vector3d(-2, -2, p.z())).cwiseMin(Eigen::Vector3d(2, 2, p.z()));
    return composed(turned(p, {0, 0, 1}, uniform(random, 0.05)),
                    {Eigen::Vector3d(0, 0, 0), Eigen::Quaterniond(at.rotation)});
}

Pose lifted(const Pose& at, double height) {
    return {at.translation + Eigen::Vector3d(0, 0, height), Eigen::Quaterniond(at.rotation)};
}

TEST(SlidingBodies, ABoxSlidesOnATableForTenThousandSteps) {
    Random random(41);
    const Polyhedron moving = box({0.3, 0.2, 0.1}).polyhedron();
    const Polyhedron table = triangulated_table().polyhedron();
    SlidingBody body = on_table(moving, table, 0.1);
    const int count = 10'000;
    int pushed = 0;
    for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
        SCOPED_TRACE("seed 41, step " + std::to_string(i));
        if (i % 50 == 20) { // down to the hold distance, and no farther
            const double gap = body.distance(body.at);
            const FirstContact found = body.step(lifted(body.at, -0.02));
            ASSERT_EQ(found.verdict, Verdict::contact);
            EXPECT_NEAR(found.clear_until, std::max(gap - hold, 0.0) / 0.02, 1e-9);
            EXPECT_EQ(found.held.size(), 4u) << "its corners";
            ++pushed;
        } else if (i % 50 == 45) {
            EXPECT_EQ(body.step(lifted(body.at, random.uniform(0, 0.005))).verdict, Verdict::clear) << "up";
        } else {
            EXPECT_EQ(body.step(beside(body.at, random)).verdict, Verdict::clear) << "along";
        }
    }
    EXPECT_GT(pushed, 100);
    std::cout << body.tally.steps << " steps, " << body.tally.held << " stopped at the hold, lowest distance "
              << body.tally.lowest << " of the hold\n";
}

/// Repeated pushes from the final pose do not move the body.
TEST(SlidingBodies, APushIntoTheTableIsReportedAtOnceAndDoesNotCreep) {
    const Polyhedron moving = box({0.3, 0.2, 0.1}).polyhedron();
    const Polyhedron table = triangulated_table().polyhedron();
    SlidingBody body = on_table(moving, table, 0.1);
    EXPECT_EQ(body.step(lifted(body.at, -0.02)).verdict, Verdict::contact);
    const double held_at = body.distance(body.at);
    EXPECT_NEAR(held_at, hold, 1e-12);
    for (int i = 0; i < 1000; ++i) {
        const FirstContact found = body.step(lifted(body.at, -0.02));
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_LE(found.clear_until, 1e-10);
    }
    EXPECT_GE(body.distance(body.at), hold - 1e-12 * 6) << "after a thousand pushes";
    EXPECT_EQ(body.step(lifted(body.at, 0.02)).verdict, Verdict::clear) << "and it can be lifted off";
}

/// A prism rolls by turns about its lowest edge. The next edge lands within the margin of the same table.
TEST(SlidingBodies, APrismRollsOverItsEdges) {
    Random random(42);
    for (const std::uint32_t sides : {3u, 5u, 6u, 12u}) {
        SCOPED_TRACE("seed 42, " + std::to_string(sides) + " sides");
        Body prism;
        std::vector<std::uint32_t> front;
        std::vector<std::uint32_t> back;
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2 * pi * i / sides;
            for (const double y : {-0.3, 0.3})
                prism.vertices.emplace_back(0.2 * std::cos(angle), y, 0.2 * std::sin(angle));
            const std::uint32_t next = 2 * ((i + 1) % sides);
            prism.faces.push_back({2 * i, 2 * i + 1, next + 1});
            prism.faces.push_back({2 * i, next + 1, next});
            front.insert(front.begin(), 2 * i);
            back.push_back(2 * i + 1);
        }
        for (const auto& cap : {front, back})
            for (std::uint32_t i = 1; i + 1 < sides; ++i)
                prism.faces.push_back({cap[0], cap[i], cap[i + 1]});
        const Polyhedron moving = prism.polyhedron();
        const Polyhedron table = triangulated_table().polyhedron();
        SlidingBody body = on_table(moving, table, 0.2);
        EXPECT_EQ(body.step(lifted(body.at, -0.003)).verdict, Verdict::clear) << "well into the margin";
        double rolled = 0;
        int direction = 1;
        for (int i = 0; i < 800 && !testing::Test::HasFailure(); ++i) {
            SCOPED_TRACE("step " + std::to_string(i));
            const Eigen::Isometry3d pose = body.at.isometry();
            Eigen::Vector3d lowest(0, 0, 9);
            for (const Eigen::Vector3d& v : moving.vertices()) // the foremost of the edges at nearly the lowest height
                if (const Eigen::Vector3d w = pose * v;
                    w.z() < lowest.z() - 0.002 || (w.z() < lowest.z() + 0.002 && direction * (w.x() - lowest.x()) > 0))
                    lowest = w;
            const double turn = direction * random.uniform(0.01, 0.2);
            const Eigen::AngleAxisd roll(turn, Eigen::Vector3d::UnitY());
            const Eigen::Isometry3d about = Eigen::Translation3d(lowest) * roll * Eigen::Translation3d(-lowest);
            const FirstContact found = body.step(Pose(about * pose));
            rolled += std::abs(turn) * found.clear_until;
            if (std::abs(body.at.translation.x()) > 2)
                direction = body.at.translation.x() > 0 ? -1 : 1;
            const double gap = body.distance(body.at);
            if (found.verdict != Verdict::clear || gap > 0.007) { // the edge of the next turn stays within the margin
                EXPECT_EQ(body.step(lifted(body.at, 0.007 - gap)).verdict, Verdict::clear);
            }
        }
        EXPECT_GT(body.tally.held, 10);
        EXPECT_GT(rolled, 2 * pi);
        std::cout << sides << " sides: rolled " << rolled << " radians in " << body.tally.steps << " steps, "
                  << body.tally.held << " stopped at the hold\n";
    }
}

/// A box that slides on the table reaches a wall.
TEST(SlidingBodies, AWallIsMetAtTheDistanceThatIsHeld) {
    const Polyhedron moving = box({0.3, 0.2, 0.1}).polyhedron();
    Body scene = triangulated_table();
    const Body wall = box({0.1, 1, 1});
    const auto offset = std::uint32_t(scene.vertices.size());
    for (const Eigen::Vector3d& v : wall.vertices)
        scene.vertices.emplace_back(v + Eigen::Vector3d(2, 0.3, 1.5)); // above the table, apart from it
    for (auto face : wall.faces) {
        for (std::uint32_t& v : face)
            v += offset;
        scene.faces.push_back(face);
    }
    for (Eigen::Vector3d& v : scene.vertices)
        if (&v - scene.vertices.data() >= std::ptrdiff_t(offset) && v.z() < 1)
            v.z() = 0.05;
    const Polyhedron fixed = scene.polyhedron();
    SlidingBody body = on_table(moving, fixed, 0.1);
    const Pose goal = shifted(2.5, 0.1, body.at.translation.z());
    const FirstContact found = body.step(goal);
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_NEAR(found.time.lower, (1.9 - hold - 0.3) / 2.5, 1e-9);
    ASSERT_FALSE(found.contacts.empty());
    EXPECT_LE((found.contacts[0].normal + Eigen::Vector3d::UnitX()).norm(), 1e-6);
    EXPECT_EQ(found.clear_until, found.time.lower);
    EXPECT_EQ(body.step(lifted(body.at, 0.004)).verdict, Verdict::clear) << "along the wall";
}

/// The nut's clearance is less than the margin: contacts are held everywhere on the thread, and the nut still turns.
TEST(SlidingBodies, ANutTurnsOnItsBoltWithinTheMargin) {
    const scenes::ThreadedFastener fastener{.bolt_length = 16, .nut_height = 4};
    const Polyhedron nut = scenes::nut(fastener);
    const Polyhedron bolt = scenes::bolt(fastener);
    for (const double turns : {1.0, -0.5}) {
        const scenes::NutTurn motion{.height = 3 * fastener.pitch, .turns = turns, .slide_per_turn = fastener.pitch};
        const std::vector<Pose> path = scenes::nut_path(motion);
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            const FirstContact found = first_contact({.moving = nut,
                                                      .fixed = bolt,
                                                      .motion = ScrewMotion::between(path[i], path[i + 1]),
                                                      .options = {.margin = 0.2, .hold = 0.005}});
            EXPECT_EQ(found.verdict, Verdict::clear) << "step " << i << ", time " << found.time.lower;
            EXPECT_FALSE(found.held.empty());
        }
    }
    const Pose middle = scenes::nut_pose({.height = 3 * fastener.pitch}, 0);
    const FirstContact pulled = first_contact({.moving = nut,
                                               .fixed = bolt,
                                               .motion = ScrewMotion::between(middle, lifted(middle, 1)),
                                               .options = {.margin = 0.2, .hold = 0.005}});
    ASSERT_EQ(pulled.verdict, Verdict::contact) << "pulled straight it comes to its flanks";
    ASSERT_FALSE(pulled.contacts.empty());
    EXPECT_NEAR(pulled.contacts[0].gap, 0.005, 1e-9);
}

} // namespace
} // namespace chasles::test
