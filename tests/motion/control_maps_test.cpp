// Control maps agree exactly with Rodrigues' formula for points, directions, lines and fixed points.
#include "chasles/motion/control_maps.h"

#include "tests/support/rational_motions.h"

namespace chasles::motion {
namespace {

using namespace test;
using Vector = Vector3<Rational>;

Vector random_vector(Random& random) {
    Vector v;
    for (int i = 0; i < 3; ++i)
        v[i] = ratio(random.integer(-12, 12), random.integer(1, 5));
    return v;
}

/// A rational rotation matrix, from turned axes.
Matrix3<Rational> random_orientation(Random& random) {
    const Vector axis = random_vector(random);
    const Matrix3<Rational> identity = algebra::identity_matrix<Rational>();
    Matrix3<Rational> columns;
    for (int i = 0; i < 3; ++i)
        columns.row[i] = turned(identity.row[i], Rational(2), axis);
    return columns.transposed();
}

/// A motion of the family by its definition: the body turns by the quaternion 1 + tau (e1 - 1) + tau a about a
/// reference point, which moves along a straight line.
struct Case {
    Rational end_cosine;
    Vector axis;
    Vector reference; ///< at the start, relative to the body's origin
    Vector displacement;
    Vector origin;
    Matrix3<Rational> orientation;

    [[nodiscard]] RationalMotion<Rational> motion() const {
        return {end_cosine, axis, cross(reference, axis), displacement, origin, orientation};
    }
    [[nodiscard]] Vector direction(const Vector& body, const Rational& tau) const {
        return turned(orientation * body, Rational(1 + tau * (end_cosine - 1)), scale(axis, tau));
    }
    [[nodiscard]] Vector position(const Vector& body, const Rational& tau) const {
        const Vector arm =
            turned(orientation * body - reference, Rational(1 + tau * (end_cosine - 1)), scale(axis, tau));
        return origin + reference + arm + scale(displacement, tau);
    }
};

Case random_case(Random& random) {
    const bool turns = random.chance(0.9);
    const Rational end_cosine = random.chance(0.4) ? Rational(1) : ratio(random.integer(turns ? 0 : 1, 9), 9);
    const Vector axis = turns ? random_vector(random) : Vector();
    return {end_cosine,
            axis,
            random_vector(random),
            random_vector(random),
            random_vector(random),
            random_orientation(random)};
}

void expect_equal(const Vector& a, const Vector& b) {
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(a[i], b[i]) << "component " << i;
}

/// Calls check(case, maps, tau) for random motions and parameters.
template <class Check>
void for_random_motions(std::uint64_t seed, Check check) {
    Random random(seed);
    for (int trial = 0; trial < 60; ++trial) {
        const Case family = random_case(random);
        const auto maps = control_maps(family.motion());
        for (const Rational& tau : {Rational(0), ratio(1, 3), ratio(random.integer(1, 9), 10), Rational(1)})
            check(random, family, maps, tau);
    }
}

TEST(ControlMaps, CarryBodyPoints) {
    for_random_motions(601, [](Random& random, const Case& family, const auto& maps, const Rational& tau) {
        const Vector b = random_vector(random);
        const Vector carried = test::value_at(maps.rotation * b + maps.translation, tau);
        expect_equal(carried, scale(family.position(b, tau), algebra::value_at(maps.weight, tau)));
    });
}

TEST(ControlMaps, CarryFixedPointsIntoTheBodysFrame) {
    for_random_motions(602, [](Random& random, const Case& family, const auto& maps, const Rational& tau) {
        const Vector b = random_vector(random);
        const Vector seen =
            test::value_at(maps.rotation.transposed() * family.position(b, tau) - maps.inverse_translation, tau);
        expect_equal(seen, scale(b, algebra::value_at(maps.weight, tau)));
    });
}

TEST(ControlMaps, CarryDirections) {
    for_random_motions(603, [](Random& random, const Case& family, const auto& maps, const Rational& tau) {
        const Vector u = random_vector(random);
        expect_equal(test::value_at(maps.rotation * u, tau),
                     scale(family.direction(u, tau), algebra::value_at(maps.weight, tau)));
    });
}

TEST(ControlMaps, CarryMomentsOfLines) {
    for_random_motions(604, [](Random& random, const Case& family, const auto& maps, const Rational& tau) {
        const Vector b = random_vector(random);
        const Vector u = random_vector(random);
        const Vector moment = test::value_at(maps.rotation * cross(b, u) + maps.moment * u, tau);
        expect_equal(moment, scale(cross(family.position(b, tau), family.direction(u, tau)),
                                   algebra::value_at(maps.weight, tau)));
    });
}

TEST(ControlMaps, WeightsArePositive) {
    for_random_motions(605, [](Random&, const Case&, const auto& maps, const Rational&) {
        for (int i = 0; i <= 3; ++i)
            EXPECT_GT(maps.weight[i], 0);
    });
}

TEST(ControlMaps, RestrictedIntervalIsTheSameMotion) {
    for_random_motions(606, [](Random& random, const Case& family, const auto& maps, const Rational& tau) {
        const Rational from = ratio(random.integer(0, 5), 10);
        const Rational to = ratio(random.integer(6, 10), 10);
        const auto part = restricted(maps, from, to);
        const Rational whole = from + tau * (to - from);
        const Vector b = random_vector(random);
        const Vector u = random_vector(random);
        const Rational weight = algebra::value_at(part.weight, tau);
        EXPECT_EQ(weight, algebra::value_at(maps.weight, whole));
        const Vector place = family.position(b, whole);
        expect_equal(test::value_at(part.rotation * b + part.translation, tau), scale(place, weight));
        expect_equal(test::value_at(part.rotation.transposed() * place - part.inverse_translation, tau),
                     scale(b, weight));
        expect_equal(test::value_at(part.rotation * cross(b, u) + part.moment * u, tau),
                     scale(cross(place, family.direction(u, whole)), weight));
    });
}

TEST(ControlMaps, RoundedAreTheNearestDoubles) {
    Random random(607);
    const auto maps = control_maps(rounded_to<DoubleDouble>(random_case(random).motion()));
    const auto in_doubles = rounded(maps);
    for (int lane = 0; lane <= 3; ++lane)
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(in_doubles.translation[i][lane], maps.translation[i][lane].high());
            EXPECT_EQ(in_doubles.inverse_translation[i][lane], maps.inverse_translation[i][lane].high());
            for (int j = 0; j < 3; ++j) {
                EXPECT_EQ(in_doubles.rotation.row[i][j][lane], maps.rotation.row[i][j][lane].high());
                EXPECT_EQ(in_doubles.moment.row[i][j][lane], maps.moment.row[i][j][lane].high());
            }
        }
}

} // namespace
} // namespace chasles::motion
