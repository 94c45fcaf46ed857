// Every coefficient that the elementary detections make in doubles is as close to the exact one as they say, for the
// motion between the given poses without any rounding, on any part of it.
#include "chasles/elementary/error_scale.h"

#include "chasles/elementary/edge_edge.h"
#include "tests/support/rational_motions.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using namespace test;
using RationalPose = motion::GeneralPose<Rational>;
using DoublePoint = Vector3<double>;

/// Two poses in doubles, a part of tau, and a body's reach.
struct Setting {
    motion::GeneralPose<DoubleDouble> start;
    motion::GeneralPose<DoubleDouble> goal;
    double from = 0;
    double to = 1;
    double moving_reach = 1;
    double fixed_reach = 1;
};

motion::Quaternion<DoubleDouble> random_turn(Random& random, double angle) {
    const DoublePoint axis = random.vector(1);
    const double length = std::sqrt(dot(axis, axis));
    const double sine = std::sin(angle / 2) / length;
    return {std::cos(angle / 2), {axis.x * sine, axis.y * sine, axis.z * sine}};
}

motion::GeneralPose<DoubleDouble> exact_pose(const DoublePoint& translation,
                                             const motion::Quaternion<DoubleDouble>& q) {
    return {{translation.x, translation.y, translation.z}, q};
}

/// Turns from 1e-16 to 3; sizes from 1e-6 to 1e6; bodies and shifts of unlike size; far from the origin.
Setting random_setting(Random& random) {
    Setting setting;
    const double size = std::abs(random.scaled(-6, 6));
    setting.moving_reach = size;
    setting.fixed_reach = random.chance(0.5) ? size : size * std::abs(random.scaled(-6, 2));
    const double angle = random.chance(0.3) ? std::abs(random.scaled(-16, -3)) : random.uniform(0, 3);
    const DoublePoint away = random.vector(random.chance(0.3) ? 1e4 * size : size);
    const DoublePoint shift = random.vector(size * std::abs(random.scaled(-9, 1)));
    setting.start =
        exact_pose(away, random.chance(0.5) ? random_turn(random, 1) : motion::Quaternion<DoubleDouble>{1.0, {}});
    const auto turn = random_turn(random, angle) * setting.start.rotation;
    setting.goal = exact_pose(away + shift, {turn.w.high(), {turn.v.x.high(), turn.v.y.high(), turn.v.z.high()}});
    if (random.chance(0.5)) {
        const double width = std::ldexp(1.0, -random.integer(1, 12));
        setting.from = width * random.integer(0, 1);
        setting.to = setting.from + width;
    }
    return setting;
}

/// The maps as a query has them, beside those of the exact motion.
struct Maps {
    motion::ControlMaps<double> in_doubles;
    motion::ControlMaps<Rational> exactly;
    Accuracy accuracy;

    explicit Maps(const Setting& s)
        : in_doubles(motion::rounded(motion::control_maps(motion::screw_between(s.start, s.goal)))),
          exactly(motion::control_maps(motion::screw_between(in_rationals(s.start), in_rationals(s.goal)))),
          accuracy{error_scale(in_doubles, s.moving_reach, s.fixed_reach), {}} {
        if (s.from > 0 || s.to < 1) {
            in_doubles = restricted(in_doubles, s.from, s.to);
            exactly = restricted(exactly, Rational(s.from), Rational(s.to));
        }
    }

private:
    static RationalPose in_rationals(const motion::GeneralPose<DoubleDouble>& pose) {
        return {test::exact(pose.translation), {test::exact(pose.rotation.w), test::exact(pose.rotation.v)}};
    }
};

/// The largest error over its bound, of the coefficients and of those of a part, as first_feasible restricts them.
class Ratios {
public:
    explicit Ratios(Random& random) : random_(random) {}

