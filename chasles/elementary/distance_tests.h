// The conditions that two features are within a margin of each other: squared distances as polynomials of degree six.
// The conditions are polynomial inequalities for `first_feasible`. Source: docs/derivations/16-margin.md.
// Legend: the moving edge runs from a to b with direction u; the fixed edge starts at c with direction v; W is the
// weight, d the margin, P is W times the position of a moving vertex, V the reciprocal product of two lines.
#pragma once

#include "chasles/algebra/sum_of_products.h"
#include "chasles/elementary/feature_separation.h"

namespace chasles::elementary {

using algebra::Sized;
using algebra::SumOfProducts;

/// The distance within which features count as in contact, in the length unit, and its square.
template <class S>
struct Margin {
    S distance;
    S square;

    explicit Margin(double margin) : distance(margin), square(distance * distance) {}
};

/// Edges that cross at a smaller sine than this may be treated as parallel. Then ends of the edges are as close as the
/// edges, up to this fraction of the scene (note 16, "Nearly parallel edges").
inline constexpr double parallel_slack = 0x1p-44;

namespace detail {

// Bounds of |U x v| as fractions of the product of the 1-norms of both edges.
inline constexpr double nearly_parallel = 0x1p-48; ///< pairs below it are left to the tests of their ends
inline constexpr double least_crossing = 0x1p-46;  ///< a constraint: |U x v| is at least this

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

/// A feasibility problem of degree six: the weight W^2, F = squared distance - squared margin, and up to five
/// constraints.
template <class S>
class SquareProblem {
public:
    explicit SquareProblem(const Cubic<S>& weight) : weight_(product(weight, weight)) {}

    /// `slack` (a square) is added to the error of F. It covers nearly parallel edges that this test stands for.
    void set_function(const Bounded<6, S>& function, const S& slack) {
        function_ = {function.polynomial, function.error + slack};
    }
    /// Adds the constraint that a polynomial is >= 0. Returns false if the polynomial is proven to stay negative.
    bool add(const Bounded<6, S>& constraint) {
        Constraint<6, S>& next = constraints_[count_++];
        next.first = constraint;
        return !is_negative(constraint.polynomial, weight_ * constraint.error);
    }
    /// Whether F is proven to stay positive.
    [[nodiscard]] bool is_separated() const { return is_positive(function_.polynomial, weight_ * function_.error); }

