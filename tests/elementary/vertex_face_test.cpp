// Vertex against face: the cases of the paper (section 3.2), each with a known answer.
#include "chasles/elementary/vertex_face.h"

#include "tests/support/elementary_cases.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using namespace test;

/// The right triangle with legs of 4 in the plane z = 0.
const Face triangle{{point(0, 0, 0), point(4, 0, 0), point(0, 4, 0)}};
/// A face in the plane x = 0 at radius 1 to 5 from the third axis. A rotation about this axis moves vertices into it.
const Face wall{{point(0, 1, -2), point(0, 5, -2), point(0, 5, 2), point(0, 1, 2)}};

TEST(VertexFace, Section321NoMotion) {
    expect_contact(VertexFaceCase{no_motion(), point(1, 1, 0), triangle}, 0);
    expect_clear(VertexFaceCase{no_motion(), point(1, 1, 1), triangle});
    expect_clear(VertexFaceCase{no_motion(), point(5, 5, 0), triangle});
}

TEST(VertexFace, Section321NoMotionOnTheRim) {
    expect_contact(VertexFaceCase{no_motion(), point(2, 0, 0), triangle}, 0);
    expect_contact(VertexFaceCase{no_motion(), point(0, 4, 0), triangle}, 0);
}

TEST(VertexFace, Section322Translation) {
    expect_contact(VertexFaceCase{translation({0, 0, -4}), point(1, 1, 1), triangle}, ratio(1, 4));
    expect_contact(VertexFaceCase{translation({2, 1, 3}), point(0, 0, -1), triangle}, ratio(1, 3));
    expect_clear(VertexFaceCase{translation({0, 0, -4}), point(3, 3, 1), triangle});
    expect_clear(VertexFaceCase{translation({0, 0, -4}), point(1, 1, 5), triangle});
    expect_clear(VertexFaceCase{translation({0, 0, 4}), point(1, 1, 1), triangle});
}

TEST(VertexFace, Section322TranslationHitsEachSideOfTheFace) {
    expect_contact(VertexFaceCase{translation({0, 0, 4}), point(1, 1, -1), triangle}, ratio(1, 4));
    const Face flipped{{point(0, 4, 0), point(4, 0, 0), point(0, 0, 0)}};
    expect_contact(VertexFaceCase{translation({0, 0, -4}), point(1, 1, 1), flipped}, ratio(1, 4));
    expect_clear(VertexFaceCase{translation({0, 0, -4}), point(3, 3, 1), flipped});
}

TEST(VertexFace, Section322TranslationJustBesideEachEdge) {
    const Rational off(1e-12); // a tenth of a trillionth of the scene
    for (const Point& inside : {point(2, off, 1), point(off, 2, 1), point(2 - off, 2 - off, 1)})
        expect_contact(VertexFaceCase{translation({0, 0, -4}), inside, triangle}, ratio(1, 4));
    for (const Point& outside : {point(2, -off, 1), point(-off, 2, 1), point(2 + off, 2 + off, 1)})
        expect_clear(VertexFaceCase{translation({0, 0, -4}), outside, triangle});
}

TEST(VertexFace, Section322TranslationFig4PlanarProblem) {
    expect_contact(VertexFaceCase{translation({2, 0, 0}), point(-1, 1, 0), triangle}, ratio(1, 2));
    expect_contact(VertexFaceCase{translation({-4, -4, 0}), point(3, 3, 0), triangle}, ratio(1, 4));
    expect_clear(VertexFaceCase{translation({2, 0, 0}), point(-1, 1, 1), triangle});
    expect_clear(VertexFaceCase{translation({0, 8, 0}), point(-1, -2, 0), triangle});
    expect_clear(VertexFaceCase{translation({2, 0, 0}), point(-3, 1, 0), triangle});
}

