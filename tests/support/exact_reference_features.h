// The first tau at which a vertex lies on a triangle, and at which two edges intersect: by the volume of four points,
// or by projection on a coordinate plane if the volume vanishes. All cases are decided, including parallel and flat
// ones.
#pragma once

#include "tests/support/exact_reference_motion.h"

#include <optional>

namespace chasles::reference {

/// The first root at which a condition holds, over many candidate roots.
class Earliest {
public:
    /// Evaluates `holds` only for a root before the current one.
    template <class Holds>
    void offer(Root root, Holds holds) {
        if (first_ && first_->is_plainly_before(root))
            return;
        if (first_ && compare(*first_, root) <= 0)
            return;
        if (holds(root))
            first_ = root;
    }
    [[nodiscard]] std::optional<Root>& first() { return first_; }

private:
    std::optional<Root> first_;
};

/// A point of either body, times the weight; the degree is 3 for a moving point. `body` is the point in its body's
/// frame.
template <class N>
struct MovedPoint {
    std::array<N, 3> body;
    Vector<N, 3> path;
};

template <class N>
MovedPoint<N> moved(const MotionPath<N>& motion, const std::array<N, 3>& point) {
    return {point, sum(motion.turned(constant(point)), motion.shift)};
}

/// A fixed point, times the weight.
template <class N>
MovedPoint<N> standing(const MotionPath<N>& motion, const std::array<N, 3>& point) {
    const Polynomial<N, 3> weight = motion.weight + Polynomial<N, 3>{};
    return {point, scaled(constant(point), weight)};
}

template <class N>
std::array<N, 3> minus(const std::array<N, 3>& a, const std::array<N, 3>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// The difference of two points of one body, times the weight.
template <class N>
Vector<N, 2> direction(const MotionPath<N>& motion, const std::array<N, 3>& v, bool is_moving) {
    return is_moving ? motion.turned(constant(v)) : scaled(constant(v), motion.weight);
}

/// Whether two sets of points stay on different sides of some coordinate plane during the whole motion.
template <class N, std::size_t A, std::size_t B>
bool are_boxes_apart(const std::array<const MovedPoint<N>*, A>& a, const std::array<const MovedPoint<N>*, B>& b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        int kept = 2;
        for (std::size_t i = 0; i < A && kept != 0; ++i)
            for (std::size_t j = 0; j < B && kept != 0; ++j) {
                const int sign = kept_sign(a[i]->path[axis] - b[j]->path[axis]);
                kept = kept == 2 || kept == sign ? sign : 0;
            }
        if (kept != 0)
            return true;
    }
    return false;
}

/// A vertex and a triangle; one of them moves.
template <class N>
class VertexTriangle {
public:
    VertexTriangle(const MotionPath<N>& motion, const MovedPoint<N>& vertex,
                   const std::array<const MovedPoint<N>*, 3>& corners, bool triangle_moves)
        : motion_(motion), vertex_(vertex), corners_(corners), triangle_moves_(triangle_moves) {}

    [[nodiscard]] bool is_plainly_apart() const {
        return are_boxes_apart<N, 1, 3>({&vertex_}, corners_) || kept_sign(volume()) != 0;
    }

    /// The volume of the vertex and the corners, times the weight twice.
    [[nodiscard]] Polynomial<N, 5> volume() const { return dot(normal(), arm(0)); }

    [[nodiscard]] Vector<N, 2> normal() const {
        const std::array n = cross(constant(body_edge(0)), constant(body_edge(1)));
        return direction<N>(motion_, {n[0][0], n[1][0], n[2][0]}, triangle_moves_);
    }

    /// The side of an edge on which the vertex is, in the projection along each axis.
    [[nodiscard]] Vector<N, 5> side(std::size_t edge) const {
        return cross(direction(motion_, body_edge(edge), triangle_moves_), arm(edge));
    }

private:
    [[nodiscard]] std::array<N, 3> body_edge(std::size_t i) const {
        return minus(corners_[(i + 1) % 3]->body, corners_[i]->body);
    }
    [[nodiscard]] Vector<N, 3> arm(std::size_t i) const { return difference(vertex_.path, corners_[i]->path); }

    const MotionPath<N>& motion_;
    const MovedPoint<N>& vertex_;
    std::array<const MovedPoint<N>*, 3> corners_;
    bool triangle_moves_;
};

/// A moving edge from a to b and a fixed one from c to d.
template <class N>
struct EdgePair {
    const MotionPath<N>& motion;
    const MovedPoint<N>& a;
    const MovedPoint<N>& b;
    const MovedPoint<N>& c;
    const MovedPoint<N>& d;

