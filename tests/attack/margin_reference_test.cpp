// Tests of the reference for margins: closed forms, and dense sampling with a plain distance.
#include "tests/support/margin_reference.h"

#include "tests/attack/margin_families.h"
#include "tests/support/sampled_distance.h"

#include <chrono>
#include <cstdlib>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::reference {
namespace {

using attack::AttackRandom;
using attack::MarginCase;
using Long = long double;

Surface triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const std::vector<Eigen::Vector3d> vertices{a, b, c};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}};
    return Surface::from_convex_faces(vertices, faces);
}

MotionPath<Rational> translation(double x, double y, double z) {
    return screw_path({}, {exact(Eigen::Vector3d(x, y, z)), {}});
}

std::optional<Root> first_time(const Surface& moving, const Surface& fixed, const MotionPath<Rational>& path,
                               double margin) {
    return MarginScene(moving, fixed, path, margin).first_time();
}

void expect_time(const Surface& moving, const Surface& fixed, const MotionPath<Rational>& path, double margin,
                 double tau) {
    auto found = first_time(moving, fixed, path, margin);
    ASSERT_TRUE(found.has_value());
    Root truth = Root::point(tau);
    EXPECT_EQ(compare(*found, truth), 0) << found->lower() << " instead of " << tau;
}

TEST(MarginReference, TranslationsToldByHand) {
    const Surface floor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    const Surface above = triangle({1, 1, 1}, {1, 2, 3}, {2, 1, 3});
    expect_time(above, floor, translation(0, 0, -2), 0.5, 0.25); // a corner over a face
    expect_time(floor, above, translation(0, 0, 2), 0.5, 0.25);
    expect_time(above, floor, translation(0, 0, -1), 0.5, 0.5);
    EXPECT_FALSE(first_time(above, floor, translation(0, 0, -0.5), 0.499999).has_value());
    expect_time(above, floor, translation(0, 0, -0.5), 0.5, 1);
    expect_time(above, floor, translation(0, 0, -0.5), 1, 0); // just within at the start
    expect_time(above, floor, translation(0, 0, 5), 1, 0);
    // Corner to corner along 3-4-5, corner to edge, edge over crossing edge.
    const Surface beyond = triangle({7, 4, 0}, {9, 3, 0}, {9, 4, 0});
    expect_time(beyond, triangle({0, 0, 0}, {0, -1, 0}, {-1, 0, 0}), translation(-8, 0, 0), 5, 0.5);
    expect_time(triangle({2, -4, 0}, {1, -5, 1}, {3, -5, 1}), floor, translation(0, 4, 0), 3, 0.25);
    expect_time(triangle({2, -1, 3}, {2, 1, 3}, {2, 0, 5}), triangle({0, 0, 0}, {4, 0, 0}, {2, 0, -1}),
                translation(0, 0, -4), 1, 0.5);
    // Flat on flat: all pairs at the same time; parallel edges likewise.
    expect_time(triangle({0, 0, 3}, {4, 0, 3}, {0, 4, 3}), floor, translation(0, 0, -4), 1, 0.5);
    expect_time(triangle({1, -2, 0}, {3, -2, 0}, {2, -3, 0}), floor, translation(0, 2, 0), 1, 0.5);
    // Crossing at the start is a distance of 0.
    expect_time(triangle({1, 1, -1}, {1, 1, 1}, {5, 5, 1}), floor, translation(0, 0, 9), 1e-9, 0);
}

TEST(MarginReference, SlidingAtTheMarginIsMetWhereItBegins) {
    const Surface floor = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    // A corner arrives over the edge y = 0 at height exactly 1: the face's excess vanishes identically.
    expect_time(triangle({1, -1, 1}, {1, -2, 2}, {2, -2, 2}), floor, translation(0, 2, 0), 1, 0.5);
    // A corner arrives over the corner (0, 0, 0), along the edge y = 0 at height 1.
    expect_time(triangle({-1, 0, 1}, {-2, 0, 2}, {-2, 1, 2}), floor, translation(4, 0, 0), 1, 0.25);
    EXPECT_FALSE(
        first_time(triangle({1, -1, 1}, {1, -2, 2}, {2, -2, 2}), floor, translation(0, 2, 0), 1 - 0x1p-52).has_value());
}

