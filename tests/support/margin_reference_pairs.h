// The tau at which two features are exactly `margin` apart, and the conditions that their closest points are inside
// them, as polynomials with whole coefficients: squared distances of points, lines and planes, written from their
// definitions. Legend: the moving point a is at A / W, the fixed point c at c = (W c) / W; u is a moving edge, U = W
// times it turned; v is a fixed edge; D is the margin in the unit of the coordinates.
#pragma once

#include "tests/support/exact_reference_features.h"

namespace chasles::reference {

/// A positive multiple of (squared distance of plane, lines or points) - margin^2.
using SquaredExcess = Coefficients;

/// The conditions for closest points inside the features: all polynomials are at least 0, and `crossing`, if present,
/// is above 0.
struct Inside {
    std::vector<Coefficients> not_negative;
    std::optional<Coefficients> crossing;

    [[nodiscard]] bool holds(Root& root) const {
        if (crossing && root.sign(*crossing) <= 0)
            return false;
        return std::all_of(not_negative.begin(), not_negative.end(),
                           [&](const Coefficients& c) { return root.sign(c) >= 0; });
    }
};

/// The motion, the margin, and the data that all pairs share.
struct MarginMotion {
    MotionPath<Integer> path;
    Integer margin;
    Coefficients primitive_weight;
    Integer content; ///< content of the weight: weight = content * primitive_weight

    MarginMotion() = default;
    MarginMotion(const MotionPath<Integer>& motion, const Integer& distance) : path(motion), margin(distance) {
        const Coefficients weight = coefficients(motion.weight);
        primitive_weight = primitive(weight);
        content = weight.back() / primitive_weight.back();
    }

