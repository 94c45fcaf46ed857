// Queries with faces without area: wires that stick out of a body, and single points. Each answer is known.
#include "tests/query/bodies.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

Body wire(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return {{from, to}, {{0, 1, 1}}};
}

Body point(const Eigen::Vector3d& place) {
    return {{place}, {{0, 0, 0}}};
}

/// With a small triangle far off: a mesh needs a face with an area.
Polyhedron beside_triangle(Body body, double z) {
    const auto first = static_cast<std::uint32_t>(body.vertices.size());
    body.vertices.insert(body.vertices.end(), {{0, 0, z}, {1, 0, z}, {0, 1, z}});
    body.faces.push_back({first, first + 1, first + 2});
    return body.polyhedron();
}

/// The moving body goes by (0, 8, 0).
FirstContact pass(const Body& moving, const Body& fixed,
                  const QueryOptions& options = {.find = Find::first_with_all_contacts}) {
    return first_contact({.moving = beside_triangle(moving, -50),
                          .fixed = beside_triangle(fixed, 50),
                          .motion = ScrewMotion::between(shifted(0, 0, 0), shifted(0, 8, 0)),
                          .options = options});
}

void expect_contact_at(const FirstContact& found, double time, ContactKind kind) {
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    EXPECT_LE(found.time.lower, time);
    EXPECT_GE(found.time.upper, time);
    EXPECT_LT(found.time.upper - found.time.lower, 1e-11);
    ASSERT_FALSE(found.contacts.empty());
    EXPECT_EQ(found.contacts.front().kind, kind);
    EXPECT_TRUE(found.contacts.front().point.allFinite());
    EXPECT_NEAR(found.contacts.front().normal.norm(), 1, 1e-9);
}

TEST(FacesWithoutArea, AWireTouchesWithItsTip) {
    const Body table = box({10, 1, 10}); // up to y = 1 on both sides
    const Body rod = wire({0, -9, 0}, {0, -5, 0});
    const FirstContact found = pass(rod, table);
    expect_contact_at(found, 0.5, ContactKind::vertex_face);
    EXPECT_EQ(found.contacts.front().moving.first, 1U);
}

TEST(FacesWithoutArea, AWireTouchesAcrossAnEdge) {
    const Body across = wire({-1, -4, -1}, {1, -4, 1});
    expect_contact_at(pass(across, wire({0, 0, 3}, {0, 0, -3})), 0.5, ContactKind::edge_edge);
    EXPECT_EQ(pass(across, wire({0, 0, 3}, {0, 0, 0x1p-40})).verdict, Verdict::clear);
    expect_contact_at(pass(across, wire({0, 0, 3}, {0, 0, 0})), 0.5, ContactKind::edge_vertex);
}

TEST(FacesWithoutArea, ParallelWiresTouchWhereTheyOverlap) {
    const Body along = wire({0, -4, 0}, {2, -4, 0});
    EXPECT_EQ(pass(along, wire({1, 0, 0}, {5, 0, 0})).verdict, Verdict::contact);
    expect_contact_at(pass(along, wire({2, 0, 0}, {5, 0, 0})), 0.5, ContactKind::vertex_vertex);
    EXPECT_EQ(pass(along, wire({std::nextafter(2, 3), 0, 0}, {5, 0, 0})).verdict, Verdict::clear);
    EXPECT_EQ(pass(along, wire({1, 0, 0x1p-60}, {5, 0, 0x1p-60})).verdict, Verdict::clear);
}

TEST(FacesWithoutArea, PointsTouchFacesWiresAndPoints) {
    const Body drop = point({1, -5, 1});
    expect_contact_at(pass(drop, box({10, 1, 10})), 0.5, ContactKind::vertex_face);
    expect_contact_at(pass(drop, wire({0, -1, 0}, {2, -1, 2})), 0.5, ContactKind::vertex_edge);
    expect_contact_at(pass(wire({0, -5, 0}, {2, -5, 2}), point({1, -1, 1})), 0.5, ContactKind::edge_vertex);
    expect_contact_at(pass(drop, point({1, -1, 1})), 0.5, ContactKind::vertex_vertex);
    EXPECT_EQ(pass(drop, point({1, -1, std::nextafter(1, 2)})).verdict, Verdict::clear);
    EXPECT_EQ(pass(drop, wire({0, -1, 0}, {2, -1, std::nextafter(2, 3)})).verdict, Verdict::clear);
    EXPECT_EQ(pass(drop, wire({2, -1, 2}, {3, -1, 3})).verdict, Verdict::clear);
}

TEST(FacesWithoutArea, AWireThroughAFaceIsAnOverlapAtTheStart) {
    const FirstContact found = pass(wire({0, -4, 0}, {0, 4, 0}), box({10, 1, 10}));
    EXPECT_EQ(found.verdict, Verdict::contact_at_start);
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(pass(wire({-1, 0, 0}, {1, 0, 0}), wire({0, 0, -1}, {0, 0, 1})).verdict, Verdict::contact_at_start);
    EXPECT_EQ(pass(point({1, 2, 3}), point({1, 2, 3})).verdict, Verdict::contact_at_start);
}

TEST(FacesWithoutArea, DistancesFromWiresAndPoints) {
    const QueryOptions within{.margin = 1, .find = Find::first_with_all_contacts};
    const auto expect_at = [&](const FirstContact& found, double time) {
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_LE(found.time.lower, time);
        EXPECT_GE(found.time.upper, time);
        EXPECT_LT(found.time.upper - found.time.lower, 1e-6);
        EXPECT_NEAR(found.contacts.front().gap, 1, 1e-6);
    };
    // The moving feature is at y = -5 and comes within 1 of y = 0 after half the way of 8.
    const Body rod = wire({0, -5, 0}, {2, -5, 0});
    const Body drop = point({1, -5, 0});
    for (const Body& fixed : {wire({0, 0, 0}, {2, 0, 0}), wire({1, 0, -3}, {1, 0, 3}), point({1, 0, 0})}) {
        expect_at(pass(rod, fixed, within), 0.5);
        expect_at(pass(drop, fixed, within), 0.5);
    }
    EXPECT_EQ(pass(drop, point({3, 0, 0}), within).verdict, Verdict::clear);
    EXPECT_EQ(pass(rod, point({3.5, 0, 0}), within).verdict, Verdict::clear);
    EXPECT_EQ(pass(rod, wire({4, 0, 0}, {9, 0, 0}), within).verdict, Verdict::clear);
}

TEST(FacesWithoutArea, HoldKeepsAWireInTouch) {
    // The wire rests on the table and slides along.
    const Body table = box({10, 1, 10});
    const FirstContact found = first_contact({.moving = beside_triangle(wire({0, 1.0625, 0}, {2, 1.0625, 0}), -50),
                                              .fixed = beside_triangle(table, 50),
                                              .motion = ScrewMotion::between(shifted(0, 0, 0), shifted(0, 0, 1)),
                                              .options = {.margin = 0.125, .hold = 0.03125}});
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_EQ(found.held.size(), 2U);
}

TEST(FacesWithoutArea, AllContactsAreListedOnce) {
    const FirstContact found = pass(wire({0, -4, 0}, {2, -4, 0}), wire({1, 0, 0}, {5, 0, 0}));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_EQ(found.contacts.size(), 2U);
    const FirstContact points = pass(point({1, -5, 1}), point({1, -1, 1}));
    ASSERT_EQ(points.verdict, Verdict::contact);
    ASSERT_EQ(points.contacts.size(), 1U);
    EXPECT_EQ(points.contacts[0].kind, ContactKind::vertex_vertex);
}

} // namespace
} // namespace chasles::test
