// Random problems for `first_feasible` in rationals, often with double roots, coincidences and roots at 0 and 1.
#pragma once

#include "tests/support/exact_feasible.h"
#include "tests/support/random.h"

namespace chasles::test {

/// A multiple of 1/16. The ends, the middle and repetitions are more frequent than in a uniform distribution.
inline Rational random_root(Random& random) {
    if (random.chance(0.2))
        return ratio(random.integer(0, 2), 2);
    return ratio(random.integer(-6, 22), 16);
}

/// Random roots, some of them within `scale` of an end.
struct RootPlaces {
    Rational scale = 1;
    bool at_the_end = false;

    static RootPlaces next_to_an_end(Random& random) {
        return {Rational(std::ldexp(1.0, -random.integer(5, 50))), random.chance(0.5)};
    }
    [[nodiscard]] Rational root(Random& random) const {
        const Rational root = random_root(random);
        if (scale == 1 || random.chance(0.3))
            return root;
        return at_the_end ? Rational(1 - scale * root) : Rational(scale * root);
    }
};

inline PowerPolynomial random_function(Random& random, int degree, const RootPlaces& places = {}) {
    if (random.chance(0.05))
        return {};
    std::vector<Rational> roots;
    for (int i = 0; i < degree; ++i)
        roots.push_back(!roots.empty() && random.chance(0.15) ? roots.back() : places.root(random));
    PowerPolynomial function = from_roots(roots, random.chance(0.5) ? 1 : -3);
    return random.chance(0.3) ? sum(function, {ratio(random.integer(-2, 2), 64)}) : function;
}

template <int Degree>
algebra::Bounded<Degree, Rational> random_side(Random& random, const RootPlaces& places) {
    const int degree = random.integer(0, Degree);
    return {bernstein_form<Degree>(random_function(random, degree, places)), 0};
}

/// Coefficients of all orders of magnitude: slopes near a root say little about the polynomial elsewhere.
template <int Degree>
algebra::Bernstein<Degree, Rational> of_many_sizes(Random& random) {
    algebra::Bernstein<Degree, Rational> polynomial;
    for (int i = 0; i <= Degree; ++i)
        polynomial.set(i, Rational(random.scaled(-18, 0)));
    return polynomial;
}

template <int Degree>
OwnedProblem<Degree, Rational> random_problem(Random& random, const RootPlaces& places = {}) {
    OwnedProblem<Degree, Rational> problem;
    problem.function.polynomial = places.scale != 1 && random.chance(0.5)
                                      ? of_many_sizes<Degree>(random)
                                      : bernstein_form<Degree>(random_function(random, Degree, places));
    const int count = random.integer(0, 3);
    for (int i = 0; i < count; ++i)
        problem.constraints.push_back(
            {random_side<Degree>(random, places), random_side<Degree>(random, places), random.chance(0.4),
             random.chance(0.3) ? std::optional(ratio(random.integer(0, 3), 4)) : std::nullopt});
    return problem;
}

} // namespace chasles::test
