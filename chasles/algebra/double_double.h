// Double-double numbers: the unevaluated sum of two doubles, about 106 bits. Every operation has a proven error bound.
// Sources: T. Dekker, "A floating-point technique for extending the available precision", 1971; M. Joldes, J.-M.
// Muller, V. Popescu, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic", ACM TOMS
// 44(2), 2017. The algorithm numbers below refer to the second paper.
#pragma once

#include "chasles/algebra/lanes.h"
#include "chasles/algebra/unit_roundoff.h"

#include <cfloat>
#include <cmath>

#if defined(__FAST_MATH__)
#error "chasles needs every operation rounded as it is written: compile without -ffast-math"
#endif

namespace chasles::algebra {

static_assert(FLT_EVAL_METHOD == 0, "chasles needs doubles that are rounded after every operation");

namespace detail {

/// The number high + low. A word is a double or a vector of doubles.
template <class Word>
struct WordPair {
    Word high{};
    Word low{};
};

/// a + b without error, for any order of magnitude (Knuth's TwoSum).
template <class Word>
WordPair<Word> exact_sum(const Word& a, const Word& b) {
    const Word sum = a + b;
    const Word b_part = sum - a;
    return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a + b without error if |a| >= |b| (Dekker's Fast2Sum).
template <class Word>
WordPair<Word> ordered_sum(const Word& a, const Word& b) {
    const Word sum = a + b;
    return {sum, b - (sum - a)};
}

/// a as the sum of two numbers with at most 26 bits each (Veltkamp's splitting).
template <class Word>
WordPair<Word> halves(const Word& a) {
    const Word scaled = a * (0x1p27 + 1);
    const Word high = scaled - (scaled - a);
    return {high, a - high};
}

/// a * b without error (Dekker). A fused multiply-add would give the same result, but it becomes a library call if the
/// target processor need not support it.
template <class Word>
WordPair<Word> exact_product(const Word& a, const Word& b) {
    const Word product = a * b;
    const WordPair<Word> x = halves(a);
    const WordPair<Word> y = halves(b);
    return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

/// -a, exactly.
template <class Word>
WordPair<Word> operator-(const WordPair<Word>& a) {
    return {-a.high, -a.low};
}
/// The sum, algorithm 6: relative error at most 3 u^2 + 13 u^3 with u = 2^-53.
template <class Word>
WordPair<Word> operator+(const WordPair<Word>& a, const WordPair<Word>& b) { // algorithm 6
    const WordPair<Word> high = exact_sum(a.high, b.high);
    const WordPair<Word> low = exact_sum(a.low, b.low);
    const WordPair<Word> partial = ordered_sum(high.high, Word(high.low + low.high));
    return ordered_sum(partial.high, Word(low.low + partial.low));
}
/// The product, algorithm 10: relative error at most 7 u^2.
template <class Word>
WordPair<Word> operator*(const WordPair<Word>& a, const WordPair<Word>& b) { // algorithm 10
    const WordPair<Word> high = exact_product(a.high, b.high);
    return ordered_sum(high.high, Word(high.low + (a.high * b.low + a.low * b.high)));
}
} // namespace detail

/// The number high + low with |low| <= half an ulp of high. The relative error of each operation is at most 2^-101
/// (unit_roundoff<DoubleDouble>) if nothing overflows or underflows.
class DoubleDouble {
public:
    constexpr DoubleDouble() = default;
    constexpr DoubleDouble(double value) : words_{value, 0} {} // NOLINT(google-explicit-constructor): widening is exact

    /// The number rounded to nearest.
    [[nodiscard]] constexpr double high() const { return words_.high; }
    /// The number minus high(), exactly.
    [[nodiscard]] constexpr double low() const { return words_.low; }
    constexpr explicit operator double() const { return high(); }

    /// a + b without error, for any order of magnitude.
    static DoubleDouble exact_sum(double a, double b) { return DoubleDouble(detail::exact_sum(a, b)); }
    /// a * b without error.
    static DoubleDouble exact_product(double a, double b) { return DoubleDouble(detail::exact_product(a, b)); }

    friend DoubleDouble operator-(const DoubleDouble& a) { return DoubleDouble(-a.words_); }
    friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
        return DoubleDouble(a.words_ + b.words_);
    }
    friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
    friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
        return DoubleDouble(a.words_ * b.words_);
    }
    /// The quotient. The additional step covers the rounding of the first two.
    friend DoubleDouble operator/(const DoubleDouble& a,
                                  const DoubleDouble& b) { // algorithm 18 with one additional step
        const double first = a.high() / b.high();
        const DoubleDouble rest = a - b * DoubleDouble(first);
        const double second = rest.high() / b.high();
        const double third = (rest - b * DoubleDouble(second)).high() / b.high();
        return exact_sum(first, second) + DoubleDouble(third);
    }
    /// The square root; 0 for a <= 0. Two Newton steps correct the root in double.
    friend DoubleDouble sqrt(const DoubleDouble& a) {
        if (!(a.high() > 0))
            return {};
        const double root = std::sqrt(a.high());
        const DoubleDouble rest = a - exact_product(root, root);
        const DoubleDouble corrected = exact_sum(root, rest.high() / (2 * root));
        const DoubleDouble remainder = a - corrected * corrected;
        return corrected + DoubleDouble(remainder.high() / (2 * root));
    }

    friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
        return a.high() < b.high() || (a.high() == b.high() && a.low() < b.low());
    }
    friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
    friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) { return !(b < a); }
    friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return !(a < b); }
    friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
        return a.high() == b.high() && a.low() == b.low();
    }

