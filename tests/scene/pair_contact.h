// A contact of two bodies by their names, to compare scenes with single pairs.
#pragma once

#include "chasles/scene/scene.h"

#include <gtest/gtest.h>

namespace chasles::test {

struct PairContact {
    std::string moving;
    std::string fixed;
    FirstContact contact;
};

inline void expect_same(const Scene& scene, const SceneContact& found, const PairContact& expected) {
    EXPECT_EQ(scene.bodies()[found.moving].name, expected.moving);
    EXPECT_EQ(scene.bodies()[found.fixed].name, expected.fixed);
    EXPECT_EQ(found.contact.verdict, expected.contact.verdict);
    EXPECT_EQ(found.contact.certain, expected.contact.certain);
    EXPECT_EQ(found.contact.time.lower, expected.contact.time.lower);
    EXPECT_EQ(found.contact.time.upper, expected.contact.time.upper);
    EXPECT_EQ(found.contact.contacts.size(), expected.contact.contacts.size());
}

} // namespace chasles::test
