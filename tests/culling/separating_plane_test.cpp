// Flat on flat: one plane separates most faces, and no earlier contact is lost.
#include "chasles/culling/separating_plane.h"

#include "chasles/search/piece_search.h"
#include "tests/query/bodies.h"
#include "tests/query/exact_answer.h"
#include "tests/support/grid.h"
#include "tests/support/posed_motions.h"

#include <cmath>
#include <gtest/gtest.h>

namespace chasles::culling {
namespace {

using namespace test;

/// The square [-1, 1]^2 in the plane z = 0, in 2 n^2 triangles.
test::Body square(std::uint32_t n) {
    test::Body body;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            body.vertices.emplace_back(2.0 * i / n - 1, 2.0 * j / n - 1, 0);
    body.faces = grid_triangles(n, n);
    return body;
}

/// A motion from 1/4 above the plane z = 0 to 1/4 below it, with a sideways offset that keeps vertices off vertices.
struct Landing {
    Pose start;
    Pose goal;

    explicit Landing(double turn)
        : start(turned({0.3, 0.1, 0.25}, {0, 0, 1}, 0.2)), goal(turned({0.3, 0.1, -0.25}, {0, 0, 1}, 0.2 + turn)) {}
    [[nodiscard]] ScrewMotion screw() const { return ScrewMotion::between(start, goal); }
};

TEST(FlatOnFlat, MostFacesAreToldApartAtOnce) {
    const Polyhedron body = square(20).polyhedron();
    for (const double turn : {0.0, 0.1}) {
        const FirstContact found = first_contact({.moving = body, .fixed = body, .motion = Landing(turn).screw()});
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_TRUE(found.certain);
        EXPECT_LE(found.tau.lower, 0.5);
        EXPECT_GE(found.tau.upper, 0.5);
        EXPECT_LE(found.tau.upper - found.tau.lower, 1.1e-12);
        EXPECT_LT(found.work.face_pairs, 150U) << "of some 8,000 that touch";
    }
}

/// A square with one inner vertex at distance `height` from the plane of the other vertices.
Polyhedron with_bump(std::uint32_t n, std::size_t at, double height) {
    test::Body body = square(n);
    body.vertices[at].z() = height;
    return body.polyhedron();
}

TEST(FlatOnFlat, WhatSticksOutIsMetFirst) {
    const std::uint32_t n = 8;
    const Polyhedron flat = square(n).polyhedron();
    for (const int exponent : {-20, -30, -36, -39, -40, -41, -42, -45, -50})
        for (const std::size_t at : {30U, 34U, 50U, 70U}) {
            const double height = std::ldexp(1.0, exponent);
            const double contact = 0.5 - 2 * height;
            for (const bool moves : {true, false}) {
                const Polyhedron bumpy = with_bump(n, at, moves ? -height : height);
                const FirstContact found = first_contact(
                    {.moving = moves ? bumpy : flat, .fixed = moves ? flat : bumpy, .motion = Landing(0).screw()});
                ASSERT_EQ(found.verdict, Verdict::contact);
                EXPECT_LE(found.tau.lower, contact) << exponent << ' ' << at << ' ' << moves;
                EXPECT_GE(found.tau.upper, contact) << exponent << ' ' << at << ' ' << moves;
                EXPECT_LE(found.tau.upper - found.tau.lower, 1.1e-12);
            }
        }
}

/// The vertices of both sheets are off their planes by powers of two, from far above the tolerance to far below.
TEST(FlatOnFlat, AgreesWithExactRationalsOnSheetsThatAreHardlyBent) {
    std::mt19937 random(4811);
    int left_open = 0, met = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const auto sheet = [&] {
            test::Body body = square(2);
            for (Eigen::Vector3d& v : body.vertices)
                v.z() = std::ldexp(uniform(random, -1, 1), -int(uniform(random, 30, 60)));
            return body.polyhedron();
        };
        const Polyhedron moving = sheet();
        const Polyhedron fixed = sheet();
        const Landing landing(trial % 2 == 0 ? 0 : 0.1);
        const Motion screw = landing.screw();
        search::PieceContext context(moving.body(), fixed.body(), screw.trajectory().pieces()->at(0));
        const search::PieceResult found = search::search_piece(context, {});
        const ExactAnswer truth =
            exact_answer(moving, fixed, motion::screw_between(exact(landing.start), exact(landing.goal)), 1e-15);
        left_open += found.searched_until < 1 ? 1 : 0;
        ASSERT_EQ(!found.candidates.empty(), truth.first.has_value());
        if (!truth.first)
            continue;
        ++met;
        double lower = found.searched_until, upper = 1;
        for (const search::Candidate& candidate : found.candidates) {
            lower = std::min(lower, candidate.tau.lower);
            upper = std::min(upper, candidate.tau.upper);
        }
        EXPECT_LE(lower, truth.first->upper) << trial;
        EXPECT_GE(upper, truth.first->lower) << trial;
        EXPECT_LE(upper - lower, 1e-12) << trial;
    }
    std::cout << met << " meet, of " << left_open << " the last moment was left open\n";
    EXPECT_GT(left_open, 20);
}

} // namespace
} // namespace chasles::culling
