// When do two features come within a margin of each other? Squared distances along the motion, in degree six.
// Source: docs/derivations/16-margin.md. Legend: the moving edge runs from a to b with direction u, the fixed one from
// c with direction v; W is the weight, d the margin.
#pragma once

#include "chasles/algebra/sum_of_products.h"
#include "chasles/elementary/edge_edge.h"

namespace chasles::elementary {

using algebra::Sized;
using algebra::SumOfProducts;

/// A distance that counts as contact, and its square.
template <class S>
struct Margin {
    S distance;
    S square;

    explicit Margin(double margin) : distance(margin), square(distance * distance) {}
};

/// An edge at rest in the frame of the vertex's path.
template <class S>
struct RestingEdge {
    Vector3<S> from;      ///< c
    Vector3<S> direction; ///< v
    S size;               ///< |v|_1
    S square;             ///< |v|^2
};

template <class S>
RestingEdge<S> resting_edge(const Vector3<S>& from, const Vector3<S>& to) {
    const Vector3<S> v = to - from;
    return {from, v, norm1(v), dot(v, v)};
}

/// Edges at a smaller sine than this may be taken for parallel: ends of theirs are as near, up to this part of the
/// scene (note 16, "Nearly parallel edges").
inline constexpr double parallel_slack = 0x1p-44;

namespace detail {

/// Of the product of two edges' 1-norms.
inline constexpr double nearly_parallel = 0x1p-48;
inline constexpr double least_crossing = 0x1p-46;

template <class S>
using Cubic = Bernstein<3, S>;
template <class S>
using SizedVector = Vector3<Sized<S>>;

template <class S>
SizedVector<S> sized_vector(const Vector3<Cubic<S>>& vector, const S& error, const Cubic<S>& weight) {
    const auto component = [&](int i) { return algebra::sized<S>({vector[i], error}, weight); };
    return {component(0), component(1), component(2)};
}

template <class S>
SumOfProducts<S> dot_product(const SizedVector<S>& a, const SizedVector<S>& b) {
    SumOfProducts<S> sum;
    for (int i = 0; i < 3; ++i)
        sum.add(a[i], b[i]);
    return sum;
}

/// A number times the square of the weight.
template <class S>
SumOfProducts<S> constant(const S& number, const Cubic<S>& weight) {
    SumOfProducts<S> square;
    const Sized<S> one{{weight, S(0)}, S(1)};
    square.add(one, one);
    return square.scaled(number);
}

/// W^2, F = square - limit and up to five constraints of degree six, each of which is >= 0.
template <class S>
class SquareProblem {
public:
    explicit SquareProblem(const Cubic<S>& weight) : weight_(product(weight, weight)) {}

    /// Squared distances at which nearly parallel edges may be nearer than their ends.
    void set_function(const Bounded<6, S>& function, const S& slack) {
        function_ = {function.polynomial, function.error + slack};
    }
    /// False if it is proven to fail all along.
    bool demand(const Bounded<6, S>& constraint) {
        Constraint<6, S>& next = constraints_[count_++];
        next.first = constraint;
        return !is_negative(constraint.polynomial, weight_ * constraint.error);
    }
    /// Proven to stay beyond the limit.
    [[nodiscard]] bool stays_apart() const { return is_positive(function_.polynomial, weight_ * function_.error); }

