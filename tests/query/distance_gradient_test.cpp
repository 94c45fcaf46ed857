// Gradients of least distances by the goal pose: against differences of proven brackets, and in closed form.
#include "chasles/query/distance_gradient.h"

#include "chasles/base/limit.h"
#include "chasles/mesh/primitives.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test::of_gradients { // names of its own in a batch of sources
namespace {

using Vector = DistanceGradient::Vector;
using MotionTo = std::function<Motion(const Pose& goal)>;

struct Question {
    Polyhedron moving, fixed;
    MotionTo motion_to;
    Pose goal;

    [[nodiscard]] LeastDistance answer(const Pose& to, double tolerance) const {
        return least_distance({moving, fixed, motion_to(to), {.tolerance = tolerance}});
    }
    [[nodiscard]] DistanceGradient gradient() const {
        const LeastDistanceQuery query{moving, fixed, motion_to(goal)};
        return least_distance_gradient(query, least_distance(query));
    }
};

/// The goal after a step along one of the six directions.
Pose stepped(const Pose& goal, int direction, double step) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(direction % 3);
    if (direction < 3)
        return {goal.translation + step * axis, goal.rotation};
    return {goal.translation, Eigen::Quaterniond(Eigen::AngleAxisd(step, axis)) * goal.rotation};
}

/// Of brackets that are proven to a part of 1e-9, by steps on both sides.
Vector difference(const Question& question, double step) {
    Vector result;
    for (int i = 0; i < 6; ++i) {
        double distances[2];
        for (const int side : {0, 1}) {
            const LeastDistance found = question.answer(stepped(question.goal, i, side == 0 ? -step : step), 1e-9);
            EXPECT_LE(found.distance.upper - found.distance.lower, 1e-9 * found.distance.upper + 1e-10);
            distances[side] = found.distance.upper;
        }
        result[i] = (distances[1] - distances[0]) / (2 * step);
    }
    return result;
}

Polyhedron random_body(Random& random, std::mt19937& shapes) {
    switch (random.integer(0, 3)) {
    case 0:
        return box(Eigen::Vector3d(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)))
            .polyhedron();
    case 1:
        return make_capsule(random.uniform(0.1, 0.4), random.uniform(0.3, 2));
    default:
        return random_octahedron(shapes).polyhedron();
    }
}

/// Motions of every kind that has a goal.
MotionTo random_motion(Random& random, const Pose& start) {
    const Pose fixed_start = random_pose(random, 1), fixed_goal = random_goal(random, fixed_start, 0.7, 1);
    const Eigen::Vector3d centre = random_point(random, 1);
    switch (random.integer(0, 6)) {
    case 0:
        return [=](const Pose& goal) { return Motion::screw(start, goal); };
    case 1:
        return [=](const Pose& goal) { return Motion::sweep(start, goal, centre); };
    case 2:
        return [=](const Pose& goal) { return Motion::velocity(start, goal, centre); };
    case 3:
        return [=](const Pose& goal) { return Motion::twist(start, goal); };
    case 4:
        return [=](const Pose& goal) -> Motion { return ScrewMotion::relative(start, goal, fixed_start, fixed_goal); };
    case 5:
        return [=](const Pose& goal) -> Motion { return SweepMotion::relative(start, goal, fixed_start, fixed_goal); };
    default:
        return [=](const Pose& goal) {
            return relative(Motion::twist(start, goal), Motion::hinge(centre, {1, 2, 3}, {0, 1, -0.5}));
        };
    }
}

