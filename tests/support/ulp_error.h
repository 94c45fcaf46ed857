// Measures the errors of functions in double against a hundred digits.
#pragma once

#include "tests/support/random.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cstdlib>

namespace chasles::test {

using Digits = boost::multiprecision::cpp_bin_float_100;

/// How many arguments a test draws.
inline int angle_rounds() {
    return std::getenv("CHASLES_LONG") ? 1'000'000 : 10'000;
}

/// The greatest error of a function in units in the last place of the true value, and its argument.
class UlpError {
public:
    void add(double computed, const Digits& truth, double argument) {
        const double ulp = std::ldexp(1.0, std::ilogb(double(truth)) - 52);
        const double error = std::abs(double((Digits(computed) - truth) / Digits(ulp)));
        if (error <= greatest_ || std::isnan(greatest_))
            return;
        greatest_ = error; // also where the error is not a number
        argument_ = argument;
    }
    /// Prints both.
    [[nodiscard]] double greatest(const char* name) const {
        std::cout << name << ": at most " << greatest_ << " ulp, for " << argument_ << "\n";
        return greatest_;
    }

private:
    double greatest_ = 0;
    double argument_ = 0;
};

} // namespace chasles::test