TEST(VertexFace, Section323Rotation) {
    // A quarter turn moves (3, 0, 0) onto the wall. A turn with half-angle tangent 2 moves it through the wall at
    // tau = 1/2.
    expect_contact(VertexFaceCase{rotation(1), point(3, 0, 1), wall}, 1);
    expect_contact(VertexFaceCase{rotation(2), point(3, 0, 1), wall}, ratio(1, 2));
    expect_contact(VertexFaceCase{rotation(-2), point(-3, 0, 1), wall}, ratio(1, 2));
    expect_clear(VertexFaceCase{rotation(2), point(6, 0, 1), wall});
    expect_clear(VertexFaceCase{rotation(2), point(3, 0, 3), wall});
    expect_clear(VertexFaceCase{rotation(ratio(1, 2)), point(3, 0, 1), wall});
}

TEST(VertexFace, Section323RotationInTheFacesPlane) {
    // About the normal: (4, -3, 0) enters through the leg y = 0 at (5, 0, 0), which is beyond a leg of 4.
    const Face longer{{point(0, 0, 0), point(6, 0, 0), point(0, 6, 0)}};
    expect_contact(VertexFaceCase{rotation(1), point(4, -3, 0), longer}, ratio(1, 3));
    expect_clear(VertexFaceCase{rotation(ratio(1, 3)), point(-4, -3, 0), longer});
    expect_clear(VertexFaceCase{rotation(1), point(4, -3, 1), longer});
}

TEST(VertexFace, Section323RotationGrazes) {
    // About an axis along x at height 1, a vertex at distance 1 touches the plane from above and leaves it.
    const PlainScrew rolling{point(0, 1, 1), point(1, 0, 0), {}};
    expect_grazing(VertexFaceCase{rolling, rolling.start_of(point(1, 1, 0), ratio(1, 2)), triangle}, ratio(1, 2));
    const PlainScrew higher{point(0, 1, 1 + ratio(1, 1000000)), point(1, 0, 0), {}};
    expect_clear(VertexFaceCase{higher, rolling.start_of(point(1, 1, 0), ratio(1, 2)) + point(0, 0, ratio(1, 1000000)),
                                triangle});
}

TEST(VertexFace, Section324General) {
    expect_contact(VertexFaceCase{screw(2, 3), point(3, 0, -1), wall}, ratio(1, 2));
    expect_clear(VertexFaceCase{screw(2, 6), point(3, 0, 0), wall});
    const PlainScrew oblique{point(1, 2, 5), point(ratio(1, 2), ratio(-1, 3), ratio(1, 4)), {3, -2, ratio(3, 2)}};
    const VertexFaceCase built{oblique, oblique.start_of(point(1, 1, 0), ratio(1, 3)), triangle};
    expect_contact(built, ratio(1, 3));
}

TEST(VertexFace, MovingFaceAgainstFixedVertex) {
    expect_contact(FaceVertexCase{translation({0, 0, -4}), triangle, point(1, 1, -1)}, ratio(1, 4));
    expect_contact(FaceVertexCase{rotation(2), wall, point(-3, 0, 1)}, ratio(1, 2));
    expect_contact(FaceVertexCase{screw(2, 3), wall, point(-3, 0, 2)}, ratio(1, 2));
    expect_clear(FaceVertexCase{screw(2, 6), wall, point(-3, 0, 0)});
    const PlainScrew oblique{point(1, 2, 5), point(ratio(1, 2), ratio(-1, 3), ratio(1, 4)), {3, -2, ratio(3, 2)}};
    expect_contact(FaceVertexCase{oblique, triangle, oblique.position(point(1, 1, 0), ratio(1, 3))}, ratio(1, 3));
}

TEST(VertexFace, ContactIsCertainAwayFromTheRim) {
    const VertexFaceCase middle{translation({0, 0, -4}), point(1, 1, 1), triangle};
    EXPECT_TRUE(middle.ask<double>()->certain);
    EXPECT_TRUE(middle.ask<DoubleDouble>()->certain);
    const VertexFaceCase rim{translation({0, 0, -4}), point(1, 0, 1), triangle};
    EXPECT_FALSE(rim.ask<double>()->certain) << "rounding could move it either way";
}