    [[nodiscard]] algebra::FeasibilityProblem<6, S> problem() const {
        return {weight_, function_, std::span(constraints_).first(count_)};
    }

private:
    Bernstein<6, S> weight_;
    Bounded<6, S> function_;
    std::array<Constraint<6, S>, 5> constraints_;
    std::size_t count_ = 0;
};

/// W p: a cubic as a constraint of degree six.
template <class S>
Bounded<6, S> lifted(const Bounded<3, S>& p, const Cubic<S>& weight) {
    SumOfProducts<S> sum;
    sum.add(algebra::sized(p, weight), {{weight, S(0)}, S(1)});
    return sum.bounded();
}

/// Adds the constraints that the foot of the perpendicular from a vertex is on an edge. `arm` is P - W c. Returns false
/// if the foot is proven never to be on the edge.
template <class S>
bool add_foot_constraints(const Vector3<Cubic<S>>& arm, const RestingEdge<S>& edge, const S& unit,
                          const Cubic<S>& weight, SquareProblem<S>& problem) {
    const S error = with_underflow<S>(unit * edge.size);
    const Bounded<3, S> after_start{dot(arm, edge.direction), error};
    const Bounded<3, S> before_end{weight * edge.square - after_start.polynomial, error};
    for (const Bounded<3, S>& side : {after_start, before_end})
        if (is_negative(side.polynomial, weight * side.error))
            return false;
    return problem.add(lifted(after_start, weight)) && problem.add(lifted(before_end, weight));
}

/// Adds the constraints that the closest points of two lines are on both edges. `square` is |U x v|^2. Returns false if
/// the closest points are proven never to be on both edges.
template <class S>
bool add_closest_point_constraints(const EdgePair<S>& pair, const SizedVector<S>& crossing,
                                   const SumOfProducts<S>& square, const Cubic<S>& weight, SquareProblem<S>& problem) {
    const auto add_share = [&](const Vector3<Cubic<S>>& arm, const S& error) {
        const SumOfProducts<S> share = dot_product(sized_vector(arm, error, weight), crossing);
        return problem.add(share.bounded()) && problem.add(square.minus(share).bounded());
    };
    return add_share({pair.end_arm(0), pair.end_arm(1), pair.end_arm(2)}, pair.end_arm_error()) &&
           add_share({pair.line_arm(0), pair.line_arm(1), pair.line_arm(2)}, pair.line_arm_error());
}

template <class S, class Visit>
void visit_unless_separated(const SquareProblem<S>& problem, Workspace<S>& workspace, Visit visit) {
    if (problem.is_separated())
        return;
    ++workspace.root_brackets;
    visit(problem.problem());
}

template <class S>
S unit_of(const Accuracy& accuracy) {
    return position_error<S>(accuracy.scale);
}

} // namespace detail

// Each test calls `visit(problem)` with the condition "the closest points of both features are within the margin",
// F <= 0 with all constraints. It makes no call if the condition is proven to fail during the whole motion. The
// problems have the degree of the squared distance; the problems of vertex and face are cubic.

/// Vertex and vertex: |P - W c|^2 <= d^2 W^2.
template <class S, class Visit>
void vertex_vertex_distance(const VertexPath<S>& path, const Vector3<S>& point, const Margin<S>& margin,
                            const Accuracy& accuracy, Workspace<S>& workspace, Visit visit) {
    ++workspace.elementary_tests;
    const S unit = detail::unit_of<S>(accuracy);
    const S slack = S(parallel_slack * accuracy.scale.length);
    if (detail::are_separated<S>(path, point, {margin.distance + slack, accuracy.scale}))
        return;
    const Vector3<Bernstein<3, S>> arm = path.position - scale(point, path.weight);
    const auto sized_arm = detail::sized_vector<S>(arm, with_underflow<S>(unit), path.weight);
    detail::SquareProblem<S> problem(path.weight);
    problem.set_function(
        detail::dot_product<S>(sized_arm, sized_arm).minus(detail::constant<S>(margin.square, path.weight)).bounded(),
        slack * slack);
    detail::visit_unless_separated(problem, workspace, visit);
}

/// Vertex and edge: |(P - W c) x v|^2 <= d^2 |v|^2 W^2, and 0 <= (P - W c) . v <= |v|^2 W.
template <class S, class Visit>
void vertex_edge_distance(const VertexPath<S>& path, const RestingEdge<S>& edge, const Margin<S>& margin,
                          const Accuracy& accuracy, Workspace<S>& workspace, Visit visit) {
    ++workspace.elementary_tests;
    const S unit = detail::unit_of<S>(accuracy);
    if (detail::are_separated<S>(path, edge, {margin.distance + S(parallel_slack) * edge.size, accuracy.scale}))
        return;
    const Vector3<Bernstein<3, S>> arm = path.position - scale(edge.from, path.weight);
    detail::SquareProblem<S> problem(path.weight);
    if (!detail::add_foot_constraints(arm, edge, unit, path.weight, problem))
        return;
    const auto sized_moment =
        detail::sized_vector<S>(cross(arm, edge.direction), with_underflow<S>(unit * edge.size), path.weight);
    const S slack = S(parallel_slack) * edge.square;
    problem.set_function(detail::dot_product<S>(sized_moment, sized_moment)
                             .minus(detail::constant<S>(margin.square * edge.square, path.weight))
                             .bounded(),
                         slack * slack);
    detail::visit_unless_separated(problem, workspace, visit);
}

namespace detail {

/// The three quantities of the edge and edge condition: V, U x v and |U x v|^2.
template <class S>
struct EdgeDistance {
    Bounded<3, S> volume;
    SizedVector<S> crossing;
    SumOfProducts<S> square;
};

/// Empty if the edges are proven to stay beyond the margin, or if they are parallel and the tests of their ends
/// suffice.
template <class S>
std::optional<EdgeDistance<S>> edge_distance(const EdgePair<S>& pair, const Cubic<S>& weight, const S& margin) {
    const Bounded<3, S> volume = pair.volume();
    if (keeps_one_sign(volume.polynomial, weight * S(volume.error + margin * pair.size())))
        return std::nullopt;
    const auto crossing = sized_vector<S>(pair.crossing(), pair.crossing_error(), weight);
    const S widest = std::max({crossing.x.size, crossing.y.size, crossing.z.size});
    const S crossing_bound =
        margin * (crossing.x.size + crossing.y.size + crossing.z.size + pair.crossing_error() * S(3));
    if (keeps_one_sign(volume.polynomial, weight * S(volume.error + crossing_bound)) ||
        pair.are_nearly_parallel(widest, nearly_parallel))
        return std::nullopt;
    return EdgeDistance<S>{volume, crossing, dot_product<S>(crossing, crossing)};
}

} // namespace detail

/// Edge and edge: V^2 <= d^2 |U x v|^2, 0 <= (W c - A) x v . (U x v) <= |U x v|^2 and 0 <= (c x U - M) . (U x v) <=
/// |U x v|^2. Parallel edges are left to the tests of their ends.
template <class S, class Visit>
void edge_edge_distance(const EdgeMotion<S>& edges, const Margin<S>& margin, const Accuracy& accuracy,
                        Workspace<S>& workspace, Visit visit) {
    ++workspace.elementary_tests;
    if (detail::are_separated<S>(edges, {margin.distance, accuracy.scale}))
        return;
    const Bernstein<3, S>& weight = edges.maps.weight;
    const detail::EdgePair<S> pair(edges, accuracy.scale);
    const auto distance = detail::edge_distance<S>(pair, weight, margin.distance);
    if (!distance)
        return;
    const S least = S(detail::least_crossing) * pair.size();
    detail::SquareProblem<S> problem(weight);
    if (!problem.add(distance->square.minus(detail::constant<S>(least * least, weight)).bounded()) ||
        !detail::add_closest_point_constraints<S>(pair, distance->crossing, distance->square, weight, problem))
        return;
    SumOfProducts<S> squared_volume;
    const Sized<S> volume = algebra::sized(distance->volume, weight);
    squared_volume.add(volume, volume);
    problem.set_function(squared_volume.minus(distance->square.scaled(margin.square)).bounded(), S(0));
    detail::visit_unless_separated(problem, workspace, visit);
}

namespace detail {

/// The plane of a face and the offset d |n| W of the two planes at the margin.
template <class S>
struct PlanesAtMargin {
    const Bounded<3, S>& plane;
    const Cubic<S> offset;
};

/// Visits the problems of both sides: F is the height over one plane at the margin, and the last constraint keeps the
/// vertex on the inner side of the other plane. `constraints` holds the constraints of the face's edges.
template <class S, class Visit>
void visit_both_sides(const PlanesAtMargin<S>& planes, const Cubic<S>& weight, Constraints<S>& constraints,
                      Visit visit) {
    const Bounded<3, S> above{planes.plane.polynomial - planes.offset, planes.plane.error};
    const Bounded<3, S> below{Cubic<S>() - planes.plane.polynomial - planes.offset, planes.plane.error};
    Bounded<3, S>& other_side = constraints.add();
    for (const bool from_above : {true, false}) {
        other_side = from_above ? below : above;
        other_side.polynomial = Cubic<S>() - other_side.polynomial;
        visit(algebra::FeasibilityProblem<3, S>{weight, from_above ? above : below, constraints.all()});
    }
}

} // namespace detail

/// Vertex and face: |n . P - W n . c| <= d |n| W inside the edges of the face. `visit` is called for both sides of each
/// convex part of the face.
template <class S, class Visit>
void vertex_face_distance(const VertexPath<S>& path, const FaceShape<S>& face, const Margin<S>& margin,
                          const Accuracy& accuracy, Workspace<S>& workspace, Visit visit) {
    ++workspace.elementary_tests;
    const Bounded<3, S> plane = detail::plane(path, face, accuracy.scale);
    const S offset = margin.distance * length(face.normal);
    if (keeps_one_sign(plane.polynomial, path.weight * S(plane.error + offset)))
        return;
    for (std::size_t i = 0, count = convex_part_count(face); i < count; ++i) {
        if (!detail::add_inside_constraints(path, convex_part(face, i), accuracy.scale, workspace.constraints))
            continue;
        ++workspace.root_brackets;
        detail::visit_both_sides<S>({plane, path.weight * offset}, path.weight, workspace.constraints, visit);
    }
}

} // namespace chasles::elementary