TEST(MarginReference, ATurnMeetsTheMarginAtItsAngle) {
    // Corners at (5, 0) turn about z by a right angle. At (4, 3) a corner is 4 from x = 0; its half-angle tangent is
    // 1/3. Tau equals this tangent, because the tangent of the whole turn is 1.
    const Surface wall = triangle({0, -50, -50}, {0, 50, -50}, {0, 0, 90});
    ExactPose goal;
    goal.rotation = {Rational(1), {Rational(0), Rational(0), Rational(1)}};
    auto found = first_time(triangle({5, 0, 0}, {6, -0.5, 1}, {6, -0.5, -1}), wall, screw_path({}, goal), 4);
    ASSERT_TRUE(found.has_value());
    Root third = roots_of({Integer(-1), Integer(3)}).at(0);
    EXPECT_EQ(compare(*found, third), 0) << found->lower();
    // A corner is 1 from (1, 5) when (1 + 25) + 25 - 10 cos a - 50 sin a = 1. With the half-angle tangent h this is
    // 50 (1 + h^2) - 10 (1 - h^2) - 100 h = 0.
    found = first_time(triangle({5, 0, 0}, {4, -2, 1}, {4, -2, -1}), triangle({1, 9, -50}, {1, 9, 50}, {1, 5, 0}),
                       screw_path({}, goal), 1);
    ASSERT_TRUE(found.has_value());
    Root truth = roots_of({Integer(40), Integer(-100), Integer(60)}).at(0);
    EXPECT_EQ(compare(*found, truth), 0) << found->lower();
    // A tangent: the circle of radius 5 comes within exactly 1 of x = 6, at (5, 0) for the corner from (3, -4).
    const Surface tangent = triangle({6, -20, -20}, {6, 20, -20}, {6, 0, 40});
    expect_time(triangle({3, -4, 0}, {2, -3, 1}, {2, -3, -1}), tangent, screw_path({}, goal), 1, 0.5);
    EXPECT_FALSE(first_time(triangle({3, -4, 0}, {2, -3, 1}, {2, -3, -1}), tangent, screw_path({}, goal), 1 - 0x1p-52)
                     .has_value());
}

struct SampleTally {
    int cases = 0;
    int contacts = 0;
    int at_start = 0;
    int near = 0;       ///< samples within a hundredth of the margin
    double seconds = 0; ///< time of the reference

    SampleTally& operator+=(const SampleTally& other) {
        cases += other.cases;
        contacts += other.contacts;
        at_start += other.at_start;
        near += other.near;
        seconds += other.seconds;
        return *this;
    }
};

void print(const std::string& name, const SampleTally& tally) {
    std::cout << name << ": " << tally.cases << " cases, " << tally.contacts << " contacts, " << tally.at_start
              << " at the start, " << tally.near << " samples close to the margin, " << tally.seconds << " s\n";
}

/// Before the found time no sample is within the margin, and the distance at this time is the margin.
void expect_not_refuted(const MarginCase& posed, int samples, SampleTally& tally) {
    const auto& [mesh, margin] = posed;
    const Surface moving = Surface::from_convex_faces(mesh.moving.vertices, mesh.moving.faces);
    const Surface fixed = Surface::from_convex_faces(mesh.fixed.vertices, mesh.fixed.faces);
    const auto path = mesh.posed.paths().at(0);
    const SampledDistance sampled(moving, fixed, path);
    double size = margin;
    for (const Surface* surface : {&moving, &fixed})
        for (const Eigen::Vector3d& v : surface->vertices)
            size = std::max(size, v.norm());
    for (const Pose* pose :
         {&mesh.posed.moving_start, &mesh.posed.moving_goal, &mesh.posed.fixed_start, &mesh.posed.fixed_goal})
        size = std::max(size, pose->translation.norm());
    const Long slack = 1e-15L * Long(size);
    const auto before = std::chrono::steady_clock::now();
    auto found = first_time(moving, fixed, path, margin);
    tally.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    ++tally.cases;
    const Long end = found ? found->narrowed().convert_to<Long>() : 1;
    for (int i = 0; i <= samples; ++i) {
        const Long tau = end * i / samples;
        const Long distance = sampled.at(tau);
        if ((i < samples && end > 0) || !found) {
            ASSERT_GT(distance + slack, Long(margin)) << "at tau " << double(tau) << " of " << double(end);
        }
        tally.near += distance < 1.01L * Long(margin) ? 1 : 0;
    }
    if (!found)
        return;
    ++tally.contacts;
    const Long there = sampled.at(end);
    if (end == 0) {
        ++tally.at_start;
        EXPECT_LE(there, Long(margin) + slack);
    } else {
        EXPECT_NEAR(double(there), margin, 1e-13 * size); // the time is narrowed to 2^-60
    }
}

/// Many more with CHASLES_LONG=1 in the environment.
TEST(MarginReference, DenseSamplingDoesNotRefuteIt) {
    const bool is_long = std::getenv("CHASLES_LONG") != nullptr;
    SampleTally sum;
    std::uint64_t number = 0;
    for (const attack::MarginFamily& family : attack::margin_families()) {
        ++number;
        SampleTally tally;
        const std::string name = family.name;
        for (std::uint64_t index = 0; index < (is_long ? 150u : 6u); ++index) {
            AttackRandom random(911, number, index);
            MarginCase posed = family.make(random);
            posed.mesh.posed.max_turn = std::numbers::pi;
            SCOPED_TRACE("seed 911, family " + name + ", index " + std::to_string(index));
            if (posed.mesh.posed.paths().size() > 1)
                continue;
            ASSERT_NO_FATAL_FAILURE(expect_not_refuted(posed, is_long ? 150 : 60, tally));
        }
        if (is_long)
            print(name, tally);
        sum += tally;
    }
    print("all", sum);
    EXPECT_GT(sum.contacts - sum.at_start, sum.cases / 5);
}

} // namespace
} // namespace chasles::reference
