// Edge against edge: the cases of the paper (section 2.2), each with a known answer. The third axis is the axis of the
// motion. At tau = 1/2 the half-angle tangent 1 has turned by the angle with cosine 3/5 and sine 4/5.
#include "chasles/elementary/edge_edge.h"

#include "tests/support/elementary_cases.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using namespace test;

const Rational half = ratio(1, 2);
/// A segment on the x axis, and its image at tau = 1/2.
const Line spoke{point(1, 0, 0), point(2, 0, 0)};
Point on_turned_spoke(const Rational& radius, const Rational& z) {
    return point(radius * ratio(3, 5), radius * ratio(4, 5), z);
}

TEST(EdgeEdge, Section221NoMotion) {
    const Line along_y{point(0, -1, 0), point(0, 1, 0)};
    expect_contact(EdgeEdgeCase{no_motion(), along_y, {point(-1, 0, 0), point(1, 0, 0)}}, 0);
    expect_contact(EdgeEdgeCase{no_motion(), along_y, {point(0, 1, 0), point(1, 2, 3)}}, 0);
    expect_clear(EdgeEdgeCase{no_motion(), along_y, {point(-1, 0, 1), point(1, 0, 1)}});
    expect_clear(EdgeEdgeCase{no_motion(), along_y, {point(1, 0, 0), point(2, 0, 0)}});
}

TEST(EdgeEdge, Section221NoMotionParallelEdges) {
    const Line along_y{point(0, -1, 0), point(0, 1, 0)};
    expect_contact(EdgeEdgeCase{no_motion(), along_y, {point(0, 0, 0), point(0, 5, 0)}}, 0);
    expect_clear(EdgeEdgeCase{no_motion(), along_y, {point(0, 2, 0), point(0, 5, 0)}});
    expect_clear(EdgeEdgeCase{no_motion(), along_y, {point(1, 0, 0), point(1, 5, 0)}});
}

TEST(EdgeEdge, Section222TranslationFig1) {
    const Rational off(1e-12); // a tenth of a trillionth of the scene
    const Line falling{point(0, -1, 1), point(0, 1, 1)};
    const auto met = [&](const Line& fixed) { return EdgeEdgeCase{translation({0, 0, -4}), falling, fixed}; };
    expect_contact(met({point(-1, 0, 0), point(1, 0, 0)}), ratio(1, 4));
    expect_contact(met({point(0, 0, 0), point(2, 0, 0)}), ratio(1, 4));
    expect_contact(met({point(-1, 1, 0), point(1, 1, 0)}), ratio(1, 4));
    expect_clear(met({point(off, 0, 0), point(2, 0, 0)}));
    expect_clear(met({point(-1, 1 + off, 0), point(1, 1 + off, 0)}));
    expect_clear(met({point(-1, -1 - off, 0), point(1, -1 - off, 0)}));
    expect_clear(met({point(-2, 0, 0), point(-off, 0, 0)}));
    expect_clear(met({point(-1, 0, -4), point(1, 0, -4)}));
}

TEST(EdgeEdge, Section222TranslationParallelEdges) {
    const auto met = [&](const Line& fixed) {
        return EdgeEdgeCase{translation({0, 0, -4}), {point(0, 0, 1), point(2, 0, 1)}, fixed};
    };
    expect_contact(met({point(1, 0, 0), point(3, 0, 0)}), ratio(1, 4));
    expect_contact(met({point(3, 0, 0), point(1, 0, 0)}), ratio(1, 4));
    expect_clear(met({point(1, 1, 0), point(3, 1, 0)}));
    expect_clear(met({point(3, 0, 0), point(4, 0, 0)}));
}

TEST(EdgeEdge, Section222TranslationParallelProjections) {
    const Line leaning{point(0, 0, 1), point(2, 0, 3)};
    expect_contact(EdgeEdgeCase{translation({0, 0, -4}), leaning, {point(-1, 0, 0), point(1, 0, 0)}}, ratio(1, 4));
    expect_clear(EdgeEdgeCase{translation({0, 0, -4}), leaning, {point(-1, 1, 0), point(1, 1, 0)}});
    expect_clear(EdgeEdgeCase{translation({0, 0, -4}), leaning, {point(-2, 0, 0), point(-1, 0, 0)}});
}

