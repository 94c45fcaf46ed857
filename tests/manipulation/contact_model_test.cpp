// Gaps after a displacement, against the distances of the same features there.
#include "chasles/manipulation/contact_model.h"
#include "chasles/manipulation/near_contacts.h"

#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

#include <map>

namespace chasles::test {
namespace {

using manipulation::Displacement;
using manipulation::modelled;
using manipulation::ModelledContact;
using manipulation::near_contacts;
using manipulation::NearContacts;

bool is_exact(ContactKind kind) {
    return kind == ContactKind::vertex_face || kind == ContactKind::face_vertex || kind == ContactKind::edge_edge;
}

TEST(ContactModel, GapsAreThoseOfTheFeaturesAfterAStep) {
    Random random(1);
    std::mt19937 shapes(2);
    std::map<ContactKind, int> compared;
    for (int round = 0; round < 4000; ++round) {
        const Polyhedron moving = random_octahedron(shapes).polyhedron(), fixed = box({1, 1, 1}).polyhedron();
        const Pose there = random_pose(random, 1);
        const Pose pose(there.isometry() *
                        Pose(random_point(random, 2), Eigen::Quaterniond(random_pose(random, 0).rotation)).isometry());
        const NearContacts near = near_contacts({moving.body(), pose}, {fixed.body(), there}, 0.5);
        const Pose after = random_goal(random, pose, 0.05, 0.05);
        const NearContacts then = near_contacts({moving.body(), after}, {fixed.body(), there}, 1);
        for (const Contact& contact : near.contacts)
            for (const Contact& same : then.contacts) {
                if (contact.kind != same.kind || contact.moving != same.moving || contact.fixed != same.fixed)
                    continue;
                const ModelledContact model = modelled(contact, 0, {moving.body(), fixed.body(), pose, there});
                const double gap = gap_after(model, Displacement::between(pose, after));
                ++compared[contact.kind];
                EXPECT_LE(gap, same.gap + 1e-9) << round << ' ' << int(contact.kind);
                EXPECT_TRUE(!is_exact(contact.kind) || std::abs(gap - same.gap) < 1e-9)
                    << round << ' ' << int(contact.kind) << ' ' << gap << ' ' << same.gap;
            }
    }
    for (const ContactKind kind : {ContactKind::vertex_face, ContactKind::face_vertex, ContactKind::edge_edge,
                                   ContactKind::vertex_edge, ContactKind::edge_vertex, ContactKind::vertex_vertex})
        EXPECT_GT(compared[kind], 5) << int(kind);
}

/// Within the reach are a corner in the middle of the floor of a box, nearest, and those around it.
TEST(NearContacts, TheNearestOfManyInOnePlaneIsListed) {
    Body tripod;
    tripod.vertices = {{1, 0, 0.3}, {-0.5, 0.9, 0.3}, {-0.5, -0.9, 0.3}, {0, 0, 0.1}, {0, 0, 2}};
    tripod.faces = {{3, 0, 4}, {3, 1, 4}, {3, 2, 4}};
    const Polyhedron moving = tripod.polyhedron(), floor = box({3, 3, 1}).polyhedron();
    const NearContacts near = near_contacts({moving.body(), Pose()}, {floor.body(), shifted(0, 0, -1)}, 0.5);
    EXPECT_NEAR(near.distance, 0.1, 1e-12);
    EXPECT_FALSE(near.overlaps);
    EXPECT_TRUE(near_contacts({moving.body(), shifted(0, 0, -0.2)}, {floor.body(), shifted(0, 0, -1)}, 0.5).overlaps);
    EXPECT_EQ(near_contacts({moving.body(), shifted(0, 0, 2)}, {floor.body(), shifted(0, 0, -1)}, 0.5).distance, 0.5);
}

} // namespace
} // namespace chasles::test
