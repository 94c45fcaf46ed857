// The first time at which a moving edge and a fixed edge touch. No touch is missed; a certain answer is proven.
// Source: paper sections 2.2.1 to 2.2.4; docs/derivations/04-edge-edge.md and 05-being-inside.md.
// Legend: the moving edge runs from a to b with direction u = b - a, the fixed edge from c to d with v = d - c. A and B
// are W times the positions of a and b.
#pragma once

#include "chasles/elementary/vertex_face.h"

namespace chasles::elementary {

/// A moving edge and its line during the motion. Each polynomial is W times a vector in the frame of the fixed body.
template <class S>
struct EdgePath {
    using Polynomial = Bernstein<3, S>;
    Vector3<S> from;               ///< a, in the frame of the moving body
    Vector3<S> to;                 ///< b
    Vector3<S> along;              ///< u
    S size;                        ///< |u|_1
    Vector3<Polynomial> direction; ///< U, the rotated u
    Vector3<Polynomial> moment;    ///< M, the moment of the line
};

/// The moving edge between two points of the moving body.
template <class S>
EdgePath<S> edge_path(const motion::ControlMaps<S>& maps, const Vector3<S>& from, const Vector3<S>& to) {
    const Vector3<S> u = to - from;
    return {from, to, u, norm1(u), maps.rotation * u, maps.rotation * cross(from, u) + maps.moment * u};
}

/// A fixed edge and its line, in the frame of the fixed body.
template <class S>
struct FixedEdge {
    Vector3<S> from;      ///< c
    Vector3<S> direction; ///< v
    Vector3<S> moment;    ///< c x v
    S size;               ///< |v|_1
};

/// The fixed edge between two points of the fixed body.
template <class S>
FixedEdge<S> fixed_edge(const Vector3<S>& from, const Vector3<S>& to) {
    const Vector3<S> v = to - from;
    return {from, v, cross(from, v), norm1(v)};
}

/// A pair of edges under a motion; all members are kept by reference.
template <class S>
struct EdgeMotion {
    const motion::ControlMaps<S>& maps;
    const EdgePath<S>& moving;
    const FixedEdge<S>& fixed;
};

namespace detail {

/// The polynomials of one pair of edges, each computed when a test needs it.
template <class S>
class EdgePair {
public:
    using Polynomial = Bernstein<3, S>;
    using Vector = Vector3<Polynomial>;

    EdgePair(const EdgeMotion<S>& edges, const ErrorScale& scale)
        : maps_(edges.maps), moving_(edges.moving), fixed_(edges.fixed), unit_(position_error<S>(scale)),
          norm_unit_(direction_error<S>(scale)), turn_deviation_(scale.turn_deviation) {}

    /// W times the reciprocal product of the two lines: v . M + (c x v) . U.
    [[nodiscard]] Bounded<3, S> volume() const {
        return {dot(moving_.moment, fixed_.direction) + dot(moving_.direction, fixed_.moment),
                with_underflow<S>(unit_ * size())};
    }

    /// U x v. All components have the same error bound, `crossing_error()`.
    [[nodiscard]] Vector crossing() const { return cross(moving_.direction, fixed_.direction); }
    [[nodiscard]] S size() const { return moving_.size * fixed_.size; }
    [[nodiscard]] S crossing_error() const { return with_underflow<S>(norm_unit_ * size()); }

    /// Adds the constraints of component i that the intersection of both lines is inside both edges. It is between a
    /// and b iff 0 lies between the components of (W c - A) x v and (W c - B) x v. It is between c and d iff 0 lies
    /// between the components of c x U - M and d x U - M. Both differences are U x v. If component i of U x v is
    /// positive during the whole motion (sign > 0), the first value of each pair must be >= 0 and the second <= 0.
    void add_inside(int i, const Polynomial& crossing, int sign, Constraints<S>& constraints) const {
        add_opposed({end_arm(i), end_arm_error()}, crossing, sign, constraints);
        add_opposed({line_arm(i), line_arm_error()}, crossing, sign, constraints);
    }

    /// Adds the constraints that the projections of both edges overlap, on v and on u. Two points, which are edges
    /// without length, must have equal coordinates.
    void add_overlaps(Constraints<S>& constraints) const {
        const Vector a = maps_.rotation * moving_.from + maps_.translation;
        const Vector b = maps_.rotation * moving_.to + maps_.translation;
        add_overlap(a, b, fixed_.from, fixed_.direction, fixed_.size, constraints);
        const Vector c = in_body(fixed_.from);
        const Vector d = in_body(fixed_.from + fixed_.direction);
        add_overlap(c, d, moving_.from, moving_.along, moving_.size, constraints);
        for (int i = 0; i < 3 && !(S(0) < moving_.size) && !(S(0) < fixed_.size); ++i)
            add_opposed({a[i] - maps_.weight * fixed_.from[i], with_underflow<S>(unit_)}, Polynomial(), 0, constraints);
    }