TEST(EdgeEdge, Section222TranslationOneProjectionNull) {
    const Line upright{point(0, 0, 1), point(0, 0, 3)};
    expect_contact(EdgeEdgeCase{translation({0, 0, -4}), upright, {point(-1, 0, 0), point(1, 0, 0)}}, ratio(1, 4));
    expect_clear(EdgeEdgeCase{translation({0, 0, -4}), upright, {point(1, 0, 0), point(2, 0, 0)}});
    expect_clear(EdgeEdgeCase{translation({0, 0, -4}), upright, {point(-1, 1, 0), point(1, 1, 0)}});
    const Line falling{point(-1, 0, 1), point(1, 0, 1)};
    expect_contact(EdgeEdgeCase{translation({0, 0, -4}), falling, {point(0, 0, -2), point(0, 0, 0)}}, ratio(1, 4));
}

TEST(EdgeEdge, Section222TranslationBothProjectionsNull) {
    const Line upright{point(0, 0, 2), point(0, 0, 3)};
    expect_contact(EdgeEdgeCase{translation({0, 0, -4}), upright, {point(0, 0, 0), point(0, 0, 1)}}, ratio(1, 4));
    expect_clear(EdgeEdgeCase{translation({0, 0, -4}), upright, {point(1, 0, 0), point(1, 0, 1)}});
    expect_clear(EdgeEdgeCase{translation({0, 0, 4}), upright, {point(0, 0, 0), point(0, 0, 1)}});
}

TEST(EdgeEdge, Section223RotationFig2BothEdgesInNormalPlanes) {
    const Line across{on_turned_spoke(ratio(3, 2), 0), point(-1, 5, 0)};
    expect_contact(EdgeEdgeCase{rotation(1), spoke, across}, half);
    expect_clear(EdgeEdgeCase{rotation(1), spoke, {point(ratio(9, 10), ratio(6, 5), 1), point(-1, 5, 1)}});
    expect_clear(EdgeEdgeCase{rotation(1), spoke, {on_turned_spoke(3, 0), point(-1, 5, 0)}});
}

TEST(EdgeEdge, Section223RotationFig3OneEdgeInANormalPlane) {
    const auto post = [](const Rational& radius) {
        return Line{on_turned_spoke(radius, -1), on_turned_spoke(radius, 1)};
    };
    expect_contact(EdgeEdgeCase{rotation(1), spoke, post(ratio(3, 2))}, half);
    expect_contact(EdgeEdgeCase{rotation(1), spoke, post(1)}, half);
    expect_clear(EdgeEdgeCase{rotation(1), spoke, post(ratio(5, 2))});
    expect_clear(EdgeEdgeCase{rotation(ratio(1, 3)), spoke, post(ratio(3, 2))});
    const Line turning_post{point(1, 0, -1), point(1, 0, 1)};
    expect_contact(EdgeEdgeCase{rotation(1), turning_post, {on_turned_spoke(half, 0), on_turned_spoke(2, 0)}}, half);
}

TEST(EdgeEdge, Section223RotationNoEdgeInANormalPlane) {
    const Line rising{point(1, 0, -1), point(3, 0, 1)};
    const Point met = on_turned_spoke(2, 0);
    expect_contact(EdgeEdgeCase{rotation(1), rising, {met + point(1, 0, 1), met - point(1, 0, 1)}}, half);
    expect_contact(EdgeEdgeCase{rotation(1), rising, {met - point(0, 0, 1), met + point(0, 0, 1)}}, half);
    expect_clear(EdgeEdgeCase{rotation(1), rising, {met + point(1, 0, 1), met + point(3, 0, 3)}});
}

TEST(EdgeEdge, Section223RotationParallelToTheAxis) {
    const Line post{point(1, 0, 0), point(1, 0, 2)};
    expect_grazing(EdgeEdgeCase{rotation(1), post, {on_turned_spoke(1, 1), on_turned_spoke(1, 4)}}, half);
    expect_clear(EdgeEdgeCase{rotation(1), post, {on_turned_spoke(1, 3), on_turned_spoke(1, 4)}});
    expect_clear(EdgeEdgeCase{rotation(1), post, {on_turned_spoke(2, 1), on_turned_spoke(2, 4)}});
}

