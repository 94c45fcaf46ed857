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
    S size;                        ///< |u|_1
    Vector3<Polynomial> direction; ///< U, of the turned u
    Vector3<Polynomial> moment;    ///< M, of the moved line
};

/// The moving edge between two points of the body.
template <class S>
EdgePath<S> edge_path(const motion::ControlMaps<S>& maps, const Vector3<S>& from, const Vector3<S>& to) {
    const Vector3<S> u = to - from;
    return {from, to, u, norm1(u), maps.rotation * u, maps.rotation * cross(from, u) + maps.moment * u};
}

/// A fixed edge and its line.
template <class S>
struct FixedEdge {
    Vector3<S> from;      ///< c
    Vector3<S> direction; ///< v
    Vector3<S> moment;    ///< c x v
    S size;               ///< |v|_1
};

/// The fixed edge between two points.
template <class S>
FixedEdge<S> fixed_edge(const Vector3<S>& from, const Vector3<S>& to) {
    const Vector3<S> v = to - from;
    return {from, v, cross(from, v), norm1(v)};
}

namespace detail {

/// All quantities of one edge pair, made as they are needed.
template <class S>
class EdgePair {
public:
    using Polynomial = Bernstein<3, S>;
    using Vector = Vector3<Polynomial>;

    EdgePair(const motion::ControlMaps<S>& maps, const EdgePath<S>& moving, const FixedEdge<S>& fixed,
             const ErrorScale& scale)
        : maps_(maps), moving_(moving), fixed_(fixed), unit_(relative_error<S>(scale) * scale.length),
          stretch_unit_(relative_error<S>(scale) * scale.norm_bound) {}

    /// W times the reciprocal product of the two lines: v . M + (c x v) . U.
    [[nodiscard]] Bounded<3, S> volume() const {
        return {dot(moving_.moment, fixed_.direction) + dot(moving_.direction, fixed_.moment),
                with_underflow<S>(unit_ * size())};
    }

    /// U x v, whose direction tells how the edges cross, with one error for all components.
    [[nodiscard]] Vector crossing() const { return cross(moving_.direction, fixed_.direction); }
    [[nodiscard]] S size() const { return moving_.size * fixed_.size; }
    [[nodiscard]] S crossing_error() const { return with_underflow<S>(stretch_unit_ * size()); }

    /// The meeting point is between a and b iff 0 lies between the i-th components of (W c - A) x v and
    /// (W c - B) x v, and between c and d iff it does for c x U - M and d x U - M. Both pairs differ by U x v: where
    /// that is > 0 all along, the first of each is >= 0 and the second <= 0.
    void add_inside(int i, const Polynomial& crossing, int sign, Constraints<S>& constraints) const {
        add_opposed({end_arm(i), end_arm_error()}, crossing, sign, constraints);
        add_opposed({line_arm(i), line_arm_error()}, crossing, sign, constraints);
    }

    /// The two edges overlap when both are projected on v, and when both are projected on u.
    void add_overlaps(Constraints<S>& constraints) const {
        const Vector a = maps_.rotation * moving_.from + maps_.translation;
        const Vector b = maps_.rotation * moving_.to + maps_.translation;
        add_overlap(a, b, fixed_.from, fixed_.direction, fixed_.size, constraints);
        const Vector c = in_body(fixed_.from);
        const Vector d = in_body(fixed_.from + fixed_.direction);
        add_overlap(c, d, moving_.from, moving_.along, moving_.size, constraints);
    }

    /// Component i of (W c - A) x v: the share of the moving edge before the other line, times U x v.
    [[nodiscard]] Polynomial end_arm(int i) const {
        const auto a = [&](int component) {
            return dot(maps_.rotation.row[component], moving_.from) + maps_.translation[component];
        };
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        return maps_.weight * fixed_.moment[i] - (a(j) * fixed_.direction[k] - a(k) * fixed_.direction[j]);
    }

    /// Component i of c x U - M: the same for the fixed edge.
    [[nodiscard]] Polynomial line_arm(int i) const {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        return moving_.direction[k] * fixed_.from[j] - moving_.direction[j] * fixed_.from[k] - moving_.moment[i];
    }

