// Coulomb friction of a few contacts: each answer is judged by the velocities of the contact points.
#include "chasles/manipulation/friction.h"

#include "chasles/manipulation/contact_rows.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

#include <iostream>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using namespace manipulation;

/// Contacts of a body about the origin, and a wish.
struct Case {
    std::vector<ModelledContact> contacts;
    double coefficient = 0;
    double moment = 1; ///< of inertia
    Twist wish = Twist::Zero();

    [[nodiscard]] FrictionProblem problem() const {
        FrictionProblem problem{normal_rows(contacts, Vector3d::Zero()), tangent_rows(contacts, Vector3d::Zero()),
                                coefficient, Metric::Identity()};
        problem.metric.bottomRightCorner<3, 3>() *= moment;
        return problem;
    }
    [[nodiscard]] Twist force() const { return problem().metric * wish; }
};

/// Parallel normals, normals on one side, or any normals.
Case random_case(Random& random) {
    Case found;
    const int kind = random.integer(0, 2);
    const Vector3d normal = random_point(random, 1).normalized();
    for (int i = random.integer(1, 8); i > 0; --i) {
        ModelledContact contact;
        contact.contact.point = random_point(random, 0.5);
        const Vector3d other = random_point(random, 1);
        contact.contact.normal = kind == 0 ? normal : kind == 1 ? (normal + other).normalized() : other.normalized();
        contact.contact.gap = random.chance(0.3) ? random.uniform(0, 0.01) : 0;
        found.contacts.push_back(contact);
    }
    found.coefficient = random.uniform(0.01, 1);
    found.moment = random.uniform(0.05, 0.2);
    found.wish << random_point(random, 1) - normal * random.uniform(0, 2), random_point(random, 1);
    return found;
}

Vector3d velocity(const Twist& twist, const Vector3d& point) {
    return twist.head<3>() + twist.tail<3>().cross(point);
}

/// How far the point of a contact stays above its cone of directions: n . v - mu |v across n|.
double above_cone(const Case& given, const ModelledContact& modelled, const Twist& twist) {
    const Contact& contact = modelled.contact;
    const Vector3d moves = velocity(twist, contact.point);
    const double lifts = moves.dot(contact.normal);
    return lifts - given.coefficient * (moves - lifts * contact.normal).norm();
}

/// The force of a contact in the world.
Vector3d force_of(const Case& given, const FrictionForces& forces, std::size_t i) {
    const Vector3d& normal = given.contacts[i].contact.normal;
    return normal * forces.normal[Eigen::Index(i)] +
           plane_across(normal) * forces.tangential.segment<2>(2 * Eigen::Index(i));
}

/// The spring's force and those of all contacts, about the origin.
Wrench sum_of_forces(const Case& given, const FrictionForces& forces) {
    Wrench sum = given.force();
    for (std::size_t i = 0; i < given.contacts.size(); ++i) {
        const Vector3d force = force_of(given, forces, i);
        sum.head<3>() += force;
        sum.tail<3>() += given.contacts[i].contact.point.cross(force);
    }
    return sum;
}

void expect_in_cones(const Case& given, const FrictionForces& forces) {
    for (Eigen::Index i = 0; i < forces.normal.size(); ++i) {
        EXPECT_GE(forces.normal[i], 0);
        EXPECT_LE(forces.tangential.segment<2>(2 * i).norm(), given.coefficient * forces.normal[i] * (1 + 1e-12));
    }
}

/// Either forces in the cones balance the spring, or a twist into all cones has power. Each refutes the other.
TEST(Friction, HoldsJustIfForcesInTheConesBalanceTheSpring) {
    Random random(1);
    int held = 0, tried = 0, free = 0;
    for (int round = 0; round < 2000; ++round) {
        const Case given = random_case(random);
        const FrictionProblem problem = given.problem();
        const FrictionForces forces = holding_forces(problem, given.wish);
        expect_in_cones(given, forces);
        const double strength = given.force().norm();
        if (is_held(problem, forces, given.wish)) {
            ++held;
            EXPECT_LE(sum_of_forces(given, forces).norm(), 1e-7 * strength) << round;
            // no twist of a sample gets out with power
            for (int i = 0; i < 200; ++i) {
                Twist twist = given.wish;
                twist.head<3>() += random_point(random, 1);
                twist.tail<3>() += random_point(random, 1);
                const bool gets_out = std::ranges::all_of(
                    given.contacts, [&](const auto& contact) { return above_cone(given, contact, twist) > 1e-6; });
                EXPECT_FALSE(gets_out && twist.dot(given.force()) > 1e-6 * strength) << round;
                ++tried;
            }
            continue;
        }
        ++free;
        EXPECT_GT(forces.twist.dot(given.force()), 0) << round;
        for (const ModelledContact& contact : given.contacts)
            EXPECT_GE(above_cone(given, contact, forces.twist), -1e-8 * given.wish.norm()) << round;
    }
    EXPECT_GT(held, 300);
    EXPECT_GT(free, 1000);
    std::cout << held << " held, " << tried << " twists tried, " << free << " free" << std::endl;
}

