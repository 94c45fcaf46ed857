// An edge passes strictly through a face: its ends are on opposite sides, and the segment crosses the face.
#include "chasles/elementary/edge_through_face.h"

#include "tests/support/elementary_cases.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using namespace test;

template <class S>
std::optional<Passage<S>> passage(const Line& edge, const Face& face, Ends ends = Ends::proven_opposite) {
    const auto corners = corners_in<S>(face.corners);
    const ErrorScale scale{.length = 4 * (reach(face.corners) + reach({edge.from, edge.to}))};
    return edge_through_face<S>({rounded_to<S>(edge.from), rounded_to<S>(edge.to)},
                                face_shape<S>(corners, face.triangles), scale, ends);
}

template <class S>
void expect_passage_in(const Line& edge, const Face& face, const Point& place) {
    const auto found = passage<S>(edge, face);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->certain);
    for (int i = 0; i < 3; ++i)
        EXPECT_LT(test::magnitude(test::exact(found->point[i]) - place[i]), Rational(1e-14));
}

void expect_passage(const Line& edge, const Face& face, const Point& place) {
    expect_passage_in<double>(edge, face, place);
    expect_passage_in<DoubleDouble>(edge, face, place);
    expect_passage_in<Rational>(edge, face, place);
}

void expect_none(const Line& edge, const Face& face) {
    EXPECT_FALSE(passage<double>(edge, face));
    EXPECT_FALSE(passage<DoubleDouble>(edge, face));
    EXPECT_FALSE(passage<Rational>(edge, face));
}

const Face triangle{{point(0, 0, 0), point(4, 0, 0), point(0, 4, 0)}};
const Face flipped{{point(0, 4, 0), point(4, 0, 0), point(0, 0, 0)}};

TEST(EdgeThroughFace, PassesInEitherDirectionOnEitherSide) {
    for (const Face& face : {triangle, flipped}) {
        expect_passage({point(1, 1, -1), point(1, 1, 3)}, face, point(1, 1, 0));
        expect_passage({point(1, 1, 3), point(1, 1, -1)}, face, point(1, 1, 0));
        expect_passage({point(0, 0, 1), point(2, 2, -1)}, face, point(1, 1, 0));
    }
}

TEST(EdgeThroughFace, BesideTheFaceIsNone) {
    for (const Face& face : {triangle, flipped})
        for (const Point& beside : {point(3, 3, 0), point(-1, 1, 0), point(1, -1, 0)})
            expect_none({beside - point(0, 0, 1), beside + point(0, 0, 1)}, face);
}

TEST(EdgeThroughFace, ShortOfThePlaneIsNone) {
    expect_none({point(1, 1, 1), point(1, 1, 3)}, triangle);
    expect_none({point(1, 1, -1), point(1, 1, -3)}, triangle);
}

TEST(EdgeThroughFace, EndOnThePlaneIsLeftToVertexAndFace) {
    expect_none({point(1, 1, 0), point(1, 1, 3)}, triangle);
    expect_none({point(1, 1, 0), point(2, 1, 0)}, triangle);
}

TEST(EdgeThroughFace, ThroughTheRimIsUncertain) {
    for (const Point& rim : {point(2, 0, 0), point(0, 0, 0), point(2, 2, 0)}) {
        const auto found = passage<double>({rim - point(0, 0, 1), rim + point(0, 0, 1)}, triangle);
        ASSERT_TRUE(found);
        EXPECT_FALSE(found->certain);
    }
}

TEST(EdgeThroughFace, NonConvexFaceLeavesItsNotchOpen) {
    const Face bent_bar{
        {point(0, 0, 0), point(3, 0, 0), point(3, 1, 0), point(1, 1, 0), point(1, 3, 0), point(0, 3, 0)},
        {0, 1, 2, 0, 2, 3, 0, 3, 5, 3, 4, 5}};
    expect_none({point(2, 2, -1), point(2, 2, 1)}, bent_bar);
    expect_passage({point(2, ratio(1, 4), -1), point(2, ratio(1, 4), 1)}, bent_bar, point(2, ratio(1, 4), 0));
    expect_passage({point(ratio(1, 4), 2, -1), point(ratio(1, 4), 2, 1)}, bent_bar, point(ratio(1, 4), 2, 0));
}