    void compare(const Bounded<3, double>& p, const Bernstein<3, Rational>& truth,
                 const Bernstein<3, Rational>& weight) {
        note(p.polynomial, truth, p.error, weight);
        const double from = random_.uniform(0, 1);
        const double to = random_.uniform(from, 1);
        note(algebra::restricted(p.polynomial, from, to), algebra::restricted(truth, Rational(from), Rational(to)),
             p.error, algebra::restricted(weight, Rational(from), Rational(to)));
    }

    [[nodiscard]] double largest() const { return largest_; }

private:
    void note(const Bernstein<3, double>& p, const Bernstein<3, Rational>& truth, double error,
              const Bernstein<3, Rational>& weight) {
        for (int i = 0; i <= 3; ++i) {
            const Rational off = test::magnitude(Rational(p[i]) - truth[i]);
            if (off != 0)
                largest_ = std::max(largest_, static_cast<double>(Rational(off / (Rational(error) * weight[i]))));
        }
    }

    Random& random_;
    double largest_ = 0;
};

/// Corners of a triangle: any, a sliver, or tiny for its distance.
std::vector<DoublePoint> random_corners(Random& random, double reach) {
    const DoublePoint a = random.vector(reach / 2);
    const DoublePoint b = a + random.vector(reach / 4 * (random.chance(0.3) ? 1e-5 : 1));
    const DoublePoint beyond = scale(b - a, 1.5) + random.vector(reach * 1e-7);
    const DoublePoint c = a + (random.chance(0.3) ? beyond : random.vector(reach / 4));
    return {a, b, c};
}

std::vector<Vector3<Rational>> in_rationals(const std::vector<DoublePoint>& points) {
    std::vector<Vector3<Rational>> result;
    for (const DoublePoint& p : points)
        result.push_back(test::exact(p));
    return result;
}

/// The half-spaces of the face, and its plane.
template <class S>
std::vector<Bounded<3, S>> face_polynomials(const motion::ControlMaps<S>& maps,
                                            const Vector3<Bernstein<3, S>>& position,
                                            const std::vector<Vector3<S>>& corners, const Accuracy& accuracy) {
    const FaceShape<S> face = face_shape<S>(corners, {});
    const VertexPath<S> path{position, maps.weight};
    const S unit(error_unit<S> * accuracy.scale.length);
    std::vector<Bounded<3, S>> result{
        {elementary::detail::height(path, face.normal, corners[0]), S(unit * face.size + face.deviation)}};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3<S> edge = corners[(i + 1) % 3] - corners[i];
        result.push_back({elementary::detail::height(path, cross(face.normal, edge), corners[i]),
                          S(unit * face.size * norm1(edge))});
    }
    return result;
}

template <class S>
std::vector<Bounded<3, S>> edge_polynomials(const motion::ControlMaps<S>& maps, const std::vector<Vector3<S>>& ends,
                                            const Accuracy& accuracy) {
    const EdgePath<S> moving = edge_path(maps, ends[0], ends[1]);
    const FixedEdge<S> fixed{ends[2], ends[3] - ends[2]};
    const elementary::detail::EdgePair<S> pair(maps, moving, fixed, accuracy);
    std::vector<Bounded<3, S>> result{pair.volume()};
    std::vector<Constraint<3, S>> constraints;
    for (int i = 0; i < 3; ++i) {
        result.push_back({pair.crossing()[i], pair.crossing_error()});
        pair.add_inside(i, 0, constraints);
    }
    pair.add_overlaps(constraints);
    for (const auto& constraint : constraints) {
        result.push_back(constraint.first);
        result.push_back(constraint.second);
    }
    return result;
}

void compare(Ratios& ratios, const std::vector<Bounded<3, double>>& in_doubles,
             const std::vector<Bounded<3, Rational>>& exactly, const Bernstein<3, Rational>& weight) {
    ASSERT_EQ(in_doubles.size(), exactly.size());
    for (std::size_t i = 0; i < exactly.size(); ++i)
        ratios.compare(in_doubles[i], exactly[i].polynomial, weight);
}

constexpr int trials = 400;

