// The cost of first_feasible has a ceiling, in operations of a counting scalar.
#include "chasles/algebra/first_feasible.h"

#include "tests/support/random.h"

#include <vector>

namespace chasles::algebra {
namespace {

using test::Random;

/// A double that counts arithmetic operations.
struct Counted {
    double value = 0;
    static inline std::int64_t operations = 0;

    Counted() = default;
    explicit Counted(double v) : value(v) {}
    explicit operator double() const { return value; }

    static Counted counted(double v) {
        ++operations;
        return Counted(v);
    }
    friend Counted operator+(const Counted& a, const Counted& b) { return counted(a.value + b.value); }
    friend Counted operator-(const Counted& a, const Counted& b) { return counted(a.value - b.value); }
    friend Counted operator*(const Counted& a, const Counted& b) { return counted(a.value * b.value); }
    friend Counted operator/(const Counted& a, const Counted& b) { return counted(a.value / b.value); }
    friend Counted operator-(const Counted& a) { return counted(-a.value); }
    friend auto operator<=>(const Counted& a, const Counted& b) { return a.value <=> b.value; }
    friend bool operator==(const Counted& a, const Counted& b) { return a.value == b.value; }
};

} // namespace

template <>
inline constexpr double unit_roundoff<Counted> = 0x1p-53;

namespace {

/// The largest number of restrictions.
constexpr int ceiling = 100;

using Cubic = Bernstein<3, Counted>;

Cubic cubic(double a, double b, double c, double d) {
    Cubic p;
    int i = 0;
    for (const double coefficient : {a, b, c, d})
        p.set(i++, Counted(coefficient));
    return p;
}

Bounded<3, Counted> bounded(const Cubic& p) {
    const Cubic size(magnitude(p.coefficients));
    double largest = 0;
    for (int i = 0; i <= 3; ++i)
        largest = std::max(largest, size[i].value);
    return {p, Counted(9 * 0x1p-53 * largest)};
}

std::int64_t cost(const Cubic& function, const std::vector<Constraint<3, Counted>>& constraints, double from = 0) {
    const Bounded<3, Counted> f = bounded(function);
    const Cubic weight = Cubic::constant(Counted(1));
    Counted::operations = 0;
    (void)first_feasible<3, Counted>({weight, f, constraints}, {1e-12, 1e-12, ceiling, {from, 1}});
    return Counted::operations;
}

/// The cost of one step: all polynomials are restricted and clipped, and the last constraint rejects the part.
std::int64_t one_step(std::size_t constraints) {
    std::vector<Constraint<3, Counted>> all(constraints, {bounded(cubic(1, 1, 1, 1)), {}, false});
    if (all.empty())
        return cost(cubic(1, 1, 1, 1), all, 0.25);
    all.back().first = bounded(cubic(-1, -1, -1, -1));
    return cost(cubic(0, 0, 0, 0), all, 0.25);
}

double random_coefficient(Random& random) {
    return random.chance(0.2) ? 0 : random.scaled(-6, 0);
}

Cubic random_cubic(Random& random) {
    return cubic(random_coefficient(random), random_coefficient(random), random_coefficient(random),
                 random_coefficient(random));
}

TEST(FirstFeasibleCost, SimpleRootsTakeAFewSteps) {
    // Roots at 1/3; the second grazes at 0.9.
    EXPECT_LT(cost(cubic(-1, 0, 1, 2), {}), 12 * one_step(0));
    EXPECT_LT(cost(cubic(-0.27, 0.06, 0.046667, 0.006667), {}), 30 * one_step(0));
}

TEST(FirstFeasibleCost, APlainCrossingIsDecidedByTheGuess) {
    const Constraint<3, Counted> holds{bounded(cubic(1, 2, 1, 2)), {}, false};
    const Constraint<3, Counted> fails{bounded(cubic(-1, 1, 2, 2)), {}, false};
    EXPECT_LT(cost(cubic(-1, 0, 1, 2), {holds, holds, holds}), 2 * one_step(3));
    EXPECT_LT(cost(cubic(-3, -1, 0, 1), {fails, holds, holds}), 2 * one_step(3));
}

TEST(FirstFeasibleCost, TypicalProblemsTakeAFewSteps) {
    Random random(511);
    std::vector<std::int64_t> costs;
    for (int trial = 0; trial < 2000; ++trial) {
        const std::vector<Constraint<3, Counted>> constraints{{bounded(random_cubic(random)), {}, false}};
        costs.push_back(cost(random_cubic(random), constraints));
    }
    std::sort(costs.begin(), costs.end());
    EXPECT_LT(costs[costs.size() / 2], 10 * one_step(1));
    EXPECT_LT(costs[costs.size() * 99 / 100], 60 * one_step(1));
}

TEST(FirstFeasibleCost, AdversarialProblemsStopAtTheCeiling) {
    Random random(512);
    std::int64_t largest = 0;
    const Cubic grazing = cubic(1e-14, -1e-15, 1e-15, 1e-14);
    for (int trial = 0; trial < 2000; ++trial) {
        const Cubic function = random.chance(0.5) ? grazing * Counted(random.uniform(0, 1)) : random_cubic(random);
        const Cubic edge = random.chance(0.5) ? function * Counted(-1.0) : Cubic();
        const std::vector<Constraint<3, Counted>> constraints{{bounded(edge), bounded(random_cubic(random)), true},
                                                              {bounded(random_cubic(random)), {}, false}};
        largest = std::max(largest, cost(function, constraints));
    }
    std::cout << "largest cost " << double(largest) / double(one_step(3)) << " steps\n";
    // A step restricts at least the weight and F. The last step tests twice, with three more constraint sides.
    EXPECT_LT(largest, ceiling / 2 * one_step(0) + 2 * one_step(3));
    EXPECT_GT(largest, ceiling / 5 * one_step(3) / 2) << "the ceiling is not reached";
}

} // namespace
} // namespace chasles::algebra
