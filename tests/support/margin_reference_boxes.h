// Features over an interval of time, in doubles with error bounds. A pair that boxes or a slab prove to be farther
// apart than the margin needs no exact arithmetic.
#pragma once

#include "tests/support/exact_reference.h"

#include <limits>

namespace chasles::reference {

/// A vertex, an edge or a triangle of a body, given by one, two or three vertices.
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

    /// Whether some slab between the features stays wider than the margin. Directions are guesses at the middle of the
    /// interval; the separation is proven.
    [[nodiscard]] bool are_separated(const CellBoxes& cell, const MarginFeature& a, const MarginFeature& b) const {
        std::array<Eigen::Vector3d, 3> at_a;
        std::array<Eigen::Vector3d, 3> at_b;
        for (std::size_t i = 0; i < 3; ++i) {
            at_a[i] = middle_of(around(cell, a.vertices[i]));
            at_b[i] = middle_of(fixed_[b.vertices[i]]);
        }
        const auto separates = [&](const Eigen::Vector3d& direction) { return is_slab_between(cell, a, b, direction); };
        if (a.size == 2 && b.size == 2 && separates((at_a[1] - at_a[0]).cross(at_b[1] - at_b[0])))
            return true;
        if (a.size == 3 && separates((at_a[1] - at_a[0]).cross(at_a[2] - at_a[0])))
            return true;
        if (b.size == 3 && separates((at_b[1] - at_b[0]).cross(at_b[2] - at_b[0])))
            return true;
        return separates(shortest(at_a, a.size, at_b, b.size));
    }

private:
    static Eigen::Vector3d middle_of(const Box& box) {
        return {0.5 * (box.lower[0] + box.upper[0]), 0.5 * (box.lower[1] + box.upper[1]),
                0.5 * (box.lower[2] + box.upper[2])};
    }

    /// An approximation of the shortest connection from a vertex or edge of one feature to a vertex of the other
    /// feature.
    static Eigen::Vector3d shortest(const std::array<Eigen::Vector3d, 3>& a, std::size_t a_size,
                                    const std::array<Eigen::Vector3d, 3>& b, std::size_t b_size) {
        Eigen::Vector3d best = a[0] - b[0];
        const auto offer = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
            const Eigen::Vector3d u = to - from;
            const double square = u.squaredNorm();
            const double along = square > 0 ? std::clamp(u.dot(p - from) / square, 0.0, 1.0) : 0;
            const Eigen::Vector3d way = p - from - along * u;
            if (way.squaredNorm() < best.squaredNorm())
                best = way;
        };
        for (std::size_t i = 0; i < a_size; ++i)
            for (std::size_t j = 0; j < b_size; ++j) {
                offer(a[i], b[j], b[(j + 1) % b_size]);
                offer(b[j], a[i], a[(i + 1) % a_size]);
            }
        return best;
    }

    struct Range {
        double lower = std::numeric_limits<double>::infinity();
        double upper = -std::numeric_limits<double>::infinity();

        void cover(double x, double error) {
            lower = std::min(lower, x - error);
            upper = std::max(upper, x + error);
        }
    };

    [[nodiscard]] bool is_slab_between(const CellBoxes& cell, const MarginFeature& a, const MarginFeature& b,
                                       const Eigen::Vector3d& direction) const {
        const double length = direction.norm();
        if (!(length > 1e-100) || !(length < 1e100))
            return false;
        const Eigen::Vector3d n = direction / length;
        const std::array<Tracked, 3> normal{Tracked{n.x(), std::abs(n.x())}, Tracked{n.y(), std::abs(n.y())},
                                            Tracked{n.z(), std::abs(n.z())}};
        Range of_a;
        for (std::size_t i = 0; i < a.size; ++i)
            for (std::size_t k = 0; k < 4; ++k) {
                const auto& point = cell.points[a.vertices[i]];
                const Tracked x = point[0][k] * normal[0] + point[1][k] * normal[1] + point[2][k] * normal[2];
                if (!cover_quotient(of_a, x, cell.weight[k]))
                    return false;
            }
        Range of_b;
        for (std::size_t i = 0; i < b.size; ++i) {
            const auto& p = fixed_[b.vertices[i]].lower;
            const double x = p[0] * n.x() + p[1] * n.y() + p[2] * n.z();
            of_b.cover(x, 0x1p-48 * (std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2])) + 1e-280);
        }
        return std::max(of_a.lower - of_b.upper, of_b.lower - of_a.upper) > margin_ * n.norm() * (1 + 0x1p-40);
    }

    /// Returns false if the weight may not be positive.
    static bool cover_quotient(Range& range, const Tracked& x, const Tracked& w) {
        const double weight_error = 0x1p-44 * w.size;
        if (w.value <= 2 * weight_error)
            return false;
        const double at = x.value / w.value;
        const double error = (0x1p-44 * x.size + std::abs(at) * weight_error) / (w.value - weight_error);
        range.cover(at, (error + 0x1p-50 * std::abs(at)) * (1 + 0x1p-40) + 1e-280);
        return true;
    }

    static CellBoxes::Cubic bernstein(const Polynomial<Tracked, 3>& p) {
        const Tracked third{1.0 / 3, 1.0 / 3};
        CellBoxes::Cubic c;
        c[0] = p[0];
        c[1] = p[0] + p[1] * third;
        c[2] = c[1] + (p[1] + p[2]) * third;
        c[3] = p[0] + p[1] + p[2] + p[3];
        return c;
    }

    /// The box of the control points (numerator over weight), whose hull contains the curve, because weights are
    /// positive.
    [[nodiscard]] static Box around(const CellBoxes& cell, std::uint32_t vertex) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Box result;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Range range;
            for (std::size_t k = 0; k < 4; ++k)
                if (!cover_quotient(range, cell.points[vertex][axis][k], cell.weight[k]))
                    return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
            result.lower[axis] = range.lower;
            result.upper[axis] = range.upper;
        }
        return result;
    }

    CellBoxes whole_;
    std::vector<Box> fixed_;
    double margin_ = 0;
};

} // namespace chasles::reference
