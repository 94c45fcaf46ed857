// N numbers with element-wise arithmetic. Four doubles use one vector register (AVX) or two (SSE2, NEON, WebAssembly).
// Any other count or scalar uses a plain array. The same source lines therefore run in double, double-double and exact
// rationals.
#pragma once

#include <array>
#include <cstddef>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace chasles::algebra {

/// N values of type Scalar with element-wise arithmetic.
template <std::size_t N, class Scalar>
struct Lanes {
    std::array<Scalar, N> values{};

    /// The same number in all lanes.
    static Lanes broadcast(const Scalar& value) {
        Lanes lanes;
        lanes.values.fill(value);
        return lanes;
    }
    /// Lane i.
    const Scalar& operator[](std::size_t i) const { return values[i]; }
    void set(std::size_t i, const Scalar& value) { values[i] = value; }

    /// Applies an operation to each pair of lanes.
    template <class Operation>
    static Lanes zip(const Lanes& a, const Lanes& b, Operation operation) {
        Lanes result;
        for (std::size_t i = 0; i < N; ++i)
            result.values[i] = operation(a.values[i], b.values[i]);
        return result;
    }
    friend Lanes operator+(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](const Scalar& x, const Scalar& y) -> Scalar { return x + y; });
    }
    friend Lanes operator-(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](const Scalar& x, const Scalar& y) -> Scalar { return x - y; });
    }
    friend Lanes operator*(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](const Scalar& x, const Scalar& y) -> Scalar { return x * y; });
    }
    /// The greater number in each lane; the lane of a if both are equal or one is not a number.
    friend Lanes maximum(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](const Scalar& x, const Scalar& y) -> Scalar { return x < y ? y : x; });
    }
    /// The absolute value of each lane.
    friend Lanes magnitude(const Lanes& a) {
        return zip(a, a, [](const Scalar& x, const Scalar&) -> Scalar { return x < Scalar(0) ? Scalar(-x) : x; });
    }
    /// Whether a > b in every lane.
    friend bool all_above(const Lanes& a, const Lanes& b) {
        bool above = true;
        for (std::size_t i = 0; i < N; ++i)
            above = above && a.values[i] > b.values[i];
        return above;
    }
};

#if defined(__GNUC__)
namespace detail {

/// The number of doubles in one register of the target. The compiler would pass wider vectors through memory.
#if defined(__AVX__)
inline constexpr std::size_t register_doubles = 4;
#else
inline constexpr std::size_t register_doubles = 2;
#endif
/// One register of doubles, and the number of registers for four doubles.
typedef double Register __attribute__((vector_size(8 * register_doubles))); // NOLINT(modernize-use-using)
inline constexpr std::size_t registers = 4 / register_doubles;

/// Applies an operation to each register of two arrays.
template <class Word, class Operation>
std::array<Word, registers> zip(const std::array<Word, registers>& a, const std::array<Word, registers>& b,
                                Operation operation) {
    if constexpr (registers == 1)
        return {operation(a[0], b[0])};
    else
        return {operation(a[0], b[0]), operation(a[1], b[1])};
}

/// Whether a > b in every lane.
inline bool all_above(const std::array<Register, registers>& a, const std::array<Register, registers>& b) {
#if defined(__AVX__)
    return _mm256_movemask_pd(_mm256_cmp_pd(__m256d(a[0]), __m256d(b[0]), _CMP_GT_OQ)) == 0xf;
#elif defined(__SSE2__)
    const __m128d low = _mm_cmpgt_pd(__m128d(a[0]), __m128d(b[0]));
    const __m128d high = _mm_cmpgt_pd(__m128d(a[1]), __m128d(b[1]));
    return _mm_movemask_pd(_mm_and_pd(low, high)) == 0x3;
#else
    return a[0][0] > b[0][0] && a[0][1] > b[0][1] && a[1][0] > b[1][0] && a[1][1] > b[1][1];
#endif
}

} // namespace detail

/// The fast case. GCC and Clang lower these compiler vectors to the instructions of the target.
template <>
struct Lanes<4, double> {
    using Words = std::array<detail::Register, detail::registers>;
    Words words{};

    /// The same number in all lanes.
    static Lanes broadcast(double value) {
        Lanes lanes;
        // A scalar minus a zero vector: the compiler broadcasts the scalar, and x - 0 is x, also for -0.
        lanes.words.fill(value - detail::Register{});
        return lanes;
    }
    double operator[](std::size_t i) const { return words[i / detail::register_doubles][i % detail::register_doubles]; }
    void set(std::size_t i, double value) { words[i / detail::register_doubles][i % detail::register_doubles] = value; }

    friend Lanes operator+(const Lanes& a, const Lanes& b) {
        return {detail::zip(a.words, b.words, [](auto x, auto y) { return x + y; })};
    }
    friend Lanes operator-(const Lanes& a, const Lanes& b) {
        return {detail::zip(a.words, b.words, [](auto x, auto y) { return x - y; })};
    }
    friend Lanes operator*(const Lanes& a, const Lanes& b) {
        return {detail::zip(a.words, b.words, [](auto x, auto y) { return x * y; })};
    }
    friend Lanes maximum(const Lanes& a, const Lanes& b) {
        return {detail::zip(a.words, b.words, [](auto x, auto y) { return x < y ? y : x; })};
    }
    friend Lanes magnitude(const Lanes& a) {
        return {detail::zip(a.words, a.words, [](auto x, auto) { return x < 0.0 ? -x : x; })};
    }
    friend bool all_above(const Lanes& a, const Lanes& b) { return detail::all_above(a.words, b.words); }
};
#endif

} // namespace chasles::algebra
