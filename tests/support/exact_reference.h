// The exact first touch of two moving polyhedra: all pairs of features in exact arithmetic, with every case decided.
// Written from first principles. The reference shares no code with chasles/, and none of its solvers.
#pragma once

#include "tests/support/exact_reference_features.h"
#include "tests/support/exact_reference_instant.h"

#include <algorithm>
#include <set>
#include <span>

namespace chasles::reference {

/// All vertices, the vertices that are corners of faces, the edges of faces, and triangles that cover the faces with an
/// area. A face without area is its edges.
struct Surface {
    std::vector<Eigen::Vector3d> vertices;
    std::set<std::uint32_t> corners;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> segments; ///< edges of triangles without area

    /// From faces that are convex and exactly planar polygons.
    static Surface from_convex_faces(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::vector<std::uint32_t>> faces) {
        Surface surface{{vertices.begin(), vertices.end()}, {}, {}, {}, {}};
        for (const auto& face : faces) {
            surface.add_outline(face);
            for (std::size_t i = 1; i + 1 < face.size(); ++i)
                surface.add_triangle({face[0], face[i], face[i + 1]});
        }
        return surface;
    }

    void add_triangle(const std::array<std::uint32_t, 3>& triangle) {
        if (has_area(triangle))
            return triangles.push_back(triangle);
        for (std::size_t i = 0; i < 3; ++i)
            if (vertices[triangle[i]] != vertices[triangle[(i + 1) % 3]])
                segments.push_back({triangle[i], triangle[(i + 1) % 3]});
    }

    [[nodiscard]] bool has_area(const std::array<std::uint32_t, 3>& triangle) const {
        const auto point = [&](std::size_t i) {
            const Eigen::Vector3d& v = vertices[triangle[i]];
            return std::array{Rational(v.x()), Rational(v.y()), Rational(v.z())};
        };
        const auto a = point(0), b = point(1), c = point(2);
        for (std::size_t x = 0; x < 3; ++x) {
            const std::size_t y = (x + 1) % 3;
            if ((b[x] - a[x]) * (c[y] - a[y]) != (b[y] - a[y]) * (c[x] - a[x]))
                return true;
        }
        return false;
    }

    void add_outline(const std::vector<std::uint32_t>& face) {
        corners.insert(face.begin(), face.end());
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t from = face[i];
            const std::uint32_t to = face[(i + 1) % face.size()];
            const std::array edge{std::min(from, to), std::max(from, to)};
            if (vertices[from] != vertices[to] && std::find(edges.begin(), edges.end(), edge) == edges.end())
                edges.push_back(edge);
        }
    }
};

/// A unit of length for two bodies in which all coordinates are whole numbers.
struct WholeUnit {
    unsigned bits = 0;    ///< the unit is 2^-bits
    int exponent = -1000; ///< exponent of the largest coordinate

    void cover(const Eigen::Vector3d& v) {
        for (const double x : v) {
            if (x == 0)
                continue;
            int power = 0;
            const auto mantissa = static_cast<std::uint64_t>(std::abs(std::ldexp(std::frexp(x, &power), 53)));
            const int last = power - 53 + std::countr_zero(mantissa);
            bits = std::max(bits, last < 0 ? static_cast<unsigned>(-last) : 0u);
            exponent = std::max(exponent, power);
        }
    }
    [[nodiscard]] Point whole(const Eigen::Vector3d& v) const {
        const auto one = [&](double x) {
            return Integer(numerator(Rational(Rational(x) * Integer(Integer(1) << bits))));
        };
        return {one(v.x()), one(v.y()), one(v.z())};
    }
    [[nodiscard]] std::array<Tracked, 3> rounded(const Eigen::Vector3d& v) const {
        const auto one = [&](double x) {
            return Tracked{std::ldexp(x, -exponent), std::abs(std::ldexp(x, -exponent))};
        };
        return {one(v.x()), one(v.y()), one(v.z())};
    }
};

/// The number of pairs for each kind of work.
struct ReferenceWork {
    std::uint64_t pairs = 0;
    std::uint64_t exact = 0;
};

/// Two bodies under one motion. Features can be tested in pairs or all together.
class ExactScene {
public:
    ExactScene(const Surface& moving, const Surface& fixed, const MotionPath<Rational>& motion)
        : moving_surface_(moving), fixed_surface_(fixed) {
        WholeUnit unit;
        for (const Surface* surface : {&moving, &fixed})
            for (const Eigen::Vector3d& v : surface->vertices)
                unit.cover(v);
        motion_ = whole_numbers(motion, unit.bits);
        // The magnitude of position numerators is the largest coordinate, or the largest shift over the weight.
        int shift_exponent = unit.exponent;
        const double weight = std::max(static_cast<double>(magnitude_of(motion.weight)), 1e-290);
        for (const auto& shift : motion.shift) {
            const double size = static_cast<double>(magnitude_of(shift)) / weight;
            shift_exponent = size > 0 ? std::max(shift_exponent, std::ilogb(size)) : shift_exponent;
        }
        unit.exponent = shift_exponent;
        rounded_motion_ = doubles(motion, unit.exponent);
        weight_ = primitive(coefficients(motion_.weight));
        for (const Eigen::Vector3d& v : moving.vertices) {
            moving_.push_back(moved(motion_, unit.whole(v)));
            rounded_moving_.push_back(moved(rounded_motion_, unit.rounded(v)));
        }
        for (const Eigen::Vector3d& v : fixed.vertices) {
            fixed_.push_back(standing(motion_, unit.whole(v)));
            rounded_fixed_.push_back(standing(rounded_motion_, unit.rounded(v)));
        }
    }