TEST(ErrorScale, BoundsEveryCoefficientOfVertexAndFace) {
    Random random(721);
    Ratios ratios(random);
    for (int trial = 0; trial < trials; ++trial) {
        const Setting setting = random_setting(random);
        const Maps maps(setting);
        const DoublePoint vertex = random.vector(setting.moving_reach);
        const auto corners = random_corners(random, setting.fixed_reach);
        compare(ratios,
                face_polynomials(maps.in_doubles, maps.in_doubles.turn * vertex + maps.in_doubles.shift, corners,
                                 maps.accuracy),
                face_polynomials(maps.exactly, maps.exactly.turn * test::exact(vertex) + maps.exactly.shift,
                                 in_rationals(corners), maps.accuracy),
                maps.exactly.weight);
    }
    std::cout << "largest error over bound " << ratios.largest() << "\n";
    EXPECT_LT(ratios.largest(), 1);
    EXPECT_GT(ratios.largest(), 1e-3) << "the bound is so wide that this test shows nothing";
}

TEST(ErrorScale, BoundsEveryCoefficientOfFaceAndVertex) {
    Random random(722);
    Ratios ratios(random);
    for (int trial = 0; trial < trials; ++trial) {
        const Setting setting = random_setting(random);
        const Maps maps(setting);
        const DoublePoint vertex = random.vector(setting.fixed_reach);
        const auto corners = random_corners(random, setting.moving_reach);
        compare(ratios,
                face_polynomials(maps.in_doubles,
                                 maps.in_doubles.turn.transposed() * vertex - maps.in_doubles.inverse_shift, corners,
                                 maps.accuracy),
                face_polynomials(maps.exactly,
                                 maps.exactly.turn.transposed() * test::exact(vertex) - maps.exactly.inverse_shift,
                                 in_rationals(corners), maps.accuracy),
                maps.exactly.weight);
    }
    std::cout << "largest error over bound " << ratios.largest() << "\n";
    EXPECT_LT(ratios.largest(), 1);
    EXPECT_GT(ratios.largest(), 1e-3) << "the bound is so wide that this test shows nothing";
}

TEST(ErrorScale, BoundsEveryCoefficientOfTwoEdges) {
    Random random(723);
    Ratios ratios(random);
    for (int trial = 0; trial < trials; ++trial) {
        const Setting setting = random_setting(random);
        const Maps maps(setting);
        const auto moving = random_corners(random, setting.moving_reach);
        const auto fixed = random_corners(random, setting.fixed_reach);
        const std::vector<DoublePoint> ends{moving[0], moving[1], fixed[0], fixed[1]};
        compare(ratios, edge_polynomials(maps.in_doubles, ends, maps.accuracy),
                edge_polynomials(maps.exactly, in_rationals(ends), maps.accuracy), maps.exactly.weight);
    }
    std::cout << "largest error over bound " << ratios.largest() << "\n";
    EXPECT_LT(ratios.largest(), 1);
    EXPECT_GT(ratios.largest(), 1e-3) << "the bound is so wide that this test shows nothing";
}

TEST(ErrorScale, StretchIsOneForATranslation) {
    RationalMotion<DoubleDouble> straight;
    straight.end_cosine = 1.0;
    straight.displacement = {1.0, 2.0, 3.0};
    straight.orientation = algebra::identity_matrix<DoubleDouble>();
    const auto scale = error_scale(motion::rounded(motion::control_maps(straight)), 4, 5);
    EXPECT_EQ(scale.stretch, 1);
    EXPECT_GE(scale.length, 4 + 3 + 5);
    EXPECT_LT(scale.length, 2 * (4 + 3 + 5));
}

TEST(ErrorScale, GrowsWithTheBodiesAndTheMotion) {
    Random random(724);
    const Setting setting = random_setting(random);
    const Maps maps(setting);
    const double one = error_scale(maps.in_doubles, 1, 1).length;
    EXPECT_GT(error_scale(maps.in_doubles, 2, 1).length, one);
    EXPECT_GT(error_scale(maps.in_doubles, 1, 2).length, one);
}

} // namespace
} // namespace chasles::elementary
