// Every coefficient of the elementary detections is within its stated error bound of the exact coefficient. The exact
// motion is the motion between the caller's poses without rounding. The test covers parts of the motion, in double and
// in double-double. With CHASLES_LONG=1 in the environment: millions of coefficients.
#include "chasles/elementary/error_scale.h"

#include "chasles/elementary/edge_edge.h"
#include "chasles/elementary/face_sides.h"
#include "tests/support/error_ratios.h"
#include "tests/support/posed_motions.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using namespace test;
using DoublePoint = Vector3<double>;

/// The sizes of two bodies, from 1e-6 to 1e6, and the distances of their points from the origins of their frames.
struct Sizes {
    double moving = 1;
    double fixed = 1;

    explicit Sizes(Random& random) : moving(std::abs(random.scaled(-6, 6))) {
        fixed = random.chance(0.5) ? moving : moving * std::abs(random.scaled(-6, 2));
    }
};

/// The control maps of a query, on the whole motion or on a dyadic part, and the maps of the exact motion.
struct Maps {
    motion::ControlMaps<double> in_doubles;
    motion::ControlMaps<DoubleDouble> refined;
    motion::ControlMaps<Rational> exactly;
    motion::ControlMaps<Rational> exactly_whole;
    Accuracy accuracy;

    Maps(Random& random, const PosedMotion& motion, const Sizes& sizes)
        : refined(motion::control_maps(motion.made)), exactly_whole(motion::control_maps(motion.exactly)) {
        in_doubles = motion::double_maps(motion.made);
        accuracy.scale = error_scale(
            in_doubles, std::max(sizes.moving, motion.made.reference_extent) + motion::rounding_extent(motion.made),
            sizes.fixed);
        exactly = exactly_whole;
        if (random.chance(0.5)) {
            const double width = std::ldexp(1.0, -random.integer(1, 12));
            const double from = width * random.integer(0, int(1 / width) - 1);
            in_doubles = restricted(in_doubles, from, from + width);
            exactly = restricted(exactly, Rational(from), Rational(from + width));
        }
    }
};

/// The corners of a triangle: any triangle, a sliver, a triangle that is tiny relative to its distance, or almost a
/// point.
std::vector<DoublePoint> random_corners(Random& random, double reach) {
    const DoublePoint a = random.vector(reach / 2);
    const double size = random.chance(0.3) ? std::abs(random.scaled(-15, 0)) : 1;
    const DoublePoint b = a + random.vector(reach / 4 * size);
    const DoublePoint beyond = scale(b - a, 1.5) + random.vector(reach * std::abs(random.scaled(-16, -5)));
    const DoublePoint c = a + (random.chance(0.3) ? beyond : random.vector(reach / 4 * size));
    return {a, b, c};
}

template <class S>
std::vector<Vector3<S>> points_in(const std::vector<DoublePoint>& points) {
    std::vector<Vector3<S>> result;
    for (const DoublePoint& p : points)
        result.push_back({S(p.x), S(p.y), S(p.z)});
    return result;
}

/// Polynomials in the order of their computation, each with the name of its kind.
template <class S>
struct Named {
    const char* name;
    Bounded<3, S> bounded;
};

/// The plane of a triangle and its three half-spaces, for a vertex at `position`.
template <class S>
std::vector<Named<S>> face_polynomials(const Vector3<Bernstein<3, S>>& position, const Bernstein<3, S>& weight,
                                       const FaceShape<S>& face, const ErrorScale& scale) {
    std::vector<Named<S>> result{{"plane", elementary::detail::plane<S>({position, weight}, face, scale)}};
    for (std::size_t i = 0; i < 3; ++i)
        result.push_back({"inside", elementary::detail::inside<S>({position, weight}, face, face.corners[i],
                                                                  face.corners[(i + 1) % 3], scale)});
    return result;
}

/// All polynomials of two edges.
template <class S>
std::vector<Named<S>> edge_polynomials(const motion::ControlMaps<S>& maps, const std::vector<DoublePoint>& ends,
                                       const Accuracy& accuracy) {
    const auto p = points_in<S>(ends);
    const EdgePath<S> moving = edge_path(maps, p[0], p[1]);
    const FixedEdge<S> fixed = elementary::fixed_edge(p[2], p[3]);
    const elementary::detail::EdgePair<S> pair({maps, moving, fixed}, accuracy.scale);
    std::vector<Named<S>> result{{"volume", pair.volume()}};
    elementary::Constraints<S> constraints;
    const auto add_all = [&](const char* name) {
        for (const auto& constraint : constraints.all()) {
            result.push_back({name, constraint.first});
            result.push_back({name, constraint.second});
        }
        constraints.clear();
    };
    for (int i = 0; i < 3; ++i) {
        const Bernstein<3, S> crossing = pair.crossing()[i];
        result.push_back({"crossing", {crossing, pair.crossing_error()}});
        pair.add_inside(i, crossing, 0, constraints);
    }
    add_all("ends");
    pair.add_overlaps(constraints);
    add_all("overlap");
    return result;
}

