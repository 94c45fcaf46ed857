// Elementary detections on cases in exact rationals, computed in double, double-double and rationals.
#pragma once

#include "chasles/elementary/edge_edge.h"
#include "tests/support/rational_motions.h"

#include <vector>

namespace chasles::test {

using Point = Vector3<Rational>;
using Points = std::vector<Point>;
using Answer = std::optional<algebra::FeasibleInterval>;

inline Point point(const Rational& x, const Rational& y, const Rational& z) {
    return {x, y, z};
}

/// The control maps of the library: computed in double-double, and rounded to double.
template <class S>
motion::ControlMaps<S> maps_in(const RationalMotion<Rational>& motion) {
    return motion::control_maps(rounded_to<S>(motion));
}
template <>
inline motion::ControlMaps<double> maps_in<double>(const RationalMotion<Rational>& motion) {
    return motion::rounded(maps_in<DoubleDouble>(motion));
}

template <class S>
constexpr algebra::Tolerance tolerance_in = {1e-12, 1e-12};
template <>
inline constexpr algebra::Tolerance tolerance_in<DoubleDouble> = {1e-12, 0x1p-90};

inline double reach(const Points& points) {
    double largest = 0;
    for (const Point& p : points)
        for (int i = 0; i < 3; ++i)
            largest = std::max(largest, std::abs(static_cast<double>(p[i])) * (1 + 0x1p-40));
    return largest;
}

/// A motion and the accuracy that the library requests for these bodies.
template <class S>
struct Stage {
    motion::ControlMaps<S> maps;
    elementary::Accuracy accuracy;
    elementary::Workspace<S> workspace{};

    Stage(const RationalMotion<Rational>& motion, const Points& moving, const Points& fixed)
        : maps(maps_in<S>(motion)),
          accuracy{elementary::error_scale(maps_in<double>(motion), reach(moving), reach(fixed)), tolerance_in<S>} {}
};

template <class S>
std::vector<Vector3<S>> corners_in(const Points& corners) {
    std::vector<Vector3<S>> result;
    for (const Point& corner : corners)
        result.push_back(rounded_to<S>(corner));
    return result;
}

/// A face of a body: its outline, and its triangles unless it is convex.
struct Face {
    Points corners;
    std::vector<std::uint32_t> triangles{};
};

/// A moving vertex, given at the start, and a fixed face.
struct VertexFaceCase {
    PlainScrew screw;
    Point vertex;
    Face face;

    template <class S>
    [[nodiscard]] Answer ask() const {
        Stage<S> stage(screw.motion(), {vertex}, face.corners);
        const auto corners = corners_in<S>(face.corners);
        const auto shape = elementary::face_shape<S>(corners, face.triangles);
        const auto path = stage.maps.rotation * rounded_to<S>(vertex) + stage.maps.translation;
        return elementary::vertex_face<S>({path, stage.maps.weight}, shape, stage.accuracy, stage.workspace);
    }
};

/// A moving face, given at the start, and a fixed vertex.
struct FaceVertexCase {
    PlainScrew screw;
    Face face;
    Point vertex;

    template <class S>
    [[nodiscard]] Answer ask() const {
        Stage<S> stage(screw.motion(), face.corners, {vertex});
        const auto corners = corners_in<S>(face.corners);
        const auto shape = elementary::face_shape<S>(corners, face.triangles);
        const auto path = stage.maps.rotation.transposed() * rounded_to<S>(vertex) - stage.maps.inverse_translation;
        return elementary::vertex_face<S>({path, stage.maps.weight}, shape, stage.accuracy, stage.workspace);
    }
};

struct Line {
    Point from;
    Point to;
};

/// A moving edge, given at the start, and a fixed edge.
struct EdgeEdgeCase {
    PlainScrew screw;
    Line moving;
    Line fixed;

    template <class S>
    [[nodiscard]] Answer ask(const algebra::Tolerance& tolerance = tolerance_in<S>) const {
        Stage<S> stage(screw.motion(), {moving.from, moving.to}, {fixed.from, fixed.to});
        stage.accuracy.tolerance = tolerance;
        const auto path = elementary::edge_path(stage.maps, rounded_to<S>(moving.from), rounded_to<S>(moving.to));
        const auto edge = elementary::fixed_edge(rounded_to<S>(fixed.from), rounded_to<S>(fixed.to));
        return elementary::edge_edge<S>(stage.maps, path, edge, stage.accuracy, stage.workspace);
    }
};

template <class S, class Case>
void expect_contact_in(const Case& posed, const Rational& tau, double slack) {
    const Answer found = posed.template ask<S>();
    ASSERT_TRUE(found) << "missed";
    EXPECT_LE(Rational(found->lower), tau + Rational(slack)) << "late";
    EXPECT_GE(Rational(found->upper), tau - Rational(slack)) << "earlier than the contact";
    EXPECT_LE(found->upper - found->lower, 1.001e-12 + 20 * slack);
}

/// Expects the first contact at tau in all three scalars. Brackets in doubles may be wider than the tolerance. Grazing
/// contacts move by the square root of the rounding.
template <class Case>
void expect_contact(const Case& posed, const Rational& tau) {
    expect_contact_in<Rational>(posed, tau, 0);
    expect_contact_in<double>(posed, tau, 1e-12);
    expect_contact_in<DoubleDouble>(posed, tau, 1e-26);
}
template <class Case>
void expect_grazing(const Case& posed, const Rational& tau) {
    expect_contact_in<Rational>(posed, tau, 0);
    expect_contact_in<double>(posed, tau, 3e-6);
    expect_contact_in<DoubleDouble>(posed, tau, 1e-12);
}

template <class Case>
void expect_clear(const Case& posed) {
    EXPECT_FALSE(posed.template ask<Rational>());
    EXPECT_FALSE(posed.template ask<double>());
    EXPECT_FALSE(posed.template ask<DoubleDouble>());
}

/// Motions of the paper's cases. Turns are half-angle tangents about the third axis; every case can be rotated to this
/// axis.
inline PlainScrew no_motion() {
    return {};
}
inline PlainScrew translation(const Point& shift) {
    return {{}, {}, shift};
}
inline PlainScrew rotation(const Rational& tangent) {
    return {{}, {0, 0, tangent}, {}};
}
inline PlainScrew screw(const Rational& tangent, const Rational& slide) {
    return {{}, {0, 0, tangent}, {0, 0, slide}};
}

} // namespace chasles::test
