// When do two edges first meet?
// Source: paper sections 2.2.1 to 2.2.4; docs/derivations/04-edge-edge.md and 05-being-inside.md.
// Legend: the moving edge runs from a to b with direction u = b - a, the fixed one from c to d with v = d - c.
#pragma once

#include "chasles/elementary/vertex_face.h"

namespace chasles::elementary {

/// A moving edge and its line along the motion; a polynomial is W times what it names, in the fixed body's frame.
template <class S>
struct EdgePath {
    using Polynomial = Bernstein<3, S>;
    Vector3<S> from;               ///< a in the body's frame
    Vector3<S> to;                 ///< b
    Vector3<S> along;              ///< u
    Vector3<Polynomial> direction; ///< U, of the turned u
    Vector3<Polynomial> moment;    ///< M, of the moved line
};

/// The moving edge between two points of the body.
template <class S>
EdgePath<S> edge_path(const motion::ControlMaps<S>& maps, const Vector3<S>& from, const Vector3<S>& to) {
    const Vector3<S> u = to - from;
    return {from, to, u, maps.turn * u, maps.turn * cross(from, u) + maps.moment * u};
}

/// A fixed edge.
template <class S>
struct FixedEdge {
    Vector3<S> from;      ///< c
    Vector3<S> direction; ///< v
};

namespace detail {

/// All quantities of one edge pair, made as they are needed.
template <class S>
class EdgePair {
public:
    using Polynomial = Bernstein<3, S>;
    using Vector = Vector3<Polynomial>;

    EdgePair(const motion::ControlMaps<S>& maps, const EdgePath<S>& moving, const FixedEdge<S>& fixed,
             const Accuracy& accuracy)
        : maps_(maps), moving_(moving), fixed_(fixed), from_(maps, moving.from), to_(maps, moving.to),
          unit_(relative_error<S>(accuracy.scale) * accuracy.scale.length),
          stretch_unit_(relative_error<S>(accuracy.scale) * accuracy.scale.stretch), u_(norm1(moving.along)),
          v_(norm1(fixed.direction)) {}

    /// W times the reciprocal product of the two lines: v . M + (c x v) . U.
    [[nodiscard]] Bounded<3, S> volume() const {
        return {dot(moving_.moment, fixed_.direction) + dot(moving_.direction, cross(fixed_.from, fixed_.direction)),
                with_underflow<S>(unit_ * u_ * v_)};
    }

    /// U x v, whose direction tells how the edges cross, with one error for all components.
    [[nodiscard]] Vector crossing() const { return cross(moving_.direction, fixed_.direction); }
    [[nodiscard]] S size() const { return u_ * v_; }
    [[nodiscard]] S crossing_error() const { return with_underflow<S>(stretch_unit_ * u_ * v_); }

    /// The meeting point is between a and b iff 0 lies between the i-th components of (W c - A) x v and
    /// (W c - B) x v, and between c and d iff it does for c x U - M and d x U - M; when U x v has component i > 0
    /// all along, the first of each is >= 0 and the second <= 0.
    void add_inside(int i, int sign, std::vector<Constraint<3, S>>& constraints) {
        const Vector3<S> d = fixed_.from + fixed_.direction;
        const S end_error = with_underflow<S>(unit_ * v_);
        const S line_error = with_underflow<S>(unit_ * u_);
        add_opposed({end_arm(from_, i), end_error}, {end_arm(to_, i), end_error}, sign, constraints);
        add_opposed({line_arm(fixed_.from, i), line_error}, {line_arm(d, i), line_error}, sign, constraints);
    }

    /// The two edges overlap when both are projected on v, and when both are projected on u.
    void add_overlaps(std::vector<Constraint<3, S>>& constraints) {
        const Vector3<S>& v = fixed_.direction;
        const Vector3<S>& u = moving_.along;
        const S v_error = with_underflow<S>(unit_ * v_);
        constraints.push_back({{height<S>({from_.all(), maps_.weight}, v, fixed_.from), v_error},
                               {height<S>({to_.all(), maps_.weight}, v, fixed_.from), v_error},
                               true,
                               S(dot(v, v))});
        const Vector c = in_body(fixed_.from);
        const Vector d = in_body(fixed_.from + v);
        const S u_error = with_underflow<S>(unit_ * u_);
        constraints.push_back({{height<S>({c, maps_.weight}, u, moving_.from), u_error},
                               {height<S>({d, maps_.weight}, u, moving_.from), u_error},
                               true,
                               S(dot(u, u))});
    }

private:
    /// W times the position of a body point. Most pairs ask for two components, nearly parallel ones for each twice.
    class MovedPoint {
    public:
        MovedPoint(const motion::ControlMaps<S>& maps, const Vector3<S>& point) : maps_(maps), point_(point) {}

        const Polynomial& operator[](int i) {
            if (!is_made_[i])
                position_[i] = dot(maps_.turn.row[i], point_) + maps_.shift[i];
            is_made_[i] = true;
            return position_[i];
        }
        const Vector& all() {
            for (int i = 0; i < 3; ++i)
                (void)(*this)[i];
            return position_;
        }

