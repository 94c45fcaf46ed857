// N numbers side by side. Four doubles are one vector register (AVX), or two (SSE2, NEON, WebAssembly); any other
// count or scalar is a plain array, so that the same lines run in double, double-double and exact rationals.
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

    static Lanes all(const Scalar& value) {
        Lanes lanes;
        lanes.values.fill(value);
        return lanes;
    }
    const Scalar& operator[](std::size_t i) const { return values[i]; }
    void set(std::size_t i, const Scalar& value) { values[i] = value; }

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
    friend Lanes maximum(const Lanes& a, const Lanes& b) {
        return zip(a, b, [](const Scalar& x, const Scalar& y) -> Scalar { return x < y ? y : x; });
    }
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
/// The fast case: compiler vectors, which GCC and Clang lower to whatever the target has.
template <>
struct Lanes<4, double> {
    typedef double Native __attribute__((vector_size(32)));
    Native values{};

    static Lanes all(double value) { return {Native{value, value, value, value}}; }
    double operator[](std::size_t i) const { return values[i]; }
    void set(std::size_t i, double value) { values[i] = value; }

    friend Lanes operator+(const Lanes& a, const Lanes& b) { return {a.values + b.values}; }
    friend Lanes operator-(const Lanes& a, const Lanes& b) { return {a.values - b.values}; }
    friend Lanes operator*(const Lanes& a, const Lanes& b) { return {a.values * b.values}; }
    friend Lanes maximum(const Lanes& a, const Lanes& b) { return {a.values < b.values ? b.values : a.values}; }
    friend Lanes magnitude(const Lanes& a) { return {a.values < 0.0 ? -a.values : a.values}; }
    friend bool all_above(const Lanes& a, const Lanes& b) {
#if defined(__AVX__)
        return _mm256_movemask_pd(_mm256_cmp_pd(__m256d(a.values), __m256d(b.values), _CMP_GT_OQ)) == 0xf;
#elif defined(__SSE2__)
        const __m128d low = _mm_cmpgt_pd(__m128d{a.values[0], a.values[1]}, __m128d{b.values[0], b.values[1]});
        const __m128d high = _mm_cmpgt_pd(__m128d{a.values[2], a.values[3]}, __m128d{b.values[2], b.values[3]});
        return _mm_movemask_pd(_mm_and_pd(low, high)) == 0x3;
#else
        return a[0] > b[0] && a[1] > b[1] && a[2] > b[2] && a[3] > b[3];
#endif
    }
};
#endif

} // namespace chasles::algebra
