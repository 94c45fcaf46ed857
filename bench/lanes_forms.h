// Four lanes of doubles, in the forms that lanes_bench.cpp compares.
#pragma once

#include "chasles/algebra/lanes.h"

#include <array>
#include <cmath>

#if CHASLES_BENCH_HIGHWAY
#include <hwy/highway.h>
#endif

namespace chasles::bench {

using FourDoubles = std::array<double, 4>;

/// The form of the library.
struct LibraryForm {
    static constexpr const char* name = "library";
    using Lanes = algebra::Lanes<4, double>;
    Lanes lanes{};

    static LibraryForm all(double value) { return {Lanes::broadcast(value)}; }
    static LibraryForm of(const FourDoubles& values) {
        LibraryForm result;
        for (std::size_t i = 0; i < 4; ++i)
            result.lanes.set(i, values[i]);
        return result;
    }
    [[nodiscard]] FourDoubles values() const { return {lanes[0], lanes[1], lanes[2], lanes[3]}; }

    friend LibraryForm operator+(const LibraryForm& a, const LibraryForm& b) { return {a.lanes + b.lanes}; }
    friend LibraryForm operator-(const LibraryForm& a, const LibraryForm& b) { return {a.lanes - b.lanes}; }
    friend LibraryForm operator*(const LibraryForm& a, const LibraryForm& b) { return {a.lanes * b.lanes}; }
    friend LibraryForm magnitude(const LibraryForm& a) { return {magnitude(a.lanes)}; }
    friend bool all_above(const LibraryForm& a, const LibraryForm& b) { return all_above(a.lanes, b.lanes); }
};

/// A plain array with loops, vectorised by the compiler.
struct ArrayForm {
    static constexpr const char* name = "array";
    FourDoubles lanes{};

    static ArrayForm all(double value) { return {{value, value, value, value}}; }
    static ArrayForm of(const FourDoubles& values) { return {values}; }
    [[nodiscard]] FourDoubles values() const { return lanes; }

    template <class Operation>
    static ArrayForm zip(const ArrayForm& a, const ArrayForm& b, Operation operation) {
        ArrayForm result;
        for (std::size_t i = 0; i < 4; ++i)
            result.lanes[i] = operation(a.lanes[i], b.lanes[i]);
        return result;
    }
    friend ArrayForm operator+(const ArrayForm& a, const ArrayForm& b) {
        return zip(a, b, [](double x, double y) { return x + y; });
    }
    friend ArrayForm operator-(const ArrayForm& a, const ArrayForm& b) {
        return zip(a, b, [](double x, double y) { return x - y; });
    }
    friend ArrayForm operator*(const ArrayForm& a, const ArrayForm& b) {
        return zip(a, b, [](double x, double y) { return x * y; });
    }
    friend ArrayForm magnitude(const ArrayForm& a) {
        return zip(a, a, [](double x, double) { return std::abs(x); });
    }
    friend bool all_above(const ArrayForm& a, const ArrayForm& b) {
        bool above = true;
        for (std::size_t i = 0; i < 4; ++i)
            above &= a.lanes[i] > b.lanes[i];
        return above;
    }
};

#if CHASLES_BENCH_HIGHWAY
/// Google Highway with compile-time dispatch: one register of four doubles, two of two, or the registers of the target.
class HighwayForm {
    using Tag = hwy::HWY_NAMESPACE::CappedTag<double, 4>;
    static constexpr std::size_t width = hwy::HWY_NAMESPACE::MaxLanes(Tag());
    static constexpr std::size_t count = 4 / width;

public:
    static constexpr const char* name = "highway";
    hwy::HWY_NAMESPACE::Vec<Tag> part[count];

    static HighwayForm all(double value) {
        HighwayForm result;
        for (auto& part : result.part)
            part = hwy::HWY_NAMESPACE::Set(Tag(), value);
        return result;
    }
    static HighwayForm of(const FourDoubles& values) {
        HighwayForm result;
        for (std::size_t i = 0; i < count; ++i)
            result.part[i] = hwy::HWY_NAMESPACE::LoadU(Tag(), values.data() + width * i);
        return result;
    }
    [[nodiscard]] FourDoubles values() const {
        FourDoubles result;
        for (std::size_t i = 0; i < count; ++i)
            hwy::HWY_NAMESPACE::StoreU(part[i], Tag(), result.data() + width * i);
        return result;
    }

    template <class Operation>
    static HighwayForm zip(const HighwayForm& a, const HighwayForm& b, Operation operation) {
        HighwayForm result;
        for (std::size_t i = 0; i < count; ++i)
            result.part[i] = operation(a.part[i], b.part[i]);
        return result;
    }
    friend HighwayForm operator+(const HighwayForm& a, const HighwayForm& b) {
        return zip(a, b, [](auto x, auto y) { return hwy::HWY_NAMESPACE::Add(x, y); });
    }
    friend HighwayForm operator-(const HighwayForm& a, const HighwayForm& b) {
        return zip(a, b, [](auto x, auto y) { return hwy::HWY_NAMESPACE::Sub(x, y); });
    }
    friend HighwayForm operator*(const HighwayForm& a, const HighwayForm& b) {
        return zip(a, b, [](auto x, auto y) { return hwy::HWY_NAMESPACE::Mul(x, y); });
    }
    friend HighwayForm magnitude(const HighwayForm& a) {
        return zip(a, a, [](auto x, auto) { return hwy::HWY_NAMESPACE::Abs(x); });
    }
    friend bool all_above(const HighwayForm& a, const HighwayForm& b) {
        auto above = hwy::HWY_NAMESPACE::Gt(a.part[0], b.part[0]);
        for (std::size_t i = 1; i < count; ++i)
            above = hwy::HWY_NAMESPACE::And(above, hwy::HWY_NAMESPACE::Gt(a.part[i], b.part[i]));
        return hwy::HWY_NAMESPACE::AllTrue(Tag(), above);
    }
};
#endif

} // namespace chasles::bench
