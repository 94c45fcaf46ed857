// A body that is made again from another one is the same body: the same solid parts, volume, faces and answers.
#include "chasles/query/first_contact.h"
#include "tests/mesh/shapes.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

struct Named {
    const char* name;
    Polyhedron body;
};

/// A tetrahedron with a vertex on an edge of its lower face; a face without area joins them.
Soup with_gap() {
    return {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
            {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {0, 3, 2}, {1, 2, 3}}};
}

/// Likewise with two vertices on the edge, which a polygon without area joins; and with other faces without area.
Soup with_many_gaps() {
    return {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0.5, 0, 0}, {1, 0, 0}, {5, 5, 5}, {6, 5, 5}, {7, 5, 5}},
            {{0, 1, 0},
             {0, 1, 5, 4},
             {0, 2, 1},
             {0, 4, 3},
             {4, 5, 3},
             {5, 1, 3},
             {6, 7, 8},
             {0, 3, 2},
             {6, 6, 6},
             {1, 2, 3}}};
}

/// A cube with a corner outside of the planes of its faces.
Soup bent_cube(double by) {
    Soup soup = cube();
    soup.vertices[7] += Eigen::Vector3d(by, 0.5 * by, -by);
    return soup;
}

std::vector<Named> bodies() {
    return {{"gap", made_from(with_gap(), {.solid = Solid::yes})},
            {"round gap", made_from(with_gap(), {.radius = 1e-3})},
            {"surface with a gap", made_from(with_gap(), {.solid = Solid::no})},
            {"many gaps", made_from(with_many_gaps())},
            {"nearly planar", made_from(bent_cube(1e-6))},
            {"cut", made_from(bent_cube(0.1), {.triangulate = true})},
            {"cut and round", made_from(bent_cube(0.1), {.triangulate = true, .radius = 0.01})},
            {"moved", made_from(cube(), {.radius = -1e-3})},
            {"cut and moved", made_from(bent_cube(0.1), {.triangulate = true, .radius = -1e-3})}};
}

Polyhedron from_arrays(const Polyhedron& body, double radius) {
    const Solid solid = body.report().solid_parts > 0 ? Solid::automatic : Solid::no;
    return Polyhedron::from_outlines(body.vertices(), body.outlines(), {.solid = solid, .radius = radius});
}

std::vector<std::uint32_t> sources_of(const Polyhedron& body) {
    std::vector<std::uint32_t> sources;
    for (std::size_t face = 0; face < body.outlines().size(); ++face)
        sources.push_back(body.source_face(face));
    return sources;
}

std::vector<Named> made_again(const Polyhedron& body) {
    const Polyhedron copy = from_arrays(body, body.radius());
    return {{"with its radius", body.with_radius(body.radius())},
            {"with another radius and its own", body.with_radius(0.25).with_radius(body.radius())},
            {"from arrays", copy},
            {"from arrays, twice", from_arrays(copy, body.radius())},
            {"with sources", copy.with_sources(sources_of(body), body.report().moved_inwards)}};
}

void expect_same_surface(const Polyhedron& again, const Polyhedron& body) {
    const MeshReport report = again.report(), given = body.report();
    EXPECT_EQ(report.solid_parts, given.solid_parts);
    EXPECT_EQ(report.closed, given.closed);
    EXPECT_EQ(report.unpaired_edges, given.unpaired_edges);
    EXPECT_EQ(report.faces, given.faces);
    EXPECT_EQ(report.segments, given.segments);
    EXPECT_EQ(report.volume, given.volume);
    EXPECT_EQ(report.lower, given.lower);
    EXPECT_EQ(report.upper, given.upper);
    ASSERT_EQ(again.outlines().size(), body.outlines().size());
    for (std::size_t face = 0; face < body.outlines().size(); ++face)
        EXPECT_TRUE(std::ranges::equal(again.outlines()[face], body.outlines()[face]));
}

FirstContact contact_with(const Polyhedron& body, const Pose& start, const Pose& goal) {
    static const Soup small = [] {
        Soup soup = cube();
        for (Eigen::Vector3d& vertex : soup.vertices)
            vertex *= 0.01;
        return soup;
    }();
    return first_contact({.moving = made_from(small), .fixed = body, .motion = ScrewMotion::between(start, goal)});
}