    [[nodiscard]] bool is_plainly_apart() const {
        return are_boxes_apart<N, 2, 2>({&a, &b}, {&c, &d}) || kept_sign(volume()) != 0;
    }
    /// The volume of the four points, times the weight twice.
    [[nodiscard]] Polynomial<N, 5> volume() const { return dot(difference(a.path, c.path), crossing()); }
    [[nodiscard]] Vector<N, 2> crossing() const { return cross(u(), constant(v())); }
    /// The side of the fixed line on which a moving point is, in the projection along each axis.
    [[nodiscard]] Vector<N, 3> side_of_fixed(const MovedPoint<N>& p) const {
        return cross(constant(v()), difference(p.path, c.path));
    }
    [[nodiscard]] Vector<N, 5> side_of_moving(const MovedPoint<N>& p) const {
        return cross(u(), difference(p.path, a.path));
    }
    /// The position along the fixed edge: 0 at c, `length` at d.
    [[nodiscard]] Polynomial<N, 3> along(const MovedPoint<N>& p) const {
        return dot(constant(v()), difference(p.path, c.path));
    }
    [[nodiscard]] Polynomial<N, 2> length() const { return motion.weight * dot(constant(v()), constant(v())); }

private:
    [[nodiscard]] Vector<N, 2> u() const { return direction(motion, minus(b.body, a.body), true); }
    [[nodiscard]] std::array<N, 3> v() const { return minus(d.body, c.body); }
};

namespace detail {

using ThreeCoefficients = std::array<Coefficients, 3>;

template <class V>
ThreeCoefficients coefficients_of(const V& v) {
    return {coefficients(v[0]), coefficients(v[1]), coefficients(v[2])};
}

/// Candidates for the first tau: the roots of `function`; if it vanishes, the start and the roots of the other
/// functions.
template <class Holds>
void offer_all(Earliest& earliest, const Coefficients& function, const std::vector<const Coefficients*>& others,
               Holds holds) {
    if (!function.empty()) {
        for (const Root& root : roots_of(function))
            earliest.offer(root, holds);
        return;
    }
    earliest.offer(Root::point(0, 0), holds);
    for (const Coefficients* other : others)
        if (!other->empty())
            for (const Root& root : roots_of(*other))
                earliest.offer(root, holds);
}

} // namespace detail

/// `weight` without common divisors.
inline void offer_vertex_triangle(Earliest& earliest, const VertexTriangle<Integer>& pair, const Coefficients& weight) {
    const Coefficients volume = divided_exactly(coefficients(pair.volume()), weight);
    const auto normal = detail::coefficients_of(pair.normal());
    std::array<detail::ThreeCoefficients, 3> sides;
    std::vector<const Coefficients*> others;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        sides[edge] = detail::coefficients_of(pair.side(edge));
        for (Coefficients& side : sides[edge])
            side = divided_exactly(side, weight);
    }
    if (volume.empty())
        for (std::size_t i = 0; i < 3; ++i)
            others.insert(others.end(), {&normal[i], &sides[0][i], &sides[1][i], &sides[2][i]});
    detail::offer_all(earliest, volume, others, [&](Root& root) {
        for (std::size_t i = 0; i < 3; ++i) {
            const int up = root.sign(normal[i]);
            if (up != 0)
                return root.sign(sides[0][i]) * up >= 0 && root.sign(sides[1][i]) * up >= 0 &&
                       root.sign(sides[2][i]) * up >= 0;
        }
        throw std::logic_error("exact reference: a triangle without area");
    });
}

inline void offer_edges(Earliest& earliest, const EdgePair<Integer>& pair, const Coefficients& weight) {
    const Coefficients volume = divided_exactly(coefficients(pair.volume()), weight);
    const auto crossing = detail::coefficients_of(pair.crossing());
    const auto a = detail::coefficients_of(pair.side_of_fixed(pair.a));
    const auto b = detail::coefficients_of(pair.side_of_fixed(pair.b));
    auto c = detail::coefficients_of(pair.side_of_moving(pair.c));
    auto d = detail::coefficients_of(pair.side_of_moving(pair.d));
    for (std::size_t i = 0; i < 3; ++i) {
        c[i] = divided_exactly(c[i], weight);
        d[i] = divided_exactly(d[i], weight);
    }
    const auto from_a = coefficients(pair.along(pair.a));
    const auto from_b = coefficients(pair.along(pair.b));
    const auto behind_a = coefficients(pair.along(pair.a) - pair.length());
    const auto behind_b = coefficients(pair.along(pair.b) - pair.length());
    std::vector<const Coefficients*> others;
    if (volume.empty()) {
        for (std::size_t i = 0; i < 3; ++i)
            others.insert(others.end(), {&crossing[i], &a[i], &b[i], &c[i], &d[i]});
        others.insert(others.end(), {&from_a, &from_b, &behind_a, &behind_b});
    }
    detail::offer_all(earliest, volume, others, [&](Root& root) {
        for (std::size_t i = 0; i < 3; ++i)
            if (root.sign(crossing[i]) != 0) // the lines intersect in one point
                return root.sign(a[i]) * root.sign(b[i]) <= 0 && root.sign(c[i]) * root.sign(d[i]) <= 0;
        for (std::size_t i = 0; i < 3; ++i)
            if (root.sign(a[i]) != 0) // parallel and apart
                return false;
        const bool before = root.sign(from_a) < 0 && root.sign(from_b) < 0;
        const bool behind = root.sign(behind_a) > 0 && root.sign(behind_b) > 0;
        return !before && !behind;
    });
}

} // namespace chasles::reference