template <class S>
void compare(ErrorRatios& ratios, Random& random, const std::vector<Named<S>>& made,
             const std::vector<Named<Rational>>& truth, const Bernstein<3, Rational>& weight) {
    ASSERT_EQ(made.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
        ratios.note(random, made[i].name, made[i].bounded, truth[i].bounded.polynomial, weight);
}

/// Runs `compare_on(maps of one scalar, exact maps)` in double on a part and in double-double on the whole.
template <class Polynomials>
void compare_in_both(ErrorRatios& ratios, Random& random, const Maps& maps, Polynomials polynomials_on) {
    compare(ratios, random, polynomials_on(maps.in_doubles), polynomials_on(maps.exactly), maps.exactly.weight);
    compare(ratios, random, polynomials_on(maps.refined), polynomials_on(maps.exactly_whole),
            maps.exactly_whole.weight);
}

template <class S>
Vector3<S> in_scalar(const DoublePoint& p) {
    return {S(p.x), S(p.y), S(p.z)};
}

constexpr int motions = 200;
constexpr int pairs_a_motion = 3;
constexpr int long_factor = 40;

constexpr double shows_something = 1e-5;

/// All polynomials of a vertex of one body and a face of the other body.
void expect_bounds_of_vertex_and_face(std::uint64_t seed, bool face_moves) {
    Random random(seed);
    ErrorRatios ratios;
    for (int trial = 0; trial < motions * times_if_long(long_factor); ++trial) {
        const Sizes sizes(random);
        const Maps maps(random, random_posed_motion(random, sizes.moving), sizes);
        for (int i = 0; i < pairs_a_motion; ++i) {
            const DoublePoint vertex = random.vector(face_moves ? sizes.fixed : sizes.moving);
            const auto corners = random_corners(random, face_moves ? sizes.moving : sizes.fixed);
            compare_in_both(ratios, random, maps, [&]<class S>(const motion::ControlMaps<S>& m) {
                const auto point = in_scalar<S>(vertex);
                const auto at = points_in<S>(corners);
                const FaceShape<S> face = face_shape<S>(at, {});
                auto all = face_polynomials<S>(face_moves ? m.rotation.transposed() * point - m.inverse_translation
                                                          : m.rotation * point + m.translation,
                                               m.weight, face, maps.accuracy.scale);
                const RelativePlane<S> plane = face_moves ? plane_of_moving_face<S>(m, face, maps.accuracy.scale)
                                                          : plane_of_fixed_face<S>(m, face, maps.accuracy.scale);
                const S unit(relative_error<S>(maps.accuracy.scale) * maps.accuracy.scale.length);
                all.push_back({"side", {dot(plane.normal, point) + plane.offset, unit * face.size}});
                return all;
            });
        }
    }
    ratios.expect_sound(shows_something);
}

TEST(ErrorScale, BoundsEveryCoefficientOfVertexAndFace) {
    expect_bounds_of_vertex_and_face(721, false);
}

TEST(ErrorScale, BoundsEveryCoefficientOfFaceAndVertex) {
    expect_bounds_of_vertex_and_face(722, true);
}

TEST(ErrorScale, BoundsEveryCoefficientOfTwoEdges) {
    Random random(723);
    ErrorRatios ratios;
    for (int trial = 0; trial < motions * times_if_long(long_factor); ++trial) {
        const Sizes sizes(random);
        const Maps maps(random, random_posed_motion(random, sizes.moving), sizes);
        for (int i = 0; i < pairs_a_motion; ++i) {
            const auto moving = random_corners(random, sizes.moving);
            const auto fixed = random_corners(random, sizes.fixed);
            const std::vector<DoublePoint> ends{moving[0], moving[1], fixed[0], fixed[1]};
            compare_in_both(ratios, random, maps, [&]<class S>(const motion::ControlMaps<S>& m) {
                return edge_polynomials<S>(m, ends, maps.accuracy);
            });
        }
    }
    ratios.expect_sound(shows_something);
}

TEST(ErrorScale, StretchIsOneForATranslation) {
    RationalMotion<DoubleDouble> straight;
    straight.end_cosine = 1.0;
    straight.displacement = {1.0, 2.0, 3.0};
    straight.orientation = algebra::identity_matrix<DoubleDouble>();
    const auto scale = error_scale(motion::double_maps(straight), 4, 5);
    EXPECT_EQ(scale.norm_bound, 1);
    EXPECT_GE(scale.length, 4 + 3 + 5);
    EXPECT_LT(scale.length, 2 * (4 + 3 + 5));
}

TEST(ErrorScale, GrowsWithTheBodiesAndTheMotion) {
    Random random(724);
    const auto maps = motion::double_maps(random_posed_motion(random, 1).made);
    const double one = error_scale(maps, 1, 1).length;
    EXPECT_GT(error_scale(maps, 2, 1).length, one);
    EXPECT_GT(error_scale(maps, 1, 2).length, one);
}

} // namespace
} // namespace chasles::elementary