TEST(DistanceGradient, AgreesWithDifferencesOfBrackets) {
    const int wanted = std::getenv("CHASLES_LONG") ? 10'000 : 1'000; // NOLINT(concurrency-mt-unsafe)
    Random random(4101);
    std::mt19937 shapes(4102);
    int asked = 0, isolated = 0, large = 0;
    double worst = 0;
    while (large < wanted) {
        SCOPED_TRACE(asked);
        const Pose start = random_pose(random, 4);
        const bool turns = random.chance(0.9);
        Pose goal = random_goal(random, start, turns ? random.uniform(0, 2.5) : 0, 4);
        if (random.chance(0.8)) // past the other body
            goal.translation -= 2 * start.translation;
        const Question question{random_body(random, shapes), random_body(random, shapes), random_motion(random, start),
                                goal};
        if (question.answer(goal, 1e-3).distance.upper < 0.01)
            continue; // it touches, or nearly
        ++asked;
        const DistanceGradient found = question.gradient();
        ASSERT_TRUE(found.by_goal);
        EXPECT_TRUE(found.by_goal->allFinite());
        if (!found.isolated)
            continue;
        ++isolated;
        const double size = found.by_goal->norm();
        double error = (difference(question, 0x1p-16) - *found.by_goal).norm();
        if (error > 1e-6 * size) // another feature, or rounding
            error = std::min(error, (difference(question, 0x1p-20) - *found.by_goal).norm());
        if (size < 1e-3) { // near the start the goal has no effect, and rounding is all that is left
            EXPECT_LE(error, 1e-8);
            continue;
        }
        ++large;
        worst = std::max(worst, error / size);
        EXPECT_LE(error, 1e-5 * size) << found.by_goal->transpose();
    }
    std::cout << isolated << " of " << asked << " isolated, " << large << " not near 0, worst relative error " << worst
              << "\n";
    EXPECT_GT(isolated, 0.98 * asked);
    EXPECT_LT(asked, 2 * wanted);
}

void expect_gradient(const DistanceGradient& found, const Vector& expected, double tolerance = 1e-9) {
    EXPECT_TRUE(found.isolated);
    ASSERT_TRUE(found.by_goal);
    EXPECT_LE((*found.by_goal - expected).norm(), tolerance) << found.by_goal->transpose();
}

Vector vector_of(double x, double y, double z, double a, double b, double c) {
    Vector result;
    result << x, y, z, a, b, c;
    return result;
}

Polyhedron cube() {
    return box({1, 1, 1}).polyhedron();
}

/// A sphere that ends above the top of a box: the distance follows its height, and nothing else.
TEST(DistanceGradient, OfASphereThatEndsAboveABox) {
    for (const MotionTo& motion : {MotionTo([](const Pose& goal) { return Motion::screw(shifted(0, 0, 5), goal); }),
                                   MotionTo([](const Pose& goal) { return Motion::twist(shifted(0, 0, 5), goal); })})
        expect_gradient(Question{make_sphere(0.5), cube(), motion, shifted(0.2, 0.1, 2)}.gradient(),
                        vector_of(0, 0, 1, 0, 0, 0));
}

/// It passes over an edge of the box at a time between: the share of the goal is that time.
TEST(DistanceGradient, IsTheShareOfTheGoalAtThatTime) {
    const Pose start = shifted(-3, 0, 3), goal = shifted(3, 0, 0.5);
    const Question question{make_sphere(0.25), box({0.5, 4, 0.5}).polyhedron(),
                            [&](const Pose& to) { return Motion::velocity(start, to); }, goal};
    // The nearest point of the edge x = z = 0.5 to the line of the centre.
    const Eigen::Vector3d along = goal.translation - start.translation;
    const double time = (Eigen::Vector3d(0.5, 0, 0.5) - start.translation).dot(along) / along.squaredNorm();
    const Eigen::Vector3d normal = (start.translation + time * along - Eigen::Vector3d(0.5, 0, 0.5)).normalized();
    expect_gradient(question.gradient(), vector_of(time * normal.x(), 0, time * normal.z(), 0, 0, 0));
}