TEST(VertexFace, Section42ConvexPolygonIsTestedByItsEdges) {
    const Face pentagon{{point(0, 0, 0), point(4, 0, 0), point(5, 3, 0), point(2, 5, 0), point(-1, 3, 0)}};
    for (const Point& inside : {point(2, 2, 1), point(4, 3, 1), point(0, 3, 1), point(2, ratio(49, 10), 1)})
        expect_contact(VertexFaceCase{translation({0, 0, -4}), inside, pentagon}, ratio(1, 4));
    for (const Point& outside : {point(2, -1, 1), point(5, 1, 1), point(4, ratio(9, 2), 1), point(-1, 4, 1)})
        expect_clear(VertexFaceCase{translation({0, 0, -4}), outside, pentagon});
}

/// An L of two bars of width 1: the notch lies at x > 1 and y > 1.
Face bent_bar() {
    return {{point(0, 0, 0), point(3, 0, 0), point(3, 1, 0), point(1, 1, 0), point(1, 3, 0), point(0, 3, 0)},
            {0, 1, 2, 0, 2, 3, 0, 3, 5, 3, 4, 5}};
}

TEST(VertexFace, Section42NonConvexPolygonLeavesItsNotchOpen) {
    for (const Point& inside : {point(2, ratio(1, 2), 1), point(ratio(1, 2), 2, 1), point(ratio(1, 2), ratio(1, 4), 1)})
        expect_contact(VertexFaceCase{translation({0, 0, -4}), inside, bent_bar()}, ratio(1, 4));
    for (const Point& outside : {point(2, 2, 1), point(ratio(5, 4), ratio(5, 4), 1), point(4, ratio(1, 2), 1)})
        expect_clear(VertexFaceCase{translation({0, 0, -4}), outside, bent_bar()});
}

TEST(VertexFace, Section42InnerDiagonalsAreInside) {
    // (1, 1/3, 0) lies on the diagonal from corner 0 to corner 2, (1/2, 1/2, 0) on that from corner 0 to corner 3.
    expect_contact(VertexFaceCase{translation({0, 0, -4}), point(1, ratio(1, 3), 1), bent_bar()}, ratio(1, 4));
    expect_contact(VertexFaceCase{translation({0, 0, -4}), point(ratio(1, 2), ratio(1, 2), 1), bent_bar()},
                   ratio(1, 4));
}

TEST(VertexFace, Section42FirstTriangleMetDecides) {
    // The vertex moves within the plane from the far bar across the notch. It first touches the edge of the bar at y
    // = 1.
    expect_contact(VertexFaceCase{translation({0, -4, 0}), point(2, 3, 0), bent_bar()}, ratio(1, 2));
    expect_contact(VertexFaceCase{translation({-4, 0, 0}), point(3, 2, 0), bent_bar()}, ratio(1, 2));
}

TEST(VertexFace, CountsItsTests) {
    Workspace<double> workspace;
    Stage<double> stage(translation({0, 0, -4}).motion(), {point(1, 1, 1)}, triangle.corners);
    const auto corners = corners_in<double>(triangle.corners);
    const auto shape = face_shape<double>(corners, {});
    const auto path = stage.maps.rotation * Vector3<double>{1, 1, 1} + stage.maps.translation;
    (void)vertex_face<double>({path, stage.maps.weight}, shape, stage.accuracy, workspace);
    const auto above = stage.maps.rotation * Vector3<double>{1, 1, 9} + stage.maps.translation;
    (void)vertex_face<double>({above, stage.maps.weight}, shape, stage.accuracy, workspace);
    EXPECT_EQ(workspace.elementary_tests, 2u);
    EXPECT_EQ(workspace.root_brackets, 1u) << "one sign rejects the vertex that never touches the plane";
}

} // namespace
} // namespace chasles::elementary
