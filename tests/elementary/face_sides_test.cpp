// The side of a moving or fixed face's plane on which points stay, compared with exact heights for the same motion.
#include "chasles/elementary/face_sides.h"

#include "tests/support/elementary_cases.h"
#include "tests/support/error_ratios.h"
#include "tests/support/posed_motions.h"

namespace chasles::elementary {
namespace {

using namespace test;
using DoublePoint = Vector3<double>;

const Points unit_triangle{point(0, 0, 0), point(1, 0, 0), point(0, 1, 0)};

RationalMotion<Rational> straight(const Point& way) {
    RationalMotion<Rational> motion;
    motion.end_cosine = 1;
    motion.orientation = algebra::identity_matrix<Rational>();
    motion.displacement = way;
    return motion;
}

/// The side of a point that moves by `way` along z over the fixed unit triangle.
int side_on_the_way(const Point& start, const Rational& way) {
    Stage<double> stage(straight(point(0, 0, way)), {start}, unit_triangle);
    const auto corners = corners_in<double>(unit_triangle);
    return plane_of_fixed_face(stage.maps, face_shape<double>(corners, {}), stage.accuracy.scale)
        .side_of(rounded_to<double>(start));
}

TEST(FaceSides, APointThatStaysAboveOrBelowIsToldFromOneThatMayMeetThePlane) {
    EXPECT_EQ(side_on_the_way(point(5, 5, 1), 3), 1);
    EXPECT_EQ(side_on_the_way(point(5, 5, -1), -3), -1);
    EXPECT_EQ(side_on_the_way(point(5, 5, 1), -3), 0) << "it passes";
    EXPECT_EQ(side_on_the_way(point(5, 5, 1), -1), 0) << "it arrives";
    EXPECT_EQ(side_on_the_way(point(5, 5, 0), 1), 0) << "it leaves";
    EXPECT_EQ(side_on_the_way(point(5, 5, 0), 0), 0) << "it stays in the plane";
}

TEST(FaceSides, ACornerOffAWarpedFaceIsWithinItsBand) {
    const Points warped{point(0, 0, 0), point(1, 0, 0), point(1, 1, ratio(1, 100000)), point(0, 1, 0)};
    Stage<double> stage(straight(point(0, 0, 0)), warped, warped);
    const auto corners = corners_in<double>(warped);
    const FaceShape<double> face = face_shape<double>(corners, {});
    const auto fixed = plane_of_fixed_face(stage.maps, face, stage.accuracy.scale);
    const auto moving = plane_of_moving_face(stage.maps, face, stage.accuracy.scale);
    for (const auto& corner : corners) {
        EXPECT_EQ(fixed.side_of(corner), 0);
        EXPECT_EQ(moving.side_of(corner), 0);
    }
}

/// W times the height of a point over a plane, with the point in the frame of the face.
Bernstein<3, Rational> exact_height(const Vector3<Bernstein<3, Rational>>& position,
                                    const Bernstein<3, Rational>& weight, const Points& corners) {
    const Point normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    return dot(position, normal) - weight * dot(normal, corners[0]);
}

/// Whether the polynomial has this sign at many samples.
bool has_sign(const Bernstein<3, Rational>& p, int sign) {
    for (int i = 0; i <= 16; ++i)
        if (value_at(p, ratio(i, 16)) * sign <= 0)
            return false;
    return true;
}

/// A point of the face's body at the start, in the frame of the other body.
DoublePoint at_start(const motion::ControlMaps<double>& maps, const DoublePoint& p, bool body_moves) {
    const auto path =
        body_moves ? maps.rotation * p + maps.translation : maps.rotation.transposed() * p - maps.inverse_translation;
    return {path.x[0], path.y[0], path.z[0]};
}

/// Random faces of all sizes and random points, many of them close to the plane.
TEST(FaceSides, ASideThatIsToldIsTheExactOne) {
    Random random(761);
    int decided = 0, open = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const double reach = std::abs(random.scaled(-3, 3));
        const PosedMotion posed = random_posed_motion(random, reach);
        const auto exact_maps = motion::control_maps(posed.exactly);
        const auto maps = motion::double_maps(posed.made);
        std::vector<DoublePoint> corners;
        for (int i = 0; i < 3; ++i)
            corners.push_back(random.vector(reach));
        const bool face_moves = random.chance(0.5);
        const DoublePoint beside = corners[0] + scale(random.vector(reach), random.scaled(-16, 0));
        const DoublePoint vertex = random.chance(0.5) ? random.vector(4 * reach) : at_start(maps, beside, face_moves);
        const double far = std::max(4 * reach, norm1(vertex));
        const ErrorScale scale =
            error_scale(maps, std::max(far, posed.made.reference_extent) + motion::rounding_extent(posed.made), far);
        const FaceShape<double> face = face_shape<double>(corners, {});
        const double width = std::ldexp(1.0, -random.integer(0, 12));
        const double from = random.chance(0.5) ? 0 : 0.25 * width * random.integer(0, int(4 / width) - 4);
        const algebra::Restriction<3, double> part(from, from + width);
        const auto plane =
            face_moves ? plane_of_moving_face(maps, face, scale) : plane_of_fixed_face(maps, face, scale);
        const int side = plane.side_of(vertex, part, part(plane.band));
        Points exactly;
        for (const DoublePoint& corner : corners)
            exactly.push_back(exact(corner));
        const auto position = face_moves
                                  ? exact_maps.rotation.transposed() * exact(vertex) - exact_maps.inverse_translation
                                  : exact_maps.rotation * exact(vertex) + exact_maps.translation;
        (side == 0 ? open : decided) += 1;
        if (side != 0) {
            const auto height = exact_height(position, exact_maps.weight, exactly);
            EXPECT_TRUE(has_sign(restricted(height, Rational(from), Rational(from + width)), side));
        }
    }
    std::cout << decided << " decided, " << open << " left open\n";
    EXPECT_GT(decided, 500);
    EXPECT_GT(open, 500);
}

} // namespace
} // namespace chasles::elementary