/// The orientation by signed volumes of tetrahedra, as determinants.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point p = a - d;
    const Point q = b - d;
    const Point r = c - d;
    return Rational(p.x * (q.y * r.z - q.z * r.y) - p.y * (q.x * r.z - q.z * r.x) + p.z * (q.x * r.y - q.y * r.x))
        .sign();
}

bool passes_strictly(const Line& edge, const Points& t) {
    if (orientation(t[0], t[1], t[2], edge.from) * orientation(t[0], t[1], t[2], edge.to) >= 0)
        return false;
    const int side = orientation(edge.from, edge.to, t[0], t[1]);
    return side != 0 && side == orientation(edge.from, edge.to, t[1], t[2]) &&
           side == orientation(edge.from, edge.to, t[2], t[0]);
}

Point small_place(Random& random) {
    const int x = random.integer(-3, 3);
    const int y = random.integer(-3, 3);
    return point(x, y, random.integer(-3, 3));
}

TEST(EdgeThroughFace, AgreesWithTheSignsOfTetrahedra) {
    Random random(731);
    int passing = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Line edge{small_place(random), small_place(random)};
        const Face face{{small_place(random), small_place(random), small_place(random)}};
        const bool expected = passes_strictly(edge, face.corners);
        passing += expected ? 1 : 0;
        const auto found = passage<Rational>(edge, face);
        EXPECT_EQ(found && found->certain, expected);
        const auto in_doubles = passage<double>(edge, face);
        EXPECT_EQ(in_doubles && in_doubles->certain, expected) << "small integers must be certain";
    }
    EXPECT_GT(passing, 60);
}

TEST(EdgeThroughFace, FilterKeepsWhatOnlyTouchesThePlane) {
    const auto filtered = [](const Line& edge) {
        return passage<double>(edge, triangle, Ends::not_proven_on_one_side).has_value();
    };
    EXPECT_TRUE(filtered({point(1, 1, 0), point(1, 1, 3)}));
    EXPECT_TRUE(filtered({point(1, 1, -3), point(1, 1, 0)}));
    EXPECT_TRUE(filtered({point(1, 1, -1), point(1, 1, 1)}));
    EXPECT_FALSE(filtered({point(1, 1, 1), point(1, 1, 3)}));
    EXPECT_FALSE(filtered({point(3, 3, -1), point(3, 3, 1)}));
}

/// Faces slide in one plane. An edge beside a face in this plane is rejected; an edge that may lie in the face is kept.
TEST(EdgeThroughFace, FilterTellsEdgesBesideTheFaceInItsPlane) {
    Random random(733);
    int beside = 0, across = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const auto place = [&] { return point(random.integer(-8, 8), random.integer(-8, 8), 0); };
        const Line edge{place(), place()};
        const Face face{{place(), place(), place()}};
        const auto area = [](const Point& a, const Point& b, const Point& c) {
            return Rational((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)).sign();
        };
        if (area(face.corners[0], face.corners[1], face.corners[2]) == 0 || norm1(edge.to - edge.from) == 0)
            continue;
        const auto are_on_one_side = [&](const Point& a, const Point& b, std::initializer_list<Point> points,
                                         int side) {
            return std::all_of(points.begin(), points.end(), [&](const Point& p) { return area(a, b, p) == side; });
        };
        bool apart = false; // strictly, by a side of the face or by the edge
        for (int side : {-1, 1}) {
            apart =
                apart || are_on_one_side(edge.from, edge.to, {face.corners[0], face.corners[1], face.corners[2]}, side);
            for (std::size_t i = 0; i < 3; ++i) {
                const Point& a = face.corners[i];
                const Point& b = face.corners[(i + 1) % 3];
                apart = apart || (are_on_one_side(a, b, {edge.from, edge.to}, side) &&
                                  area(a, b, face.corners[(i + 2) % 3]) == -side);
            }
        }
        (apart ? beside : across) += 1;
        EXPECT_EQ(passage<double>(edge, face, Ends::not_proven_on_one_side).has_value(), !apart) << "trial " << trial;
    }
    EXPECT_GT(beside, 200);
    EXPECT_GT(across, 200);
}

