// The first time at which a vertex touches a face. No touch is missed; a certain answer is proven. For a fixed vertex
// and a moving face, the path is given in the frame of the moving body. Source: paper sections 3.2.1 to 3.2.4;
// docs/derivations/03-vertex-face.md and 05-being-inside.md.
#pragma once

#include "chasles/algebra/first_feasible.h"
#include "chasles/elementary/face_shape.h"

#include <optional>
#include <vector>

namespace chasles::elementary {

using algebra::Bernstein;
using algebra::Bounded;
using algebra::Constraint;
using algebra::FeasibleInterval;

/// The path of a vertex: W times its position, in the frame of the face's body.
template <class S>
struct VertexPath {
    const Vector3<Bernstein<3, S>>& position;
    const Bernstein<3, S>& weight;
};

/// The position on a path at tau.
template <class S>
Vector3<S> position_at(const Vector3<Bernstein<3, S>>& path, const Bernstein<3, S>& weight, const S& tau) {
    const S inverse = S(1) / value_at(weight, tau);
    return {value_at(path.x, tau) * inverse, value_at(path.y, tau) * inverse, value_at(path.z, tau) * inverse};
}

/// The error bounds of an elementary test and the tolerance of its answer.
struct Accuracy {
    ErrorScale scale;
    algebra::Tolerance tolerance; ///< in the parameter of the interval that the paths are given on
};

/// The constraints of one problem. Its storage is reused without initialization: in double, writing zeros first would
/// take as long as writing the numbers.
template <class S>
class Constraints {
public:
    void clear() { count_ = 0; }
    /// Adds a constraint. The caller writes the polynomial that must be >= 0 to the result.
    Bounded<3, S>& add() {
        Constraint<3, S>& constraint = next();
        constraint.has_alternative = false;
        constraint.span.reset();
        return constraint.first;
    }
    /// Adds the constraint that the interval between p / W and q / W intersects [0, span].
    void add(const Bounded<3, S>& p, const Bounded<3, S>& q, const S& span) { next() = {p, q, true, span}; }

    [[nodiscard]] std::span<const Constraint<3, S>> all() const { return {constraints_.data(), count_}; }

private:
    Constraint<3, S>& next() {
        if (count_ == constraints_.size()) {
            constraints_.reserve(4);
            constraints_.emplace_back();
        }
        return constraints_[count_++];
    }

    std::vector<Constraint<3, S>> constraints_;
    std::size_t count_ = 0;
};

/// Storage for constraints, and counts of the work done. The caller owns it, therefore the tests do not allocate.
template <class S>
struct Workspace {
    Constraints<S> constraints;
    std::uint64_t elementary_tests = 0;
    std::uint64_t root_brackets = 0;
};

namespace detail {

/// W (direction . position - offset): W times the height of the vertex over a plane.
template <class S>
Bernstein<3, S> height(const VertexPath<S>& path, const Vector3<S>& direction, const S& offset) {
    return dot(path.position, direction) - path.weight * offset;
}

/// W times the height of the vertex over the plane of the face.
template <class S>
Bounded<3, S> plane(const VertexPath<S>& path, const FaceShape<S>& face, const ErrorScale& scale) {
    return {height(path, face.normal, face.offset),
            with_underflow<S>(height_error<S>(scale, face.normal, face.size) + face.deviation)};
}

/// A polynomial that is positive on the inner side of one edge of the face.
template <class S>
Bounded<3, S> inside(const VertexPath<S>& path, const FaceShape<S>& face, const Vector3<S>& from, const Vector3<S>& to,
                     const ErrorScale& scale) {
    const Vector3<S> edge = to - from;
    const Vector3<S> inwards = cross(face.normal, edge);
    return {height<S>(path, inwards, dot(inwards, from)),
            with_underflow<S>(height_error<S>(scale, inwards, face.size * norm1(edge)))};
}

/// Sets the constraints that the vertex is inside all edges of a convex part of the face. Returns false if the vertex
/// is proven to stay outside.
template <class S>
bool add_inside_constraints(const VertexPath<S>& path, const ConvexPart<S>& part, const ErrorScale& scale,
                            Constraints<S>& constraints) {
    constraints.clear();
    for (std::size_t i = 0; i < part.count; ++i) {
        Bounded<3, S>& side = constraints.add();
        side = inside(path, part.face, part.corner(i), part.next_corner(i), scale);
        if (is_negative(side.polynomial, path.weight * side.error))
            return false;
    }
    return true;
}

/// The first time for a vertex that may touch the plane of the face. Out of line: inlined, its stack frame would slow
/// down the rejection before it by a tenth (elementary_bench, vertex_face/rejection_ready).
template <class S>
[[gnu::noinline]] std::optional<FeasibleInterval> first_meeting(const VertexPath<S>& path, const FaceShape<S>& face,
                                                                const Bounded<3, S>& plane, const Accuracy& accuracy,
                                                                Workspace<S>& workspace) {
    std::optional<FeasibleInterval> first;
    for (std::size_t i = 0, count = convex_part_count(face); i < count; ++i) {
        if (!add_inside_constraints(path, convex_part(face, i), accuracy.scale, workspace.constraints))
            continue;
        ++workspace.root_brackets;
        const auto found =
            algebra::first_feasible<3, S>({path.weight, plane, workspace.constraints.all()}, accuracy.tolerance);
        if (found && (!first || found->lower < first->lower))
            first = found;
    }
    return first;
}

} // namespace detail

/// The first tau in [0, 1] at which the vertex may be on the closed face. An empty result proves that the vertex never
/// touches the face.
template <class S>
std::optional<FeasibleInterval> vertex_face(const VertexPath<S>& path, const FaceShape<S>& face,
                                            const Accuracy& accuracy, Workspace<S>& workspace) {
    ++workspace.elementary_tests;
    const Bounded<3, S> plane = detail::plane(path, face, accuracy.scale);
    if (keeps_one_sign(plane.polynomial, path.weight * plane.error))
        return std::nullopt;
    return detail::first_meeting(path, face, plane, accuracy, workspace);
}

} // namespace chasles::elementary
