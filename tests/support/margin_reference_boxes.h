// Boxes around features over an interval of time, in doubles that know how far off they may be: what they tell to be
// farther apart than the margin needs no exact arithmetic.
#pragma once

#include "tests/support/exact_reference.h"

#include <limits>

namespace chasles::reference {

/// A vertex, an edge or a triangle of a body, by its one, two or three vertices.
struct MarginFeature {
    std::size_t size;
    std::array<std::uint32_t, 3> vertices;
};

/// Two features by their numbers.
struct FeaturePair {
    std::uint32_t moving;
    std::uint32_t fixed;
};

struct Box {
    std::array<double, 3> lower{};
    std::array<double, 3> upper{};
};

/// Bernstein coefficients of all moving points and of the weight on an interval of time.
struct CellBoxes {
    using Cubic = std::array<Tracked, 4>;
    std::vector<std::array<Cubic, 3>> points;
    Cubic weight;

    [[nodiscard]] std::pair<CellBoxes, CellBoxes> halves() const {
        std::pair<CellBoxes, CellBoxes> result{*this, *this};
        split(weight, result.first.weight, result.second.weight);
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                split(points[i][axis], result.first.points[i][axis], result.second.points[i][axis]);
        return result;
    }

private:
    static void split(Cubic c, Cubic& left, Cubic& right) {
        const Tracked half{0.5, 0.5};
        for (std::size_t i = 0; i < 4; ++i) {
            left[i] = c[0];
            right[3 - i] = c[3 - i];
            for (std::size_t j = 0; j + i < 3; ++j)
                c[j] = (c[j] + c[j + 1]) * half;
        }
    }
};

class MarginBoxes {
public:
    MarginBoxes() = default;
    MarginBoxes(const std::vector<Eigen::Vector3d>& moving, const std::vector<Eigen::Vector3d>& fixed,
                const MotionPath<Rational>& motion, double margin) {
        WholeUnit unit;
        for (const auto* vertices : {&moving, &fixed})
            for (const Eigen::Vector3d& v : *vertices)
                unit.cover(v);
        const MotionPath<Tracked> rounded = doubles(motion, unit.exponent);
        whole_.weight = bernstein(rounded.weight + Polynomial<Tracked, 3>{});
        for (const Eigen::Vector3d& v : moving) {
            const MovedPoint<Tracked> p = moved(rounded, unit.rounded(v));
            whole_.points.push_back({bernstein(p.path[0]), bernstein(p.path[1]), bernstein(p.path[2])});
        }
        for (const Eigen::Vector3d& v : fixed) {
            const auto x = unit.rounded(v);
            const std::array<double, 3> at{x[0].value, x[1].value, x[2].value};
            fixed_.push_back({at, at});
        }
        margin_ = std::ldexp(margin, -unit.exponent) * (1 + 0x1p-40);
    }

    [[nodiscard]] const CellBoxes& whole() const { return whole_; }
    [[nodiscard]] CellBoxes at_start() const {
        CellBoxes result = whole_;
        result.weight.fill(whole_.weight[0]);
        for (auto& point : result.points)
            for (auto& c : point)
                c.fill(Tracked(c[0]));
        return result;
    }

    [[nodiscard]] Box around(const CellBoxes& cell, std::size_t body, const MarginFeature& feature) const {
        Box result = body == 0 ? around(cell, feature.vertices[0]) : fixed_[feature.vertices[0]];
        for (std::size_t i = 1; i < feature.size; ++i) {
            const Box other = body == 0 ? around(cell, feature.vertices[i]) : fixed_[feature.vertices[i]];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                result.lower[axis] = std::min(result.lower[axis], other.lower[axis]);
                result.upper[axis] = std::max(result.upper[axis], other.upper[axis]);
            }
        }
        return result;
    }

    [[nodiscard]] bool are_farther_apart(const Box& a, const Box& b) const {
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double gap = std::max({0.0, a.lower[axis] - b.upper[axis], b.lower[axis] - a.upper[axis]});
            square += gap * gap;
        }
        return square > margin_ * margin_ * (1 + 0x1p-40) + 1e-280;
    }

private:
    static CellBoxes::Cubic bernstein(const Polynomial<Tracked, 3>& p) {
        const Tracked third{1.0 / 3, 1.0 / 3};
        CellBoxes::Cubic c;
        c[0] = p[0];
        c[1] = p[0] + p[1] * third;
        c[2] = c[1] + (p[1] + p[2]) * third;
        c[3] = p[0] + p[1] + p[2] + p[3];
        return c;
    }

    /// The curve is in the hull of its control points: numerator over weight, whose weights are positive.
    [[nodiscard]] static Box around(const CellBoxes& cell, std::uint32_t vertex) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Box result{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t k = 0; k < 4; ++k) {
                const Tracked& x = cell.points[vertex][axis][k];
                const Tracked& w = cell.weight[k];
                const double weight_error = 0x1p-44 * w.size;
                if (w.value <= 2 * weight_error)
                    return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
                const double at = x.value / w.value;
                const double error = (0x1p-44 * x.size + std::abs(at) * weight_error) / (w.value - weight_error);
                const double wider = (error + 0x1p-50 * std::abs(at)) * (1 + 0x1p-40) + 1e-280;
                result.lower[axis] = std::min(result.lower[axis], at - wider);
                result.upper[axis] = std::max(result.upper[axis], at + wider);
            }
        return result;
    }

    CellBoxes whole_;
    std::vector<Box> fixed_;
    double margin_ = 0;
};

} // namespace chasles::reference