    [[nodiscard]] algebra::FeasibilityProblem<6, S> problem() const {
        return {weight_, function_, std::span(constraints_).first(count_)};
    }

private:
    Bernstein<6, S> weight_;
    Bounded<6, S> function_;
    std::array<Constraint<6, S>, 5> constraints_;
    std::size_t count_ = 0;
};

/// W p, for a constraint beside those of degree six.
template <class S>
Bounded<6, S> lifted(const Bounded<3, S>& p, const Cubic<S>& weight) {
    SumOfProducts<S> sum;
    sum.add(algebra::sized(p, weight), {{weight, S(0)}, S(1)});
    return sum.bounded();
}

/// The foot of the perpendicular is on the edge; false if it is proven never to be.
template <class S>
bool demand_foot(const Vector3<Cubic<S>>& arm, const RestingEdge<S>& edge, const S& unit, const Cubic<S>& weight,
                 SquareProblem<S>& problem) {
    const S error = with_underflow<S>(unit * edge.size);
    const Bounded<3, S> behind_start{dot(arm, edge.direction), error};
    const Bounded<3, S> before_end{weight * edge.square - behind_start.polynomial, error};
    for (const Bounded<3, S>& side : {behind_start, before_end})
        if (is_negative(side.polynomial, weight * side.error))
            return false;
    return problem.demand(lifted(behind_start, weight)) && problem.demand(lifted(before_end, weight));
}

/// The points of two lines that are nearest to each other are on both edges; false if they are proven never to be.
template <class S>
bool demand_between(const EdgePair<S>& pair, const SizedVector<S>& crossing, const SumOfProducts<S>& square,
                    const Cubic<S>& weight, SquareProblem<S>& problem) {
    const auto demand_share = [&](const Vector3<Cubic<S>>& arm, const S& error) {
        const SumOfProducts<S> share = dot_product(sized_vector(arm, error, weight), crossing);
        return problem.demand(share.bounded()) && problem.demand(square.minus(share).bounded());
    };
    return demand_share({pair.end_arm(0), pair.end_arm(1), pair.end_arm(2)}, pair.end_arm_error()) &&
           demand_share({pair.line_arm(0), pair.line_arm(1), pair.line_arm(2)}, pair.line_arm_error());
}

/// Where a path is half way.
template <class S>
Vector3<S> half_way(const Vector3<Cubic<S>>& path, const Cubic<S>& weight) {
    return position_at<S>(path, weight, S(0.5));
}

template <class S>
S clamped_share(const S& part, const S& whole) {
    return part > S(0) ? part < whole ? S(part / whole) : S(1) : S(0);
}

/// The way to a point from the segment that starts at c with direction v.
template <class S>
Vector3<S> way_from_segment(const Vector3<S>& c, const Vector3<S>& v, const Vector3<S>& point) {
    const Vector3<S> arm = point - c;
    return arm - scale(v, clamped_share<S>(dot(arm, v), dot(v, v)));
}

/// The shortest way from there to the segment that starts at a with direction u.
template <class S>
Vector3<S> way_between_segments(const Vector3<S>& c, const Vector3<S>& v, const Vector3<S>& a, const Vector3<S>& u) {
    const Vector3<S> arm = a - c;
    const S uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
    const S on_line = clamped_share<S>(uv * dot(v, arm) - vv * dot(u, arm), uu * vv - uv * uv);
    const Vector3<S> near = a + scale(u, on_line);
    const Vector3<S> foot = c + scale(v, clamped_share<S>(dot(near - c, v), vv));
    return scale(way_from_segment(a, u, foot), S(-1));
}

/// A plane across a direction with all points p of a feature on one side: way . p <= reach. What stays beyond it by
/// more than a distance is farther than that from the feature, whatever the direction.
template <class S>
class Front {
public:
    Front(const Vector3<S>& way, const S& reach, const S& distance, const S& unit, const Cubic<S>& weight)
        : way_(way), limit_(weight * S(reach + distance * length(way) + with_underflow<S>(unit * norm1(way) * S(2)))) {}

