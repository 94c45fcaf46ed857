// The reference for margins has tests of its own: closed forms, and dense sampling with a plain distance.
#include "tests/support/margin_reference.h"

#include "tests/attack/any_motion.h"
#include "tests/attack/mesh_families.h"
#include "tests/support/surface_distance.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace chasles::reference {
namespace {

using attack::AttackRandom;
using attack::MeshCase;
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
    // A corner comes in over the edge y = 0 at height 1 exactly: the face's excess vanishes all along.
    expect_time(triangle({1, -1, 1}, {1, -2, 2}, {2, -2, 2}), floor, translation(0, 2, 0), 1, 0.5);
    // It comes in over the corner (0, 0, 0), along the edge y = 0 at height 1.
    expect_time(triangle({-1, 0, 1}, {-2, 0, 2}, {-2, 1, 2}), floor, translation(4, 0, 0), 1, 0.25);
    EXPECT_FALSE(first_time(triangle({1, -1, 1}, {1, -2, 2}, {2, -2, 2}), floor, translation(0, 2, 0), 1 - 0x1p-52)
                     .has_value());
}

TEST(MarginReference, ATurnMeetsTheMarginAtItsAngle) {
    // Corners at (5, 0) turn about z by a right angle. One comes 4 from x = 0 at (4, 3), half-angle tangent 1/3; tau is
    // that tangent, as the whole turn's is 1.
    const Surface wall = triangle({0, -50, -50}, {0, 50, -50}, {0, 0, 90});
    ExactPose goal;
    goal.rotation = {Rational(1), {Rational(0), Rational(0), Rational(1)}};
    auto found = first_time(triangle({5, 0, 0}, {6, -0.5, 1}, {6, -0.5, -1}), wall, screw_path({}, goal), 4);
    ASSERT_TRUE(found.has_value());
    Root third = roots_of({Integer(-1), Integer(3)}).at(0);
    EXPECT_EQ(compare(*found, third), 0) << found->lower();
    // One comes 1 from (1, 5): (1 + 25) + 25 - 10 cos a - 50 sin a = 1, so that, with the half-angle tangent h,
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

/// A path in long double, and distances along it.
class Sampled {
public:
    Sampled(const Surface& moving, const Surface& fixed, const MotionPath<Rational>& path)
        : moving_(moving), fixed_(fixed) {
        for_coefficients(path, path_, [](const Rational& from, Long& to, bool) { to = from.convert_to<Long>(); });
    }

    [[nodiscard]] Long distance(Long tau) const {
        const auto value = [&](const auto& p) {
            Long result = 0;
            for (std::size_t i = p.size(); i-- > 0;)
                result = result * tau + p[i];
            return result;
        };
        Eigen::Matrix<Long, 3, 3> turn;
        test::Point3<Long> shift;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j)
                turn(Eigen::Index(i), Eigen::Index(j)) = value(path_.turn[i][j]) / value(path_.weight);
            shift[Eigen::Index(i)] = value(path_.shift[i]) / value(path_.weight);
        }
        const auto at = [](const Surface& surface, const auto& triangle, const auto& place) {
            test::Triangle3<Long> result;
            for (std::size_t i = 0; i < 3; ++i)
                result[i] = place(test::Point3<Long>(surface.vertices[triangle[i]].template cast<Long>()));
            return result;
        };
        Long least = std::numeric_limits<Long>::infinity();
        for (const auto& s : moving_.triangles)
            for (const auto& t : fixed_.triangles)
                least = std::min(least,
                                 test::squared_distance_of_triangles<Long>(
                                     at(moving_, s, [&](const auto& v) { return test::Point3<Long>(turn * v + shift); }),
                                     at(fixed_, t, [](const auto& v) { return v; })));
        return std::sqrt(least);
    }

private:
    const Surface& moving_;
    const Surface& fixed_;
    MotionPath<Long> path_;
};

struct SampleTally {
    int cases = 0;
    int contacts = 0;
    int at_start = 0;
    int near = 0; ///< sampled within a hundredth of the margin
};

/// Nothing is within the margin before the found time, and the distance there is the margin.
void expect_not_refuted(const MeshCase& posed, double margin, int samples, SampleTally& tally) {
    const Surface moving = Surface::from_convex_faces(posed.moving.vertices, posed.moving.faces);
    const Surface fixed = Surface::from_convex_faces(posed.fixed.vertices, posed.fixed.faces);
    const auto path = posed.posed.paths().at(0);
    const Sampled sampled(moving, fixed, path);
    double size = margin;
    for (const Surface* surface : {&moving, &fixed})
        for (const Eigen::Vector3d& v : surface->vertices)
            size = std::max(size, v.norm());
    size = std::max({size, posed.posed.moving_start.translation.norm(), posed.posed.moving_goal.translation.norm()});
    const Long slack = 1e-15L * Long(size);
    auto found = first_time(moving, fixed, path, margin);
    ++tally.cases;
    const Long end = found ? found->narrowed().convert_to<Long>() : 1;
    for (int i = 0; i <= samples; ++i) {
        const Long tau = end * i / samples;
        const Long distance = sampled.distance(tau);
        if ((i < samples && end > 0) || !found) {
            ASSERT_GT(distance + slack, Long(margin)) << "at tau " << double(tau) << " of " << double(end);
        }
        tally.near += distance < 1.01L * Long(margin) ? 1 : 0;
    }
    if (!found)
        return;
    ++tally.contacts;
    const Long there = sampled.distance(end);
    if (end == 0) {
        ++tally.at_start;
        EXPECT_LE(there, Long(margin) + slack);
    } else {
        EXPECT_NEAR(double(there), margin, 1e-13 * size); // the time is narrowed to 2^-60
    }
}

TEST(MarginReference, DenseSamplingDoesNotRefuteIt) {
    const bool is_long = std::getenv("CHASLES_LONG") != nullptr;
    SampleTally tally;
    std::uint64_t number = 0;
    for (const attack::MeshFamily& family : attack::mesh_families()) {
        ++number;
        const std::string name = family.name;
        for (std::uint64_t index = 0; index < (is_long ? 200u : 4u); ++index) {
            AttackRandom random(911, number, index);
            MeshCase posed = family.make(random);
            posed.posed.max_turn = std::numbers::pi;
            if (posed.posed.paths().size() > 1)
                continue;
            double size = 0;
            for (const Eigen::Vector3d& v : posed.moving.vertices)
                size = std::max(size, (v - posed.moving.vertices[0]).norm());
            const double margin = size * random.pick(std::array{1e-9, 1e-6, 1e-3, 0.1, 0.1, 0.5});
            SCOPED_TRACE("seed 911, family " + name + ", index " + std::to_string(index));
            ASSERT_NO_FATAL_FAILURE(expect_not_refuted(posed, margin, is_long ? 400 : 60, tally));
        }
    }
    std::cout << tally.cases << " cases, " << tally.contacts << " contacts, " << tally.at_start << " at the start, "
              << tally.near << " samples close to the margin\n";
    EXPECT_GT(tally.contacts - tally.at_start, tally.cases / 5);
}

} // namespace
} // namespace chasles::reference