    [[nodiscard]] S end_arm_error() const { return with_underflow<S>(unit_ * fixed_.size); }
    [[nodiscard]] S line_arm_error() const { return with_underflow<S>(unit_ * moving_.size); }

private:
    /// Of the edge from p to q with one that starts in `from`.
    void add_overlap(const Vector& p, const Vector& q, const Vector3<S>& from, const Vector3<S>& along, const S& size,
                     Constraints<S>& constraints) const {
        const S offset = dot(along, from);
        const S error = with_underflow<S>(unit_ * size);
        constraints.add({height<S>({p, maps_.weight}, along, offset), error},
                        {height<S>({q, maps_.weight}, along, offset), error}, dot(along, along));
    }

    [[nodiscard]] Vector in_body(const Vector3<S>& point) const {
        return maps_.rotation.transposed() * point - maps_.inverse_translation;
    }

    /// The second is the first without `crossing`. sign > 0: first >= 0 >= second. sign < 0: the reverse. 0: either,
    /// so that 0 is between them.
    static void add_opposed(const Bounded<3, S>& first, const Polynomial& crossing, int sign,
                            Constraints<S>& constraints) {
        const Polynomial& p = first.polynomial;
        if (sign == 0) {
            constraints.add(first, {p - crossing, first.error}, S(0));
        } else if (sign > 0) {
            constraints.add() = first;
            constraints.add() = {crossing - p, first.error};
        } else {
            constraints.add() = {Polynomial() - p, first.error};
            constraints.add() = {p - crossing, first.error};
        }
    }

    const motion::ControlMaps<S>& maps_;
    const EdgePath<S>& moving_;
    const FixedEdge<S>& fixed_;
    S unit_;
    S stretch_unit_;
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
CrossingAxis crossing_axis(const Vector3<Bernstein<3, S>>& crossing, const Bernstein<3, S>& band, const S& least) {
    const auto distance_from_zero = [](const S& value) { return value < S(0) ? S(S(0) - value) : value; };
    CrossingAxis best;
    S widest = least;
    for (int i = 0; i < 3; ++i) {
        const Bernstein<3, S>& side = crossing[i];
        const S distance = std::min<S>(distance_from_zero(side[0]), distance_from_zero(side[3]));
        if (!(widest < distance))
            continue;
        const int sign = side[0] > S(0) ? 1 : -1;
        if (sign > 0 ? is_positive(side, band) : is_negative(side, band)) {
            widest = distance;
            best = {i, sign};
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

/// For edges on lines that may meet.
template <class S>
std::optional<FeasibleInterval> first_meeting(const EdgePair<S>& pair, const Bounded<3, S>& volume,
                                              const Bernstein<3, S>& weight, const algebra::Tolerance& tolerance,
                                              Workspace<S>& workspace) {
    const Vector3<Bernstein<3, S>> crossing = pair.crossing();
    const CrossingAxis axis =
        crossing_axis(crossing, weight * pair.crossing_error(), S(S(parallel_angle) * pair.size()));
    auto& constraints = workspace.constraints;
    constraints.clear();
    pair.add_inside(axis.component, crossing[axis.component], axis.sign, constraints);
    if (axis.sign == 0) {
        pair.add_inside(1, crossing[1], 0, constraints);
        pair.add_inside(2, crossing[2], 0, constraints);
        pair.add_overlaps(constraints);
    }
    for (const auto& constraint : constraints.all())
        if (fails(constraint, weight))
            return std::nullopt;
    ++workspace.root_brackets;
    return algebra::first_feasible<3, S>({weight, volume, constraints.all()}, tolerance);
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
    const detail::EdgePair<S> pair(maps, moving, fixed, accuracy.scale);
    const Bounded<3, S> volume = pair.volume();
    if (keeps_one_sign(volume.polynomial, maps.weight * volume.error))
        return std::nullopt;
    return detail::first_meeting(pair, volume, maps.weight, accuracy.tolerance, workspace);
}

} // namespace chasles::elementary