/// The hull of a face that is not convex says nothing: each part is tested by itself.
TEST(EdgeThroughFace, FilterTellsEdgesInANotchInItsPlane) {
    const Face bent_bar{
        {point(0, 0, 0), point(3, 0, 0), point(3, 1, 0), point(1, 1, 0), point(1, 3, 0), point(0, 3, 0)},
        {0, 1, 2, 0, 2, 3, 0, 3, 5, 3, 4, 5}};
    const auto filtered = [&](const Line& edge) {
        return passage<double>(edge, bent_bar, Ends::not_proven_on_one_side).has_value();
    };
    EXPECT_FALSE(filtered({point(2, 2, 0), point(3, 2, 0)}));
    EXPECT_FALSE(filtered({point(ratio(3, 2), ratio(3, 2), 0), point(2, ratio(5, 4), 0)}));
    EXPECT_FALSE(filtered({point(ratio(9, 8), 3, 0), point(3, ratio(9, 8), 0)}));
    EXPECT_TRUE(filtered({point(2, 2, 0), point(ratio(1, 2), 2, 0)})) << "into a leg";
    EXPECT_TRUE(filtered({point(ratio(1, 2), ratio(5, 2), 0), point(ratio(5, 2), ratio(1, 2), 0)})) << "over the notch";
}

TEST(EdgeThroughFace, FilterLosesNothing) {
    Random random(732);
    int passing = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const Line edge{small_place(random), small_place(random)};
        const Face face{{small_place(random), small_place(random), small_place(random)}};
        if (!passes_strictly(edge, face.corners))
            continue;
        ++passing;
        EXPECT_TRUE(passage<double>(edge, face, Ends::not_proven_on_one_side));
    }
    EXPECT_GT(passing, 30);
}

/// A short edge that barely passes through a face, with coordinates known up to the rounding of the maps. The rounding
/// hides the sign of its volumes, so the filter must not rely on this sign.
TEST(EdgeThroughFace, TheFilterKeepsShortEdgesThatHardlyPass) {
    Random random(761);
    constexpr double length = 3;
    int passing = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const double size = std::pow(10.0, random.uniform(-6, -1));
        const auto near = [&](double spread) { return exact(random.vector(spread)); };
        const Point place = exact(random.vector(1));
        const Face face{{place + near(1), place + near(1), place + near(1)}};
        const auto shape = face_shape<Rational>(face.corners, {});
        const Rational a = Rational(random.uniform(0, 1)) / 3, b = Rational(random.uniform(0, 1)) / 3;
        const Point on_face =
            face.corners[0] + scale(face.corners[1] - face.corners[0], a) + scale(face.corners[2] - face.corners[0], b);
        const Rational depth = Rational(std::pow(10.0, random.uniform(-18, -14)));
        const Point any = near(size);
        const Rational height = dot(any, shape.normal) / dot(shape.normal, shape.normal);
        const Point half = any + scale(shape.normal, Rational(depth - height)); // along the face, but for the depth
        const Line edge{on_face - half, on_face + half};
        if (!edge_through_face<Rational>({edge.from, edge.to}, shape, {}))
            continue;
        ++passing;
        const auto blurred = [&](const Point& p) { // by 6 u of the length, as note 06 counts for a position
            return rounded_to<double>(p + near(5 * 0x1p-53 * length));
        };
        const auto corners = corners_in<double>(face.corners);
        const elementary::ErrorScale bounds{.length = length};
        ASSERT_TRUE(edge_through_face<double>({blurred(edge.from), blurred(edge.to)}, face_shape<double>(corners, {}),
                                              bounds, Ends::not_proven_on_one_side))
            << "trial " << trial;
    }
    EXPECT_GT(passing, 2000);
}

/// Exact segments are multiplied by a weight. The heights that are compared with the deviation of a warped face have
/// the same factor.
TEST(EdgeThroughFace, TheWeightOfASegmentChangesNothing) {
    const Face warped{{point(0, 0, 0), point(4, 0, 0), point(4, 4, ratio(1, 100)), point(0, 4, 0)}};
    const auto shape = face_shape<Rational>(warped.corners, {});
    ASSERT_GT(shape.deviation, 0);
    const auto passes = [&](const Rational& half, const Rational& weight) {
        const Line edge{point(1, 2, -half), point(1, 2, half)};
        return edge_through_face<Rational>({scale(edge.from, weight), scale(edge.to, weight), weight}, shape, {})
            .has_value();
    };
    for (const Rational& weight : {ratio(1, 1'000'000), Rational(1), Rational(1'000'000)}) {
        EXPECT_TRUE(passes(ratio(1, 10), weight)) << weight;
        EXPECT_FALSE(passes(ratio(1, 10'000), weight)) << "both ends are within the deviation";
    }
}

} // namespace
} // namespace chasles::elementary