private:
    using Words = detail::WordPair<double>;
    friend struct Lanes<4, DoubleDouble>;

    constexpr explicit DoubleDouble(const Words& words) : words_(words) {}

    Words words_;
};

template <>
inline constexpr double unit_roundoff<DoubleDouble> = 0x1p-101;

#if defined(__GNUC__)
/// Four double-doubles in vector registers. The results are the same as for single double-doubles.
template <>
struct Lanes<4, DoubleDouble> {
    using Word = detail::WordPair<detail::Register>;
    std::array<Word, detail::registers> words{};

    /// The same number in all lanes.
    static Lanes broadcast(const DoubleDouble& value) {
        const Lanes<4, double> high = Lanes<4, double>::broadcast(value.high());
        const Lanes<4, double> low = Lanes<4, double>::broadcast(value.low());
        Lanes lanes;
        for (std::size_t i = 0; i < detail::registers; ++i)
            lanes.words[i] = {high.words[i], low.words[i]};
        return lanes;
    }
    DoubleDouble operator[](std::size_t i) const {
        const Word& word = words[i / detail::register_doubles];
        return DoubleDouble(
            detail::WordPair<double>{word.high[i % detail::register_doubles], word.low[i % detail::register_doubles]});
    }
    void set(std::size_t i, const DoubleDouble& value) {
        Word& word = words[i / detail::register_doubles];
        word.high[i % detail::register_doubles] = value.high();
        word.low[i % detail::register_doubles] = value.low();
    }

    friend Lanes operator+(const Lanes& a, const Lanes& b) {
        return {detail::zip(a.words, b.words, [](const Word& x, const Word& y) { return x + y; })};
    }
    friend Lanes operator-(const Lanes& a, const Lanes& b) {
        return {detail::zip(a.words, b.words, [](const Word& x, const Word& y) { return x + (-y); })};
    }
    friend Lanes operator*(const Lanes& a, const Lanes& b) {
        return {detail::zip(a.words, b.words, [](const Word& x, const Word& y) { return x * y; })};
    }
    /// The greater number in each lane.
    friend Lanes maximum(const Lanes& a, const Lanes& b) {
        return {
            detail::zip(a.words, b.words, [](const Word& x, const Word& y) { return select(is_below(y, x), x, y); })};
    }
    friend Lanes magnitude(const Lanes& a) {
        return {detail::zip(a.words, a.words,
                            [](const Word& x, const Word&) { return select(is_below(x, Word{}), -x, x); })};
    }
    /// Whether a > b in every lane.
    friend bool all_above(const Lanes& a, const Lanes& b) {
        bool above = true;
        for (std::size_t i = 0; i < 4; ++i)
            above = above && a[i] > b[i];
        return above;
    }

private:
    /// All bits of a lane are set where a condition holds.
    using Mask = decltype(detail::Register{} < detail::Register{});
    static Mask is_below(const Word& a, const Word& b) {
        return (a.high < b.high) | ((a.high == b.high) & (a.low < b.low));
    }
    static Word select(const Mask& where, const Word& a, const Word& b) {
        return {where ? a.high : b.high, where ? a.low : b.low};
    }
};
#endif

} // namespace chasles::algebra