/// A twist without a turn is a straight line, but it bends as soon as its goal is turned: by (t^2 - t) / 2 of w x v.
TEST(DistanceGradient, OfAStraightTwistKnowsThatItBends) {
    const Pose start = shifted(-3, 0, 3), goal = shifted(3, 0, 0.5);
    const Eigen::Vector3d along = goal.translation - start.translation;
    const double time = (Eigen::Vector3d(0.5, 0, 0.5) - start.translation).dot(along) / along.squaredNorm();
    const Eigen::Vector3d normal = (start.translation + time * along - Eigen::Vector3d(0.5, 0, 0.5)).normalized();
    const Eigen::Vector3d by_turn = 0.5 * (time * time - time) * along.cross(normal);
    const MotionTo alone = [&](const Pose& to) { return Motion::twist(start, to); };
    const MotionTo seen = [&](const Pose& to) { return relative(Motion::twist(start, to), Motion::at_rest({})); };
    for (const MotionTo& motion : {alone, seen})
        expect_gradient(Question{make_sphere(0.25), box({0.5, 4, 0.5}).polyhedron(), motion, goal}.gradient(),
                        vector_of(time * normal.x(), 0, time * normal.z(), by_turn.x(), by_turn.y(), by_turn.z()),
                        1e-8);
}

/// At the start the goal has no effect.
TEST(DistanceGradient, IsZeroWhereTheStartIsNearest) {
    expect_gradient(Question{make_sphere(0.5), cube(),
                             [](const Pose& to) { return Motion::twist(shifted(0, 0, 2), to); },
                             turned({0, 1, 5}, {1, 2, 3}, 1)}
                        .gradient(),
                    Vector::Zero());
}

/// A cube that is let down flat on another one: all corners are as near, and turning it lets one of them down further.
TEST(DistanceGradient, OfParallelFacesIsNotIsolated) {
    const Question flat{box({0.5, 0.5, 0.5}).polyhedron(), cube(),
                        [](const Pose& to) { return Motion::velocity(shifted(0, 0, 5), to); }, shifted(0.1, 0.2, 2)};
    const DistanceGradient found = flat.gradient();
    EXPECT_FALSE(found.isolated);
    ASSERT_TRUE(found.by_goal);
    EXPECT_NEAR((*found.by_goal)[2], 1, 1e-9); // all of them agree about this
    EXPECT_NEAR(found.by_goal->head<2>().norm(), 0, 1e-9);
}

/// Square posts at x = 0 and x = 4, with an edge towards positive y each, at y = 0.1 and at `second`.
Polyhedron two_posts(double second) {
    Body posts;
    add_box(posts, {0, 0, 0}, {1, 1, 1});
    add_box(posts, {0, 0, 0}, {1, 1, 1});
    for (std::size_t i = 0; i < posts.vertices.size(); ++i) {
        Eigen::Vector3d& v = posts.vertices[i];
        v = 0.05 * Eigen::Vector3d(v.x() - v.y(), v.x() + v.y(), 20 * v.z());
        v += i < 8 ? Eigen::Vector3d(0, 0, 0) : Eigen::Vector3d(4, second - 0.1, 0);
    }
    return posts.polyhedron();
}

/// Two posts, passed at the same distance at two times; and a body that slides along a face.
TEST(DistanceGradient, OfTwoTimesIsNotIsolated) {
    const Question twice{make_sphere(0.25), two_posts(0.1),
                         [](const Pose& to) { return Motion::velocity(shifted(-2, 1, 0), to); }, shifted(6, 1, 0)};
    EXPECT_FALSE(twice.gradient().isolated);
    Question nearer = twice;
    nearer.goal = shifted(6, 0.99, 0);
    EXPECT_TRUE(nearer.gradient().isolated);
    const Question along{make_sphere(0.25), box({5, 5, 0.1}).polyhedron(),
                         [](const Pose& to) { return Motion::velocity(shifted(-2, 1, 2), to); }, shifted(2, 1, 2)};
    EXPECT_FALSE(along.gradient().isolated);
}