void expect_same_answers(const Polyhedron& again, const Polyhedron& body) {
    Random random(7001);
    int hits = 0;
    const int rounds = 40;
    for (int i = 0; i < rounds; ++i) {
        const Pose start = random_pose(random, 2), goal = random_pose(random, 0.5);
        const FirstContact found = contact_with(again, start, goal), expected = contact_with(body, start, goal);
        EXPECT_EQ(found.verdict, expected.verdict);
        EXPECT_EQ(found.time.lower, expected.time.lower);
        EXPECT_EQ(found.time.upper, expected.time.upper);
        EXPECT_EQ(found.contacts.size(), expected.contacts.size());
        hits += expected.verdict == Verdict::clear ? 0 : 1;
    }
    EXPECT_GT(hits, rounds / 8);
    const Pose within({0.3, 0.3, 0.3}, Eigen::Quaterniond::Identity());
    EXPECT_EQ(contact_with(again, within, within).verdict, contact_with(body, within, within).verdict);
}

TEST(MadeAgain, IsTheSameBody) {
    for (const auto& [name, body] : bodies())
        for (const auto& [way, again] : made_again(body)) {
            SCOPED_TRACE(std::string(name) + ", " + way);
            expect_same_surface(again, body);
            expect_same_answers(again, body);
        }
}

TEST(MadeAgain, AClosedSurfaceStaysSolid) {
    for (const auto& [name, body] : bodies()) {
        SCOPED_TRACE(name);
        const bool is_solid = std::string(name) != "surface with a gap";
        EXPECT_EQ(body.report().solid_parts, is_solid ? 1U : 0U);
        const Pose within({0.3, 0.3, 0.3}, Eigen::Quaterniond::Identity());
        for (const auto& [way, again] : made_again(body))
            EXPECT_EQ(contact_with(again, within, within).verdict,
                      is_solid ? Verdict::contact_at_start : Verdict::clear)
                << way;
    }
}

TEST(MadeAgain, ARadiusIsThatOfABodyMadeWithIt) {
    for (const Soup& soup : {with_gap(), with_many_gaps(), bent_cube(1e-6)}) {
        const Polyhedron given = made_from(soup, {.radius = 0.01});
        expect_same_surface(made_from(soup).with_radius(0.01), given);
        expect_same_answers(made_from(soup).with_radius(0.01), given);
    }
}

/// Faces would no longer meet where a vertex moves away from an edge: never a body without its inside.
TEST(MadeAgain, ARadiusBelowZeroRefusesGaps) {
    for (const Soup& soup : {with_gap(), with_many_gaps()}) {
        EXPECT_NE(refusal([&] { (void)made_from(soup, {.radius = -1e-3}); }), "accepted");
        EXPECT_NE(refusal([&] { (void)made_from(soup).with_radius(-1e-3); }), "accepted");
    }
}

TEST(MadeAgain, SourcesNameTheFacesOfTheFirstBody) {
    const Polyhedron body = made_from(with_gap());
    const Polyhedron copy = from_arrays(body, 0).with_sources(sources_of(body), 0.5);
    EXPECT_EQ(sources_of(body), (std::vector<std::uint32_t>{0, 1, 2, 4, 5, 3}));
    EXPECT_EQ(sources_of(copy), sources_of(body));
    EXPECT_EQ(sources_of(body.with_radius(1)), sources_of(body));
    EXPECT_EQ(copy.report().moved_inwards, 0.5);
    EXPECT_EQ(refusal([&] { (void)body.with_sources({}, 0); }), "mesh: 0 ids of faces for 6 outlines");
}

TEST(MadeAgain, WithoutRadiusAMeshNeedsAnArea) {
    const Polyhedron segment =
        Polyhedron::from_polygons(std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}},
                                  std::vector<std::vector<std::uint32_t>>{{0, 1, 1}}, {.radius = 1});
    EXPECT_EQ(segment.with_radius(0.5).report().upper.x(), 1.5);
    EXPECT_NE(refusal([&] { (void)segment.with_radius(0); }).find("no face has an area"), std::string::npos);
}

} // namespace
} // namespace chasles::test