TEST(EdgeEdge, Section223RotationPlanarProblem) {
    // In one normal plane, and on a cone through one point of the axis, the reciprocal product vanishes identically.
    expect_contact(EdgeEdgeCase{rotation(1), spoke, {on_turned_spoke(ratio(3, 2), 0), on_turned_spoke(3, 0)}}, half);
    expect_clear(EdgeEdgeCase{rotation(1), spoke, {on_turned_spoke(ratio(5, 2), 0), on_turned_spoke(3, 0)}});
    const Line on_cone{point(1, 0, 1), point(2, 0, 2)};
    expect_contact(
        EdgeEdgeCase{rotation(1), on_cone, {on_turned_spoke(ratio(3, 2), ratio(3, 2)), on_turned_spoke(3, 3)}}, half);
    expect_clear(EdgeEdgeCase{rotation(1), on_cone, {on_turned_spoke(ratio(3, 2), 3), on_turned_spoke(3, 6)}});
}

TEST(EdgeEdge, Section224GeneralBothEdgesInNormalPlanes) {
    const Line low_spoke{point(1, 0, -1), point(2, 0, -1)};
    const Rational y = ratio(6, 5);
    expect_contact(EdgeEdgeCase{screw(1, 2), low_spoke, {point(-1, y, 0), point(2, y, 0)}}, half);
    expect_clear(EdgeEdgeCase{screw(1, 2), low_spoke, {point(1, y, 0), point(2, y, 0)}});
    expect_clear(EdgeEdgeCase{screw(1, 2), low_spoke, {point(-1, y, 2), point(2, y, 2)}});
}

TEST(EdgeEdge, Section224GeneralFixedEdgeLeavesTheNormalPlane) {
    const Line low_spoke{point(1, 0, -1), point(2, 0, -1)};
    const Point met = on_turned_spoke(ratio(3, 2), 0);
    expect_contact(EdgeEdgeCase{screw(1, 2), low_spoke, {met - point(0, 0, 2), met + point(0, 0, 2)}}, half);
    expect_contact(EdgeEdgeCase{screw(1, 2), low_spoke, {met - point(2, 1, 3), met + point(2, 1, 3)}}, half);
    expect_clear(EdgeEdgeCase{screw(1, 2), low_spoke, {met + point(0, 0, half), met + point(0, 0, 2)}});
}

TEST(EdgeEdge, Section224GeneralMovingEdgeLeavesTheNormalPlane) {
    const Line rising{point(1, 0, -2), point(3, 0, 0)};
    const Point met = on_turned_spoke(2, 0);
    expect_contact(EdgeEdgeCase{screw(1, 2), rising, {met - point(1, 0, 0), met + point(1, 0, 0)}}, half);
    expect_contact(EdgeEdgeCase{screw(1, 2), rising, {met - point(1, 2, 5), met + point(1, 2, 5)}}, half);
    expect_clear(EdgeEdgeCase{screw(1, 8), rising, {met - point(1, 0, 0), met + point(1, 0, 0)}});
}

TEST(EdgeEdge, ContactIsCertainAwayFromTheEnds) {
    const Line falling{point(0, -1, 1), point(0, 1, 1)};
    const EdgeEdgeCase middle{translation({0, 0, -4}), falling, {point(-1, 0, 0), point(1, 0, 0)}};
    EXPECT_TRUE(middle.ask<double>()->certain);
    EXPECT_TRUE(middle.ask<DoubleDouble>()->certain);
    const EdgeEdgeCase end{translation({0, 0, -4}), falling, {point(0, 0, 0), point(1, 0, 0)}};
    EXPECT_FALSE(end.ask<double>()->certain) << "rounding could move it either way";
}

TEST(EdgeEdge, EitherDirectionOfEitherEdgeGivesTheSameContact) {
    const Line low_spoke{point(1, 0, -1), point(2, 0, -1)};
    const Point met = on_turned_spoke(ratio(3, 2), 0);
    const Line across{met - point(2, 1, 3), met + point(2, 1, 3)};
    for (const Line& moving : {low_spoke, Line{low_spoke.to, low_spoke.from}})
        for (const Line& fixed : {across, Line{across.to, across.from}})
            expect_contact(EdgeEdgeCase{screw(1, 2), moving, fixed}, half);
}

} // namespace
} // namespace chasles::elementary
