// 3-vectors and 3x3 matrices against explicit sums over components.
#include "chasles/algebra/vector.h"

#include "tests/support/random.h"
#include "tests/support/rational.h"

namespace chasles::algebra {
namespace {

using test::Random;
using test::Rational;
using Vector = Vector3<Rational>;
using Matrix = Matrix3<Rational>;

Vector random_vector(Random& random) {
    Vector v;
    for (int i = 0; i < 3; ++i)
        v[i] = random.integer(-20, 20);
    return v;
}

Matrix random_matrix(Random& random) {
    return {{random_vector(random), random_vector(random), random_vector(random)}};
}

void expect_equal(const Vector& a, const Vector& b) {
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(a[i], b[i]) << "component " << i;
}

int levi_civita(int i, int j, int k) {
    return (j - i) * (k - i) * (k - j) / 2;
}

TEST(Vector3, DotIsTheSumOfProducts) {
    Random random(401);
    const Vector a = random_vector(random);
    const Vector b = random_vector(random);
    Rational sum(0);
    for (int i = 0; i < 3; ++i)
        sum += a[i] * b[i];
    EXPECT_EQ(dot(a, b), sum);
}

TEST(Vector3, CrossIsTheAlternatingSum) {
    Random random(402);
    const Vector a = random_vector(random);
    const Vector b = random_vector(random);
    Vector expected;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                expected[i] += levi_civita(i, j, k) * a[j] * b[k];
    expect_equal(cross(a, b), expected);
    expect_equal(cross_matrix(a) * b, expected);
}

TEST(Vector3, Norm1AddsMagnitudes) {
    EXPECT_EQ(norm1(Vector3<double>{1, -2, 3}), 6);
    EXPECT_EQ(norm1(Vector{Rational(-1), Rational(0), Rational(-5)}), 6);
}

TEST(Matrix3, ProductAppliesTheRightFactorFirst) {
    Random random(403);
    for (int trial = 0; trial < 20; ++trial) {
        const Matrix a = random_matrix(random);
        const Matrix b = random_matrix(random);
        const Vector v = random_vector(random);
        expect_equal((a * b) * v, a * (b * v));
        expect_equal((a + b) * v, a * v + b * v);
    }
}

TEST(Matrix3, TransposeSwapsSidesOfTheDotProduct) {
    Random random(404);
    const Matrix m = random_matrix(random);
    const Vector a = random_vector(random);
    const Vector b = random_vector(random);
    EXPECT_EQ(dot(a, m * b), dot(m.transposed() * a, b));
}

TEST(Matrix3, OuterProjectsOnTheSecondVector) {
    Random random(405);
    const Vector a = random_vector(random);
    const Vector b = random_vector(random);
    const Vector v = random_vector(random);
    expect_equal(outer(a, b) * v, scale(a, dot(b, v)));
}

TEST(Matrix3, IdentityKeepsVectors) {
    Random random(406);
    const Vector v = random_vector(random);
    expect_equal(identity_matrix<Rational>() * v, v);
}

} // namespace
} // namespace chasles::algebra
