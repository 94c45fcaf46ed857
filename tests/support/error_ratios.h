// The share of its error bound that each quantity uses: computed coefficients against exact ones.
#pragma once

#include "chasles/algebra/first_feasible.h"
#include "tests/support/random.h"
#include "tests/support/rational.h"

#include <map>
#include <string>

namespace chasles::test {

/// The largest ratio of error to bound for each named quantity, and the number of compared coefficients.
class ErrorRatios {
public:
    /// Compares the coefficients as computed, and after restriction to a random part as in first_feasible.
    template <class S>
    void note(Random& random, const std::string& name, const algebra::Bounded<3, S>& made,
              const Bernstein<3, Rational>& truth, const Bernstein<3, Rational>& weight) {
        add(name + scalar_name<S>(), made, truth, weight);
        const double from = random.uniform(0, 1);
        const double to = random.uniform(from, 1);
        const algebra::Bounded<3, S> part{algebra::restricted(made.polynomial, S(from), S(to)), made.error};
        add(name + scalar_name<S>(), part, algebra::restricted(truth, Rational(from), Rational(to)),
            algebra::restricted(weight, Rational(from), Rational(to)));
    }

    void note(const std::string& name, double ratio) {
        Entry& entry = entries_[name];
        ++entry.count;
        entry.largest = std::max(entry.largest, ratio);
    }

    /// Prints the table. Expects that every ratio is below one, and that no bound is too wide to show anything.
    void expect_sound(double least_of_largest) const {
        std::uint64_t total = 0;
        for (const auto& [name, entry] : entries_) {
            std::cout << "  " << name << ": " << entry.count << " compared, largest error over bound " << entry.largest
                      << "\n";
            EXPECT_LT(entry.largest, 1) << name;
            EXPECT_GT(entry.largest, least_of_largest)
                << name << ": the bound is too wide for this test to show anything";
            total += entry.count;
        }
        std::cout << "  in all: " << total << std::endl;
    }

private:
    struct Entry {
        std::uint64_t count = 0;
        double largest = 0;
    };

    template <class S>
    static std::string scalar_name() {
        return std::is_same_v<S, double> ? ", double" : ", double-double";
    }

    template <class S>
    void add(const std::string& name, const algebra::Bounded<3, S>& made, const Bernstein<3, Rational>& truth,
             const Bernstein<3, Rational>& weight) {
        for (int i = 0; i <= 3; ++i) {
            const Rational off = magnitude(Rational(exact(made.polynomial[i]) - truth[i]));
            note(name, static_cast<double>(Rational(off / (exact(made.error) * weight[i]))));
        }
    }

    std::map<std::string, Entry> entries_;
};

} // namespace chasles::test
