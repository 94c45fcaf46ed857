// A slab between two parallel planes around a patch of surface. For a nearly flat patch the slab is thin in any
// direction. Source: docs/derivations/14-node-pairs.md.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace chasles {

/// All points y of a patch, relative to the centre of its box, satisfy lower <= normal . y <= upper.
struct Slab {
    Eigen::Vector3f normal; ///< of 1-norm one; z >= 0
    float lower;
    float upper;
};

/// A slab in four bytes, relative to the box of its node. The normal is a point of the upper half of an octahedron,
/// projected to a square (Q. Meyer et al., "On floating-point normal vectors", 2010). Heights are multiples of 1/127 of
/// the greatest height of a box corner, rounded outward. They are correct up to a few roundings of single precision.
class PackedSlab {
public:
    static constexpr float height_unit = 1.0F / 127;
    static constexpr float normal_unit = 1.0F / 254;

    /// The slab that contains the whole box, with normal z.
    PackedSlab() = default;

    /// A slab with a normal along a vector of any length and either sign. The normal is z if the vector is almost zero
    /// or not finite. The slab contains the whole box until heights are set.
    explicit PackedSlab(const Eigen::Vector3f& along) {
        const float size = along.lpNorm<1>();
        if (!(size >= std::numeric_limits<float>::min() && size <= std::numeric_limits<float>::max()))
            return;
        const Eigen::Vector3f unit = std::copysign(1 / size, along.z()) * along;
        u_ = nearest(127 * (unit.x() + unit.y()));
        v_ = nearest(127 * (unit.x() - unit.y()));
    }

    /// Sets the heights, which are relative to the box centre. `half` holds half the sides of the box.
    void set_heights(float lower, float upper, const Eigen::Vector3f& half) {
        const float unit = normal().cwiseAbs().dot(half) * height_unit;
        if (!(unit >= std::numeric_limits<float>::min()))
            return;
        const float units = 1 / unit;
        lower_ = rounded_down(lower * units);
        upper_ = std::int8_t(-rounded_down(-upper * units));
    }

    [[nodiscard]] Eigen::Vector3f normal() const {
        const int x = u_ + v_;
        const int y = u_ - v_;
        return normal_unit * Eigen::Vector3f(float(x), float(y), float(254 - std::abs(x) - std::abs(y)));
    }

    /// The slab for a box with these half sides.
    [[nodiscard]] Slab in_box(const Eigen::Vector3f& half) const {
        const float unit = normal().cwiseAbs().dot(half) * height_unit;
        return {normal(), float(lower_) * unit, float(upper_) * unit};
    }

    /// The four bytes: x + y and x - y of the normal, the lower and the upper height.
    [[nodiscard]] std::uint32_t bytes() const {
        return std::bit_cast<std::uint32_t>(std::array<std::int8_t, 4>{u_, v_, lower_, upper_});
    }

private:
    // The functions of the standard library are calls on plain x86-64, therefore these functions avoid them.
    static std::int8_t nearest(float value) { return std::int8_t(value + std::copysign(0.5F, value)); }
    static std::int8_t rounded_down(float value) {
        const float clamped = std::max(-127.0F, std::min(value, 127.0F));
        const auto towards_zero = int(clamped);
        return std::int8_t(towards_zero - (clamped < float(towards_zero) ? 1 : 0));
    }

    std::int8_t u_ = 0;
    std::int8_t v_ = 0;
    std::int8_t lower_ = -127;
    std::int8_t upper_ = 127;
};

} // namespace chasles