    private:
        const motion::ControlMaps<S>& maps_;
        const Vector3<S>& point_;
        Vector position_;
        std::array<bool, 3> is_made_{};
    };

    /// Component i of (W c - position) x v for an end of the moving edge.
    [[nodiscard]] Polynomial end_arm(MovedPoint& end, int i) const {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        return (maps_.weight * fixed_.from[j] - end[j]) * fixed_.direction[k] -
               (maps_.weight * fixed_.from[k] - end[k]) * fixed_.direction[j];
    }

    /// Component i of point x U - M.
    [[nodiscard]] Polynomial line_arm(const Vector3<S>& point, int i) const {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        return moving_.direction[k] * point[j] - moving_.direction[j] * point[k] - moving_.moment[i];
    }

    [[nodiscard]] Vector in_body(const Vector3<S>& point) const {
        return maps_.turn.transposed() * point - maps_.inverse_shift;
    }

    static Bounded<3, S> negated(const Bounded<3, S>& p) { return {Polynomial() - p.polynomial, p.error}; }

    /// sign > 0: first >= 0 >= second. sign < 0: the reverse. 0: either, so that 0 is between them.
    static void add_opposed(const Bounded<3, S>& first, const Bounded<3, S>& second, int sign,
                            std::vector<Constraint<3, S>>& constraints) {
        if (sign == 0) {
            constraints.push_back({first, second, true, S(0)});
            return;
        }
        constraints.push_back({sign > 0 ? first : negated(first), {}, false});
        constraints.push_back({sign > 0 ? negated(second) : second, {}, false});
    }

    const motion::ControlMaps<S>& maps_;
    const EdgePath<S>& moving_;
    const FixedEdge<S>& fixed_;
    MovedPoint from_;
    MovedPoint to_;
    S unit_;
    S stretch_unit_;
    S u_;
    S v_;
};

/// Edges at a smaller angle count as parallel. Both ways are right for any angle, but the distance of two lines is
/// known to the error over their angle only, and the moments of the ends say more (note 04, "Nearly parallel edges").
inline constexpr double parallel_angle = 0x1p-32;

/// The component of U x v that is proven to keep its sign with the widest distance from zero; sign 0 if none is, or if
/// none is as far from it as `least`.
struct CrossingAxis {
    int component = 0;
    int sign = 0;
};

template <class S>
CrossingAxis crossing_axis(const Vector3<Bernstein<3, S>>& crossing, const Bernstein<3, S>& weight, const S& error,
                           const S& least) {
    CrossingAxis best;
    S widest = least;
    for (int i = 0; i < 3; ++i) {
        for (const int sign : {1, -1}) {
            const Bernstein<3, S> side = crossing[i] * S(sign);
            if (!is_positive(side, weight * error))
                continue;
            const S distance = side[0] < side[3] ? side[0] : side[3];
            if (widest < distance) {
                widest = distance;
                best = {i, sign};
            }
        }
    }
    return best;
}

/// A constraint that fails all along settles the question without looking for roots.
template <class S>
bool fails(const Constraint<3, S>& constraint, const Bernstein<3, S>& weight) {
    using Polynomial = Bernstein<3, S>;
    const auto may_hold = [&](const Polynomial& first, const Polynomial* second) {
        return !is_negative(first, weight * constraint.first.error) ||
               (second && !is_negative(*second, weight * constraint.second.error));
    };
    return !algebra::all_demands(constraint, weight, constraint.first.polynomial, constraint.second.polynomial,
                                 may_hold);
}

} // namespace detail

/// The first tau in [0, 1] at which the closed edges may meet; empty if they are proven never to. Edges that are, or
/// become, parallel are no special case for the answer: where no component of U x v keeps its sign, all three decide
/// together with the overlap along each edge.
template <class S>
std::optional<FeasibleInterval> edge_edge(const motion::ControlMaps<S>& maps, const EdgePath<S>& moving,
                                          const FixedEdge<S>& fixed, const Accuracy& accuracy,
                                          Workspace<S>& workspace) {
    ++workspace.elementary_tests;
    detail::EdgePair<S> pair(maps, moving, fixed, accuracy);
    const Bounded<3, S> volume = pair.volume();
    const Bernstein<3, S> band = maps.weight * volume.error;
    if (is_positive(volume.polynomial, band) || is_negative(volume.polynomial, band))
        return std::nullopt;
    const detail::CrossingAxis axis = detail::crossing_axis(pair.crossing(), maps.weight, pair.crossing_error(),
                                                            S(S(detail::parallel_angle) * pair.size()));
    auto& constraints = workspace.constraints;
    constraints.clear();
    pair.add_inside(axis.component, axis.sign, constraints);
    if (axis.sign == 0) {
        pair.add_inside(1, 0, constraints);
        pair.add_inside(2, 0, constraints);
        pair.add_overlaps(constraints);
    }
    for (const auto& constraint : constraints)
        if (detail::fails(constraint, maps.weight))
            return std::nullopt;
    ++workspace.root_brackets;
    return algebra::first_feasible<3, S>({maps.weight, volume, constraints}, accuracy.tolerance);
}

} // namespace chasles::elementary
