// Flat contacts are reduced to the corners of their hull, also with ties and rounding.
#include "chasles/contact/flat_hull.h"

#include <gtest/gtest.h>
#include <random>

namespace chasles::contact {
namespace {

Contact contact_at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::uint32_t id) {
    Contact contact;
    contact.moving = {id, id};
    contact.point = point;
    contact.normal = normal;
    return contact;
}

TEST(FlatHull, AGridIsItsCornersInEveryPlane) {
    std::mt19937 random(911);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 200; ++trial) {
        const Eigen::Vector3d n = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
        const Eigen::Vector3d u = n.unitOrthogonal();
        const Eigen::Vector3d v = n.cross(u);
        std::vector<Contact> contacts;
        for (std::uint32_t i = 0; i < 30; ++i) { // each point twice, rounded
            const Eigen::Vector3d noise = 1e-15 * Eigen::Vector3d(normal(random), normal(random), normal(random));
            contacts.push_back(contact_at(u * (i % 5) + v * (i / 5 % 3) + noise, n, i));
        }
        std::vector<std::uint32_t> left;
        for (const Contact& contact : at_corners_of_hulls(contacts, 1e-13))
            left.push_back(contact.moving.first);
        EXPECT_EQ(left, (std::vector<std::uint32_t>{0, 4, 10, 14})) << "the first one at each corner, in order";
    }
}

TEST(FlatHull, OtherNormalsAndOtherPlanesStay) {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d side = Eigen::Vector3d::UnitX();
    std::vector<Contact> contacts{contact_at({0, 0, 0}, up, 0), contact_at({2, 0, 0}, up, 1),
                                  contact_at({1, 0, 0}, up, 2), contact_at({1, 0, 0}, side, 3),
                                  contact_at({1, 0, 1}, up, 4)};
    EXPECT_EQ(at_corners_of_hulls(contacts, 1e-13).size(), 4u) << "all but the middle of the first two";
}

TEST(FlatHull, EveryPointIsInTheHullOfWhatIsLeft) {
    std::mt19937 random(912);
    std::uniform_real_distribution<double> place(-1, 1);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<Contact> contacts;
        for (std::uint32_t i = 0; i < 40; ++i)
            contacts.push_back(contact_at({place(random), place(random), 0}, Eigen::Vector3d::UnitZ(), i));
        const auto left = at_corners_of_hulls(contacts, 1e-13);
        ASSERT_GE(left.size(), 3u);
        ASSERT_LT(left.size(), 30u);
        for (int direction = 0; direction < 64; ++direction) { // by its support in every direction
            const Eigen::Vector3d way(std::cos(0.1 * direction), std::sin(0.1 * direction), 0);
            const auto support = [&](const std::vector<Contact>& of) {
                double most = -9;
                for (const Contact& contact : of)
                    most = std::max(most, way.dot(contact.point));
                return most;
            };
            EXPECT_NEAR(support(left), support(contacts), 1e-12);
        }
    }
}

} // namespace
} // namespace chasles::contact