    [[nodiscard]] bool is_left_behind(const Vector3<Cubic<S>>& path) const {
        return is_positive(dot(path, way_), limit_);
    }

private:
    Vector3<S> way_;
    Cubic<S> limit_;
};

/// Before the segment that starts at c with direction v.
template <class S>
Front<S> front_of_segment(const Vector3<S>& c, const Vector3<S>& v, const Vector3<S>& way, const S& distance,
                          const S& unit, const Cubic<S>& weight) {
    const S along = dot(way, v);
    return {way, dot(way, c) + (along > S(0) ? along : S(0)), distance, unit, weight};
}

// Whether the shortest way half way proves two features to stay farther apart than a distance.

template <class S>
bool are_separated(const VertexPath<S>& path, const Vector3<S>& point, const S& distance, const S& unit) {
    const Vector3<S> way = half_way(path.position, path.weight) - point;
    return Front<S>(way, dot(way, point), distance, unit, path.weight).is_left_behind(path.position);
}

template <class S>
bool are_separated(const VertexPath<S>& path, const RestingEdge<S>& edge, const S& distance, const S& unit) {
    const Vector3<S> way = way_from_segment(edge.from, edge.direction, half_way(path.position, path.weight));
    return front_of_segment<S>(edge.from, edge.direction, way, distance, unit, path.weight)
        .is_left_behind(path.position);
}

/// This one tells what edges that become parallel have in doubt otherwise.
template <class S>
bool are_separated(const motion::ControlMaps<S>& maps, const EdgePath<S>& moving, const FixedEdge<S>& fixed,
                   const S& distance, const S& unit) {
    const Vector3<Cubic<S>> from = maps.rotation * moving.from + maps.translation;
    const Vector3<S> way = way_between_segments(fixed.from, fixed.direction, half_way(from, maps.weight),
                                                half_way(moving.direction, maps.weight));
    const auto front = front_of_segment<S>(fixed.from, fixed.direction, way, distance, unit, maps.weight);
    return front.is_left_behind(from) && front.is_left_behind(from + moving.direction);
}

template <class S, class Ask>
void ask_unless_apart(const SquareProblem<S>& problem, Workspace<S>& workspace, Ask ask) {
    if (problem.stays_apart())
        return;
    ++workspace.root_brackets;
    ask(problem.problem());
}

template <class S>
S unit_of(const Accuracy& accuracy) {
    return S(relative_error<S>(accuracy.scale) * accuracy.scale.length);
}

} // namespace detail

// Each calls `ask(problem)` for the condition "the features' nearest points are within the margin", F <= 0 with all
// constraints, unless it is proven to fail all along. Problems have the degree of the squared distance; that of a
// vertex and a face is cubic.

/// Vertex and vertex: |P - W c|^2 <= d^2 W^2.
template <class S, class Ask>
void vertex_vertex_distance(const VertexPath<S>& path, const Vector3<S>& point, const Margin<S>& margin,
                            const Accuracy& accuracy, Workspace<S>& workspace, Ask ask) {
    ++workspace.elementary_tests;
    const S unit = detail::unit_of<S>(accuracy);
    const S slack = S(parallel_slack * accuracy.scale.length);
    if (detail::are_separated<S>(path, point, margin.distance + slack, unit))
        return;
    const Vector3<Bernstein<3, S>> arm = path.position - scale(point, path.weight);
    const auto sized_arm = detail::sized_vector<S>(arm, with_underflow<S>(unit), path.weight);
    detail::SquareProblem<S> problem(path.weight);
    problem.set_function(
        detail::dot_product<S>(sized_arm, sized_arm).minus(detail::constant<S>(margin.square, path.weight)).bounded(),
        slack * slack);
    detail::ask_unless_apart(problem, workspace, ask);
}

/// Vertex and edge: |(P - W c) x v|^2 <= d^2 |v|^2 W^2, and 0 <= (P - W c) . v <= |v|^2 W.
template <class S, class Ask>
void vertex_edge_distance(const VertexPath<S>& path, const RestingEdge<S>& edge, const Margin<S>& margin,
                          const Accuracy& accuracy, Workspace<S>& workspace, Ask ask) {
    ++workspace.elementary_tests;
    const S unit = detail::unit_of<S>(accuracy);
    if (detail::are_separated<S>(path, edge, margin.distance + S(parallel_slack) * edge.size, unit))
        return;
    const Vector3<Bernstein<3, S>> arm = path.position - scale(edge.from, path.weight);
    detail::SquareProblem<S> problem(path.weight);
    if (!detail::demand_foot(arm, edge, unit, path.weight, problem))
        return;
    const auto sized_moment =
        detail::sized_vector<S>(cross(arm, edge.direction), with_underflow<S>(unit * edge.size), path.weight);
    const S slack = S(parallel_slack) * edge.square;
    problem.set_function(detail::dot_product<S>(sized_moment, sized_moment)
                             .minus(detail::constant<S>(margin.square * edge.square, path.weight))
                             .bounded(),
                         slack * slack);
    detail::ask_unless_apart(problem, workspace, ask);
}

/// Edge and edge: V^2 <= d^2 |U x v|^2, and 0 <= (W c - A) x v . (U x v) <= |U x v|^2 as well as 0 <= (c x U - M) . (U
/// x v) <= |U x v|^2. Edges that are parallel are left to their ends.
template <class S, class Ask>
void edge_edge_distance(const motion::ControlMaps<S>& maps, const EdgePath<S>& moving, const FixedEdge<S>& fixed,
                        const Margin<S>& margin, const Accuracy& accuracy, Workspace<S>& workspace, Ask ask) {
    ++workspace.elementary_tests;
    if (detail::are_separated<S>(maps, moving, fixed, margin.distance, detail::unit_of<S>(accuracy)))
        return;
    const detail::EdgePair<S> pair(maps, moving, fixed, accuracy.scale);
    const Bounded<3, S> volume = pair.volume();
    const S most = margin.distance * pair.size();
    if (keeps_one_sign(volume.polynomial, maps.weight * S(volume.error + most)))
        return;
    const auto crossing = detail::sized_vector<S>(pair.crossing(), pair.crossing_error(), maps.weight);
    const S widest = std::max({crossing.x.size, crossing.y.size, crossing.z.size});
    const S spread =
        margin.distance * (crossing.x.size + crossing.y.size + crossing.z.size + pair.crossing_error() * S(3));
    if (keeps_one_sign(volume.polynomial, maps.weight * S(volume.error + spread)) ||
        widest <= S(detail::nearly_parallel) * pair.size())
        return;
    const SumOfProducts<S> square = detail::dot_product<S>(crossing, crossing);
    const S least = S(detail::least_crossing) * pair.size();
    detail::SquareProblem<S> problem(maps.weight);
    if (!problem.demand(square.minus(detail::constant<S>(least * least, maps.weight)).bounded()) ||
        !detail::demand_between<S>(pair, crossing, square, maps.weight, problem))
        return;
    SumOfProducts<S> distance;
    const Sized<S> height = algebra::sized(volume, maps.weight);
    distance.add(height, height);
    problem.set_function(distance.minus(square.scaled(margin.square)).bounded(), S(0));
    detail::ask_unless_apart(problem, workspace, ask);
}

namespace detail {

/// Room for a face's constraints and the plane of the other side of the margin.
template <class S, class CornerAt, class Ask>
void ask_within(const VertexPath<S>& path, const FaceShape<S>& face, std::size_t count, CornerAt corner_at,
                const Bounded<3, S>& plane, const S& reach, const S& unit, Workspace<S>& workspace, Ask ask) {
    Constraints<S>& constraints = workspace.constraints;
    if (!add_inside_constraints(path, face, count, corner_at, unit, constraints))
        return;
    ++workspace.root_brackets;
    const Cubic<S> limit = path.weight * reach;
    const Bounded<3, S> above{plane.polynomial - limit, plane.error};
    const Bounded<3, S> below{Cubic<S>() - plane.polynomial - limit, plane.error};
    Bounded<3, S>& other_side = constraints.add();
    for (const bool from_above : {true, false}) {
        other_side = from_above ? below : above;
        other_side.polynomial = Cubic<S>() - other_side.polynomial;
        ask(algebra::FeasibilityProblem<3, S>{path.weight, from_above ? above : below, constraints.all()});
    }
}

} // namespace detail

/// Vertex and face: |n . P - W n . c| <= d |n| W within the face's edges. `ask` is called for both sides of each convex
/// part of the face.
template <class S, class Ask>
void vertex_face_distance(const VertexPath<S>& path, const FaceShape<S>& face, const Margin<S>& margin,
                          const Accuracy& accuracy, Workspace<S>& workspace, Ask ask) {
    ++workspace.elementary_tests;
    const S unit = detail::unit_of<S>(accuracy);
    const Bounded<3, S> plane = detail::plane(path, face, unit);
    const S reach = margin.distance * length(face.normal);
    if (keeps_one_sign(plane.polynomial, path.weight * S(plane.error + reach)))
        return;
    const auto ask_part = [&](std::size_t count, auto corner_at) {
        detail::ask_within(path, face, count, corner_at, plane, reach, unit, workspace, ask);
    };
    if (face.triangles.empty())
        ask_part(face.corners.size(), [&](std::size_t i) -> const Vector3<S>& { return face.corners[i]; });
    for (std::size_t t = 0; t < face.triangles.size(); t += 3)
        ask_part(3, [&](std::size_t i) -> const Vector3<S>& { return face.corners[face.triangles[t + i]]; });
}

} // namespace chasles::elementary
