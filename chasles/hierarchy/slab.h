// A slab of space around a patch of surface: thin where the patch is nearly flat, however it is tilted in its box.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace chasles {

/// All points y of a patch, relative to the middle of its box, have heights lower <= normal . y <= upper.
struct Slab {
    Eigen::Vector3f normal; ///< the magnitudes of its components add up to one; z >= 0
    float lower;
    float upper;
};

/// A slab in four bytes, in terms of the box that it belongs to. The normal is a point of the upper half of an
/// octahedron, which is a square seen from above (Q. Meyer et al., "On floating-point normal vectors", 2010); heights
/// are 127ths of those of the box's corners, rounded outward. They hold up to a few roundings of single precision.
class PackedSlab {
public:
    static constexpr float height_unit = 1.0F / 127;
    static constexpr float normal_unit = 1.0F / 254;

    /// The whole box.
    PackedSlab() = default;

    /// Along a vector of any length and either sign; z if it is next to zero or not finite. Until heights are set: the
    /// box.
    explicit PackedSlab(const Eigen::Vector3f& along) {
        const float size = along.lpNorm<1>();
        if (!(size >= std::numeric_limits<float>::min() && size <= std::numeric_limits<float>::max()))
            return;
        const Eigen::Vector3f unit = std::copysign(1 / size, along.z()) * along;
        u_ = nearest(127 * (unit.x() + unit.y()));
        v_ = nearest(127 * (unit.x() - unit.y()));
    }

    void set_heights(float lower, float upper, const Eigen::Vector3f& half) {
        const float unit = normal().cwiseAbs().dot(half) * height_unit;
        if (!(unit >= std::numeric_limits<float>::min()))
            return;
        const float units = 1 / unit;
        lower_ = at_most(lower * units);
        upper_ = std::int8_t(-at_most(-upper * units));
    }

    [[nodiscard]] Eigen::Vector3f normal() const {
        const int x = u_ + v_;
        const int y = u_ - v_;
        return normal_unit * Eigen::Vector3f(float(x), float(y), float(254 - std::abs(x) - std::abs(y)));
    }

    [[nodiscard]] Slab in_box(const Eigen::Vector3f& half) const {
        const float unit = normal().cwiseAbs().dot(half) * height_unit;
        return {normal(), float(lower_) * unit, float(upper_) * unit};
    }

    /// x + y and x - y of the normal, the heights.
    [[nodiscard]] std::uint32_t bytes() const {
        return std::bit_cast<std::uint32_t>(std::array<std::int8_t, 4>{u_, v_, lower_, upper_});
    }

private:
    // Without calls, which the functions of the standard library are on plain x86-64.
    static std::int8_t nearest(float value) { return std::int8_t(value + std::copysign(0.5F, value)); }
    static std::int8_t at_most(float value) {
        const float held = std::max(-127.0F, std::min(value, 127.0F));
        const auto towards_zero = int(held);
        return std::int8_t(towards_zero - (held < float(towards_zero) ? 1 : 0));
    }

    std::int8_t u_ = 0;
    std::int8_t v_ = 0;
    std::int8_t lower_ = -127;
    std::int8_t upper_ = 127;
};

} // namespace chasles