/// Signorini's and Coulomb's conditions at each contact of a body that slides.
TEST(Friction, SlidesAsCoulombSays) {
    Random random(2);
    int sliding = 0, pushing = 0, sticking = 0, unsettled = 0;
    for (int round = 0; round < 2000; ++round) {
        const Case given = random_case(random);
        const FrictionProblem problem = given.problem();
        if (is_held(problem, holding_forces(problem, given.wish), given.wish))
            continue;
        const FrictionForces forces = sliding_forces(problem, given.wish);
        expect_in_cones(given, forces);
        unsettled += forces.has_converged ? 0 : 1;
        if (!forces.has_converged)
            continue;
        ++sliding;
        const double tolerance = 1e-6 * (1 + given.wish.norm());
        EXPECT_LE((sum_of_forces(given, forces) - problem.metric * forces.twist).norm(), tolerance) << round;
        for (std::size_t i = 0; i < given.contacts.size(); ++i) {
            const Contact& contact = given.contacts[i].contact;
            const Vector3d moves = velocity(forces.twist, contact.point);
            const double left = moves.dot(contact.normal) + contact.gap, push = forces.normal[Eigen::Index(i)];
            const Vector3d slide = moves - contact.normal * moves.dot(contact.normal);
            EXPECT_GE(left, -tolerance) << round;
            EXPECT_LE(std::abs(left * push), tolerance) << round;
            // friction takes all that it can from what slides
            EXPECT_NEAR(force_of(given, forces, i).dot(slide), -given.coefficient * push * slide.norm(), tolerance)
                << round;
            pushing += push > 1e-3;
            sticking += push > 1e-3 && slide.norm() < 1e-6;
        }
    }
    EXPECT_GT(sliding, 1000);
    EXPECT_GT(pushing, 1000);
    EXPECT_LT(unsettled, 0.08 * sliding);
    std::cout << sliding << " sliding, " << pushing << " contacts push, " << sticking << " of them do not slide, "
              << unsettled << " without an answer" << std::endl;
}

Case block(double coefficient, const Vector3d& wish) {
    Case found;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0}) {
            ModelledContact contact;
            contact.contact.point = {x, y, 0};
            contact.contact.normal = Vector3d::UnitZ();
            found.contacts.push_back(contact);
        }
    found.coefficient = coefficient;
    found.wish.head<3>() = wish;
    return found;
}

TEST(Friction, ABlockSlidesByWhatItsWeightDoesNotHold) {
    for (const double coefficient : {0.1, 0.5, 1.0, 2.0}) {
        const Case given = block(coefficient, {0.9, 1.2, -0.5});
        const FrictionForces forces = sliding_forces(given.problem(), given.wish);
        EXPECT_TRUE(forces.has_converged);
        const double slides = 1.5 - coefficient * 0.5;
        Twist wanted = Twist::Zero();
        wanted.head<2>() << 0.6 * slides, 0.8 * slides;
        EXPECT_LE((forces.twist - wanted).norm(), 1e-7) << coefficient;
        EXPECT_NEAR(forces.normal.sum(), 0.5, 1e-7);
        EXPECT_LE((changed_wish(given.problem(), forces, given.wish).head<2>() - wanted.head<2>()).norm(), 1e-7);
    }
}

TEST(Friction, ABlockIsHeldUpToTheAngleOfFriction) {
    for (const double angle : {0.1, 0.5, 1.2}) {
        const auto is_block_held = [&](double coefficient) {
            const Case given = block(coefficient, {std::sin(angle), 0, -std::cos(angle)});
            return is_held(given.problem(), holding_forces(given.problem(), given.wish), given.wish);
        };
        EXPECT_TRUE(is_block_held(std::tan(angle) * (1 + 1e-6)));
        EXPECT_FALSE(is_block_held(std::tan(angle) * (1 - 1e-6)));
    }
}

} // namespace
} // namespace chasles::test
