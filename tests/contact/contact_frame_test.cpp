// Normals have unit length however small the features are.
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// The squares of these lengths are at the end of the range of double, their products beyond it.
constexpr double tiny = 1e-160;

void expect_unit_normals(const Body& moving, const Body& fixed, const Pose& start, const Pose& goal) {
    const FirstContact found = first_contact({.moving = moving.polyhedron(),
                                              .fixed = fixed.polyhedron(),
                                              .motion = ScrewMotion::between(start, goal),
                                              .options = {.find = Find::first_with_all_contacts}});
    EXPECT_FALSE(found.contacts.empty());
    for (const Contact& contact : found.contacts)
        EXPECT_NEAR(contact.normal.norm(), 1, 1e-12) << "kind " << int(contact.kind);
}

/// Found by tests/fuzz/any_numbers_fuzz.cpp.
TEST(ContactDetails, NormalsOfTinyEdgesHaveUnitLength) {
    const Body blade = triangle({0, 0, 0}, {tiny, 0.3 * tiny, 0.7 * tiny}, {0, -3, -5});
    expect_unit_normals(triangle({-1, 0.1, 0}, {1, -0.1, 0}, {0, 2, 1}), blade, shifted(0, 1, 1), shifted(0, -1, -1));
    expect_unit_normals(blade, triangle({-1, 0, 0}, {1, 0, 0}, {0, 2, 1}), shifted(0, -1, -1), shifted(0, 1, 1));
}

TEST(ContactDetails, NormalsOfTinyFacesHaveUnitLength) {
    Body fixed = triangle({0, 0, 0}, {1e-170, 0, 0}, {0, 1e-170, 0});
    fixed.vertices.emplace_back(0, 0, -1);
    fixed.faces.push_back({0, 1, 3});
    expect_unit_normals(triangle({0, 0, 0}, {1, 0, 2}, {0, 1, 2}), fixed, shifted(0, 0, 1), shifted(0, 0, -1));
}

} // namespace
} // namespace chasles::test