    /// margin^2 squared_length (content W)^2.
    [[nodiscard]] Polynomial<Integer, 4> threshold(const Integer& squared_length, bool is_divided) const {
        const Integer factor = is_divided ? content : Integer(1);
        return path.weight * path.weight * Integer(margin * margin * squared_length * factor * factor);
    }
    /// content times p / W, which must be a polynomial of degree 3.
    [[nodiscard]] Polynomial<Integer, 3> divided(const Polynomial<Integer, 5>& p) const {
        const Coefficients quotient = divided_exactly(coefficients(p), primitive_weight);
        Polynomial<Integer, 3> result{};
        if (quotient.size() > result.size())
            throw std::logic_error("margin reference: a quotient of too high a degree");
        std::copy(quotient.begin(), quotient.end(), result.begin());
        return result;
    }
};

using PointPath = MovedPoint<Integer>;
using WholePoint = std::array<Integer, 3>;

inline Integer squared(const WholePoint& v) {
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}
inline WholePoint crossed(const WholePoint& a, const WholePoint& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A vertex and a triangle, one of which moves.
struct VertexTriangleMargin {
    const MarginMotion& motion;
    const PointPath& vertex;
    std::array<const PointPath*, 3> corners;
    bool triangle_moves;

    [[nodiscard]] SquaredExcess excess() const {
        const WholePoint n = normal();
        const Vector<Integer, 3> arm = difference(vertex.path, corners[0]->path);
        if (!triangle_moves) {
            const Polynomial<Integer, 3> height = dot(constant(n), arm);
            return coefficients(height * height - motion.threshold(squared(n), false));
        }
        const Polynomial<Integer, 3> height = motion.divided(dot(motion.path.turned(constant(n)), arm));
        return coefficients(height * height - motion.threshold(squared(n), true));
    }
    /// The vertex is on the inner side of every edge, in the projection along the normal.
    [[nodiscard]] Inside inside() const {
        Inside result;
        for (std::size_t i = 0; i < 3; ++i) {
            const WholePoint inward = crossed(normal(), minus(corners[(i + 1) % 3]->body, corners[i]->body));
            const Vector<Integer, 3> arm = difference(vertex.path, corners[i]->path);
            result.not_negative.push_back(triangle_moves ? coefficients(dot(motion.path.turned(constant(inward)), arm))
                                                         : coefficients(dot(constant(inward), arm)));
        }
        return result;
    }

private:
    [[nodiscard]] WholePoint normal() const {
        return crossed(minus(corners[1]->body, corners[0]->body), minus(corners[2]->body, corners[0]->body));
    }
};

/// A moving edge a to b and a fixed edge c to d.
struct EdgesMargin {
    const MarginMotion& motion;
    const PointPath& a;
    const PointPath& b;
    const PointPath& c;
    const PointPath& d;

    /// distance = |(a - c) . n| / |n| with n = U x v.
    [[nodiscard]] SquaredExcess excess() const {
        const Vector<Integer, 2> n = normal();
        const Polynomial<Integer, 3> volume = motion.divided(dot(difference(a.path, c.path), n));
        const Integer factor = motion.margin * motion.content;
        return coefficients(volume * volume - dot(n, n) * Integer(factor * factor));
    }
    /// s = ((c - a) x v) . n / n.n along the moving edge and t = ((c - a) x u) . n / n.n along the fixed edge are in
    /// [0, 1]. Parallel edges have no n; an end of one edge then has the same distance.
    [[nodiscard]] Inside inside() const {
        const Vector<Integer, 2> n = normal();
        const Vector<Integer, 3> arm = difference(c.path, a.path);
        const auto square = dot(n, n);
        const auto s = dot(cross(arm, constant(v())), n);
        const auto t = dot(cross(arm, turned_edge()), n);
        return {
            {coefficients(s), coefficients(square - s), coefficients(t), coefficients(motion.path.weight * square - t)},
            coefficients(square)};
    }

private:
    [[nodiscard]] WholePoint v() const { return minus(d.body, c.body); }
    [[nodiscard]] Vector<Integer, 2> turned_edge() const { return motion.path.turned(constant(minus(b.body, a.body))); }
    [[nodiscard]] Vector<Integer, 2> normal() const { return cross(turned_edge(), constant(v())); }
};

/// A vertex and an edge from c to d, one of which moves.
struct VertexEdgeMargin {
    const MarginMotion& motion;
    const PointPath& vertex;
    const PointPath& c;
    const PointPath& d;
    bool edge_moves;

    /// distance = |edge x arm| / |edge|.
    [[nodiscard]] SquaredExcess excess() const {
        if (!edge_moves) {
            const Vector<Integer, 3> moment = cross(constant(edge()), arm());
            return coefficients(dot(moment, moment) - motion.threshold(squared(edge()), false));
        }
        const Vector<Integer, 5> product = cross(motion.path.turned(constant(edge())), arm());
        const Vector<Integer, 3> moment{motion.divided(product[0]), motion.divided(product[1]),
                                        motion.divided(product[2])};
        return coefficients(dot(moment, moment) - motion.threshold(squared(edge()), true));
    }
    [[nodiscard]] Inside inside() const {
        const auto& weight = motion.path.weight;
        const Integer length = squared(edge());
        if (!edge_moves) {
            const auto along = dot(constant(edge()), arm());
            return {{coefficients(along), coefficients(weight * length - along)}, {}};
        }
        const auto along = dot(motion.path.turned(constant(edge())), arm());
        return {{coefficients(along), coefficients(weight * weight * length - along)}, {}};
    }

private:
    [[nodiscard]] WholePoint edge() const { return minus(d.body, c.body); }
    [[nodiscard]] Vector<Integer, 3> arm() const { return difference(vertex.path, c.path); }
};

/// Two vertices.
struct VerticesMargin {
    const MarginMotion& motion;
    const PointPath& a;
    const PointPath& c;

    [[nodiscard]] SquaredExcess excess() const {
        const Vector<Integer, 3> arm = difference(a.path, c.path);
        return coefficients(dot(arm, arm) - motion.threshold(Integer(1), false));
    }
    [[nodiscard]] Inside inside() const { return {}; }
};

/// The roots in a closed dyadic cell, in order. `p` must not be zero.
inline std::vector<Root> roots_in(const Coefficients& p, const Cell& cell) {
    std::vector<Root> roots;
    const auto isolate_all = [&](const Coefficients& q, unsigned deepest) {
        roots.clear();
        if (sign_at_dyadic(q, cell.from, cell.depth) == 0)
            roots.push_back(Root::point(cell.from, cell.depth));
        if (!detail::isolate(q, cell, deepest, roots))
            return false;
        if (sign_at_dyadic(q, cell.from + 1, cell.depth) == 0)
            roots.push_back(Root::point(cell.from + 1, cell.depth));
        return true;
    };
    if (!isolate_all(p, cell.depth + 16))
        isolate_all(square_free(p), 100000);
    return roots;
}

/// The first time in the cell at which the features are `margin` apart. A pair whose distance equals the margin during
/// the whole motion reached this distance as another pair: for example, a vertex over a face was over an edge before.
/// The distance at the start is tested separately.
template <class Pair>
void offer_margin(Earliest& earliest, const Pair& pair, const Cell& cell) {
    const SquaredExcess excess = pair.excess();
    if (excess.empty())
        return;
    const std::vector<Root> roots = roots_in(excess, cell);
    if (roots.empty())
        return;
    const Inside inside = pair.inside();
    for (const Root& root : roots)
        earliest.offer(root, [&](Root& at) { return inside.holds(at); });
}

/// Whether the features are at most `margin` apart at the start.
template <class Pair>
bool is_within_at_start(const Pair& pair) {
    const SquaredExcess excess = pair.excess();
    Root start = Root::point(0, 0);
    return start.sign(excess) <= 0 && pair.inside().holds(start);
}

} // namespace chasles::reference