    /// Component i of (W c - A) x v. It is U x v times the fraction of the moving edge before the fixed line.
    [[nodiscard]] Polynomial end_arm(int i) const {
        const auto a = [&](int component) {
            return dot(maps_.rotation.row[component], moving_.from) + maps_.translation[component];
        };
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        return maps_.weight * fixed_.moment[i] - (a(j) * fixed_.direction[k] - a(k) * fixed_.direction[j]);
    }

    /// Component i of c x U - M. It is U x v times the fraction of the fixed edge before the moving line.
    [[nodiscard]] Polynomial line_arm(int i) const {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        return moving_.direction[k] * fixed_.from[j] - moving_.direction[j] * fixed_.from[k] - moving_.moment[i];
    }

    [[nodiscard]] S end_arm_error() const { return with_underflow<S>(unit_ * fixed_.size); }
    /// The arm runs from the moving edge to an end of the fixed edge, which may be long.
    [[nodiscard]] S line_arm_error() const {
        const S rounding = unit_ * moving_.size;
        return with_underflow<S>(turn_deviation_ > 0 ? S(rounding + S(turn_deviation_) * size()) : rounding);
    }
    /// Whether the edges are so nearly parallel that the tests of their ends stand for them, for a greatest component
    /// of U x v, at most `parallel` times the product of both sizes.
    [[nodiscard]] bool are_nearly_parallel(const S& widest, double parallel) const {
        return widest <= S(parallel - turn_deviation_) * size();
    }

private:
    /// Adds the constraint that the projection of the edge from p to q on `along` overlaps the edge that starts at
    /// `from` with direction `along`.
    void add_overlap(const Vector& p, const Vector& q, const Vector3<S>& from, const Vector3<S>& along, const S& size,
                     Constraints<S>& constraints) const {
        const S offset = dot(along, from);
        const S error = with_underflow<S>(unit_ * size);
        constraints.add({height<S>({p, maps_.weight}, along, offset), error},
                        {height<S>({q, maps_.weight}, along, offset), error}, dot(along, along));
    }

    /// W times a fixed point in the frame of the moving body.
    [[nodiscard]] Vector in_body(const Vector3<S>& point) const {
        return maps_.rotation.transposed() * point - maps_.inverse_translation;
    }

    /// Adds constraints for `first` and second = first - crossing. sign > 0: first >= 0 >= second. sign < 0: the
    /// reverse. sign = 0: 0 lies between both, in either order.
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
    S norm_unit_;
    double turn_deviation_;
};

/// If no component of U x v is beyond this fraction of the lengths, all three components are tested. Both sets of
/// constraints are correct for any angle. A single component separates no better than the volume; all three separate
/// nearly parallel edges that pass at a small height (note 04, "Nearly parallel edges").
inline constexpr double parallel_angle = 0x1p-32;

/// The component of U x v that is proven to keep its sign with the greatest distance from zero. The sign is 0 if no
/// component is proven to keep its sign at a distance of more than `least`.
struct CrossingAxis {
    int component = 0;
    int sign = 0; ///< 1, -1 or 0
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

/// Whether a constraint is proven to fail during the whole motion. Then no root search is needed.
template <class S>
bool fails(const Constraint<3, S>& constraint, const Bernstein<3, S>& weight) {
    using Polynomial = Bernstein<3, S>;
    const auto may_hold = [&](const Polynomial& first, const Polynomial* second) {
        return !is_negative(first, weight * constraint.first.error) ||
               (second && !is_negative(*second, weight * constraint.second.error));
    };
    return !algebra::all_inequalities(constraint, weight, constraint.first.polynomial, constraint.second.polynomial,
                                      may_hold);
}

/// The first time for edges on lines that may intersect.
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

/// The first tau in [0, 1] at which the closed edges may touch. An empty result proves that the edges never touch.
/// Parallel edges need no special case. If no component of U x v keeps its sign, all three components are used together
/// with the overlap along each edge.
template <class S>
std::optional<FeasibleInterval> edge_edge(const motion::ControlMaps<S>& maps, const EdgePath<S>& moving,
                                          const FixedEdge<S>& fixed, const Accuracy& accuracy,
                                          Workspace<S>& workspace) {
    ++workspace.elementary_tests;
    const detail::EdgePair<S> pair({maps, moving, fixed}, accuracy.scale);
    const Bounded<3, S> volume = pair.volume();
    if (keeps_one_sign(volume.polynomial, maps.weight * volume.error))
        return std::nullopt;
    return detail::first_meeting(pair, volume, maps.weight, accuracy.tolerance, workspace);
}

} // namespace chasles::elementary