    /// Whether the surfaces have a point in common at tau = 0.
    [[nodiscard]] bool touches_at_start() const {
        const auto at_start = [](const std::vector<MovedPoint<Integer>>& points) {
            std::vector<Point> result;
            for (const auto& p : points)
                result.push_back({p.path[0][0], p.path[1][0], p.path[2][0]});
            return result;
        };
        const std::vector<Point> a = at_start(moving_);
        const std::vector<Point> b = at_start(fixed_);
        return any_edge_meets(moving_surface_, a, fixed_surface_, b) ||
               any_edge_meets(fixed_surface_, b, moving_surface_, a);
    }

    void vertex_triangle(Earliest& earliest, std::uint32_t vertex, const std::array<std::uint32_t, 3>& t) {
        ask_vertex(earliest, {vertex, t, false});
    }
    void triangle_vertex(Earliest& earliest, const std::array<std::uint32_t, 3>& t, std::uint32_t vertex) {
        ask_vertex(earliest, {vertex, t, true});
    }
    void edges(Earliest& earliest, const std::array<std::uint32_t, 2>& e, const std::array<std::uint32_t, 2>& f) {
        ++work_.pairs;
        if (EdgePair<Tracked>{rounded_motion_, rounded_moving_[e[0]], rounded_moving_[e[1]], rounded_fixed_[f[0]],
                              rounded_fixed_[f[1]]}
                .is_plainly_apart())
            return;
        ++work_.exact;
        offer_edges(earliest, {motion_, moving_[e[0]], moving_[e[1]], fixed_[f[0]], fixed_[f[1]]}, weight_);
    }

    /// The first touch of the two surfaces, if there is one.
    [[nodiscard]] std::optional<Root> first_touch() {
        Earliest earliest;
        if (touches_at_start()) {
            earliest.offer(Root::point(0, 0), [](Root&) { return true; });
            return earliest.first();
        }
        for (const std::uint32_t v : moving_surface_.corners)
            for (const auto& t : fixed_surface_.triangles)
                vertex_triangle(earliest, v, t);
        for (const std::uint32_t v : fixed_surface_.corners)
            for (const auto& t : moving_surface_.triangles)
                triangle_vertex(earliest, t, v);
        for (const auto& e : moving_surface_.edges)
            for (const auto& f : fixed_surface_.edges)
                edges(earliest, e, f);
        return earliest.first();
    }

    [[nodiscard]] const ReferenceWork& work() const { return work_; }

private:
    struct VertexQuestion {
        std::uint32_t vertex;
        std::array<std::uint32_t, 3> triangle;
        bool triangle_moves;
    };

    template <class N>
    static VertexTriangle<N> pair_of(const VertexQuestion& q, const MotionPath<N>& motion,
                                     const std::vector<MovedPoint<N>>& moving,
                                     const std::vector<MovedPoint<N>>& fixed) {
        const auto& corners = q.triangle_moves ? moving : fixed;
        const auto& vertices = q.triangle_moves ? fixed : moving;
        return {motion,
                vertices[q.vertex],
                {&corners[q.triangle[0]], &corners[q.triangle[1]], &corners[q.triangle[2]]},
                q.triangle_moves};
    }

    void ask_vertex(Earliest& earliest, const VertexQuestion& question) {
        ++work_.pairs;
        if (pair_of(question, rounded_motion_, rounded_moving_, rounded_fixed_).is_plainly_apart())
            return;
        ++work_.exact;
        offer_vertex_triangle(earliest, pair_of(question, motion_, moving_, fixed_), weight_);
    }

    static bool any_edge_meets(const Surface& a, const std::vector<Point>& at, const Surface& b,
                               const std::vector<Point>& bt) {
        return std::any_of(a.edges.begin(), a.edges.end(), [&](const auto& e) {
            return std::any_of(b.triangles.begin(), b.triangles.end(),
                               [&](const auto& t) {
                                   return segment_meets_triangle(at[e[0]], at[e[1]], {&bt[t[0]], &bt[t[1]], &bt[t[2]]});
                               }) ||
                   std::any_of(b.segments.begin(), b.segments.end(),
                               [&](const auto& s) { return do_segments_meet(at[e[0]], at[e[1]], bt[s[0]], bt[s[1]]); });
        });
    }

    template <std::size_t Count>
    static Rational magnitude_of(const std::array<Rational, Count>& p) {
        Rational largest(0);
        for (const Rational& c : p)
            largest = std::max<Rational>(largest, abs(c));
        return largest;
    }

    const Surface& moving_surface_;
    const Surface& fixed_surface_;
    MotionPath<Integer> motion_;
    MotionPath<Tracked> rounded_motion_;
    Coefficients weight_;
    std::vector<MovedPoint<Integer>> moving_;
    std::vector<MovedPoint<Integer>> fixed_;
    std::vector<MovedPoint<Tracked>> rounded_moving_;
    std::vector<MovedPoint<Tracked>> rounded_fixed_;
    ReferenceWork work_;
};

} // namespace chasles::reference