/// The wide bracket may be that of another minimum.
TEST(DistanceGradient, IsThatOfTheLeastMinimumWhateverTheTolerance) {
    const Motion motion = Motion::velocity(shifted(-2, 1, 0), shifted(6, 1, 0));
    const LeastDistanceQuery rough{make_sphere(0.25), two_posts(0.11), motion, {.tolerance = 1}};
    LeastDistance answer = least_distance(rough);
    for (const double time : {0.2, 0.25, 0.75, 0.8}) {
        answer.time = {time, time};
        const DistanceGradient found = least_distance_gradient(rough, answer);
        EXPECT_TRUE(found.isolated) << time;
        EXPECT_NEAR((*found.by_goal)[1], 0.75, 1e-9) << time;
    }
}

TEST(DistanceGradient, OfBodiesThatTouchIsEmpty) {
    const DistanceGradient found =
        Question{cube(), cube(), [](const Pose& to) { return Motion::screw(shifted(0, 0, 5), to); }, shifted(0, 0, 1)}
            .gradient();
    EXPECT_FALSE(found.by_goal);
    EXPECT_FALSE(found.isolated);
}

/// Beyond a half turn the shorter way is another one.
TEST(DistanceGradient, NearAHalfTurnIsNotIsolated) {
    for (const double turn : {3.1415, 3.1})
        for (const MotionTo& motion :
             {MotionTo([](const Pose& to) { return Motion::screw(shifted(0, 0, 5), to); }),
              MotionTo([](const Pose& to) { return Motion::sweep(shifted(0, 0, 5), to); }),
              MotionTo([](const Pose& to) { return Motion::velocity(shifted(0, 0, 5), to); })}) {
            const Question question{box({0.4, 0.3, 0.2}).polyhedron(), cube(), motion,
                                    turned({0.1, 0.2, 2.5}, {1, 2, 3}, turn)};
            EXPECT_EQ(question.gradient().isolated, turn < 3.14);
        }
}

/// The number of pieces changes at each multiple of 10 degrees, and the slide with it by a jump.
TEST(DistanceGradient, OfAScrewKeepsItsPieces) {
    const double degree = std::numbers::pi / 180;
    const auto gradient = [&](double turn) {
        const Question question{make_sphere(0.25), box({0.5, 0.4, 0.3}).polyhedron(),
                                [](const Pose& to) { return Motion::screw(shifted(-3, 0.2, 1), to); },
                                turned({3, 0.1, 1.3}, {1, 0.2, 0.3}, turn)};
        const DistanceGradient found = question.gradient();
        EXPECT_TRUE(found.isolated);
        return *found.by_goal;
    };
    for (const double multiple : {10 * degree, 20 * degree})
        for (const double side : {-1, 1})
            EXPECT_LE((gradient(multiple + side * 1e-6) - gradient(multiple + side * 1e-4)).norm(), 1e-3);
}

TEST(DistanceGradient, NeedsAGoal) {
    const std::string refused = "gradient: the motion has no goal pose to change; screws, sweeps, constant velocities "
                                "and constant twists between two poses have one";
    for (const Motion& motion : {Motion::at_rest(shifted(0, 0, 5)), Motion::hinge({0, 0, 4}, {1, 0, 0}, {0, 1}),
                                 Motion::spline({0, 1}, {shifted(0, 0, 5), shifted(1, 0, 5)}),
                                 Motion::twist(shifted(0, 0, 5), shifted(1, 0, 5)) * Motion::at_rest({})}) {
        const LeastDistanceQuery query{cube(), cube(), motion};
        const LeastDistance answer = least_distance(query);
        EXPECT_EQ(refusal([&] { (void)least_distance_gradient(query, answer); }), refused);
    }
}

/// What is not known to be alone is not said to be.
TEST(DistanceGradient, IsNotIsolatedAtALimit) {
    const LeastDistanceQuery query{make_sphere(0.5), cube(), Motion::twist(shifted(0, 0, 5), shifted(0.2, 0.1, 2))};
    const LeastDistance answer = least_distance(query);
    const Limit limit(1e-9);
    const DistanceGradient found = least_distance_gradient(query, answer);
    EXPECT_FALSE(found.isolated);
    EXPECT_TRUE(found.by_goal);
}

} // namespace
} // namespace chasles::test::of_gradients
