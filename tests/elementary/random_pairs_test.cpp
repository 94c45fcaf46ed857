// Random features under random screws. Contacts that are built backwards from a point and a tau are never missed,
// doubles never contradict exact rationals, and every certain contact exists.
#include "tests/support/elementary_cases.h"
#include "tests/support/segment_distance.h"

#include <gtest/gtest.h>

namespace chasles::elementary {
namespace {

using namespace test;

/// Doubles with a few bits or with all bits.
Rational random_number(Random& random, double size) {
    if (random.chance(0.3))
        return ratio(random.integer(-4, 4), 2) * Rational(size) / 2;
    return Rational(random.uniform(-size, size));
}

Point random_place(Random& random, double size) {
    const Rational x = random_number(random, size);
    const Rational y = random_number(random, size);
    return {x, y, random_number(random, size)};
}

/// Screws with half-angle tangents up to 2; some have no turn, some no slide, some an axis along the third axis.
PlainScrew random_screw(Random& random) {
    PlainScrew screw{random_place(random, 1), random_place(random, random.chance(0.3) ? 0.05 : 1.1), {}};
    if (random.chance(0.2))
        screw.tangent = {0, 0, screw.tangent.z};
    if (random.chance(0.15))
        return {{}, {}, random_place(random, 3)};
    if (random.chance(0.7))
        screw.slide = scale(screw.tangent, random_number(random, 3));
    return screw;
}

Rational random_tau(Random& random) {
    return random.chance(0.1) ? Rational(random.integer(0, 1)) : Rational(random.uniform(0, 1));
}

/// Positions in doubles that are exact in rationals.
Point in_doubles(const Point& p) {
    Point result;
    for (int i = 0; i < 3; ++i)
        result[i] = Rational(static_cast<double>(p[i]));
    return result;
}

Eigen::Vector3d nearest(const Point& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

/// A moving edge that crosses a fixed edge at `tau`, anywhere along both edges or at their ends.
EdgeEdgeCase crossing_edges(Random& random, const Rational& tau) {
    const Point place = random_place(random, 2);
    const auto through = [&](const Point& direction) {
        const Rational share = random.chance(0.2) ? Rational(0) : Rational(random.uniform(0, 1));
        return Line{place - scale(direction, share), place + scale(direction, Rational(1 - share))};
    };
    const PlainScrew screw = random_screw(random);
    const Line at_tau = through(random_place(random, 1) + point(0, 0, ratio(1, 100)));
    return {screw,
            {screw.start_of(at_tau.from, tau), screw.start_of(at_tau.to, tau)},
            through(random_place(random, 1) + point(0, ratio(1, 100), 0))};
}

Face random_triangle(Random& random) {
    return {
        {random_place(random, 2), random_place(random, 2) + point(1, 0, 0), random_place(random, 2) + point(0, 1, 1)}};
}

/// A vertex that is on the triangle at `tau`, inside or on the rim.
VertexFaceCase vertex_on_face(Random& random, const Rational& tau) {
    const Face face = random_triangle(random);
    const Rational s = random.chance(0.2) ? Rational(0) : Rational(random.uniform(0, 1));
    const Rational t = Rational(random.uniform(0, 1)) * (1 - s);
    const Point& corner = face.corners[0];
    const Point place = corner + scale(face.corners[1] - corner, s) + scale(face.corners[2] - corner, t);
    const PlainScrew screw = random_screw(random);
    return {screw, screw.start_of(place, tau), face};
}

template <class S, class Case>
void expect_not_late(const Case& posed, const Rational& tau) {
    const Answer found = posed.template ask<S>();
    ASSERT_TRUE(found) << "missed the contact at " << static_cast<double>(tau);
    EXPECT_LE(Rational(found->lower), tau) << "late";
}

TEST(RandomPairs, EdgeContactsBuiltBackwardsAreNeverMissed) {
    Random random(701);
    for (int trial = 0; trial < 250; ++trial) {
        const Rational tau = random_tau(random);
        const EdgeEdgeCase built = crossing_edges(random, tau);
        expect_not_late<Rational>(built, tau);
        expect_not_late<double>(built, tau);
        expect_not_late<DoubleDouble>(built, tau);
    }
}

TEST(RandomPairs, VertexContactsBuiltBackwardsAreNeverMissed) {
    Random random(702);
    for (int trial = 0; trial < 250; ++trial) {
        const Rational tau = random_tau(random);
        const VertexFaceCase built = vertex_on_face(random, tau);
        expect_not_late<Rational>(built, tau);
        expect_not_late<double>(built, tau);
        expect_not_late<DoubleDouble>(built, tau);
        const PlainScrew screw = built.screw;
        const Face face = random_triangle(random);
        const Point on_face = scale(face.corners[0] + face.corners[1] + face.corners[1] + face.corners[2], ratio(1, 4));
        const FaceVertexCase reversed{screw, face, screw.position(on_face, tau)};
        expect_not_late<Rational>(reversed, tau);
        expect_not_late<double>(reversed, tau);
    }
}

struct Tally {
    int pairs = 0;
    int contacts = 0;
    int doubtful = 0; ///< reported in doubles, absent in rationals
    int certain = 0;
    int narrow = 0; ///< certain contacts with a narrow bracket; only a shallow approach makes a bracket wider

    void expect_hit_rates() const {
        std::cout << contacts << " contacts of " << pairs << ", " << doubtful << " doubtful, " << certain
                  << " certain, " << narrow << " narrow\n";
        EXPECT_GE(certain, contacts / 2);
        EXPECT_GE(narrow, certain * 9 / 10);
        EXPECT_GE(contacts, pairs / 5);
        EXPECT_GE(pairs - contacts, pairs / 5);
        EXPECT_LE(doubtful, pairs / 50);
    }
};

/// The exact answer and the answer in doubles to the same problem.
template <class Case>
void expect_agreement(const Case& posed, Tally& tally) {
    const Answer truth = posed.template ask<Rational>();
    const Answer found = posed.template ask<double>();
    ++tally.pairs;
    if (!truth) {
        EXPECT_FALSE(found && found->certain) << "certain, but there is no contact";
        tally.doubtful += found ? 1 : 0;
        return;
    }
    ++tally.contacts;
    ASSERT_TRUE(found || !truth->certain) << "missed the contact at " << truth->lower;
    if (!found)
        return;
    EXPECT_LE(found->lower, truth->upper) << "late";
    if (found->certain) {
        EXPECT_LE(truth->lower, found->upper) << "the contact is after the bracket";
        ++tally.certain;
        tally.narrow += found->upper - found->lower <= 1e-10 ? 1 : 0;
    }
}

EdgeEdgeCase random_edges(Random& random) {
    const auto line = [&] {
        const Point from = in_doubles(random_place(random, 1));
        return Line{from, in_doubles(from + random_place(random, 2) + point(ratio(1, 64), 0, 0))};
    };
    const PlainScrew screw = random_screw(random);
    const Line moving = line();
    return {screw, moving, line()};
}

TEST(RandomPairs, DoublesAgreeWithRationalsOnEdges) {
    Random random(703);
    Tally tally;
    for (int trial = 0; trial < 500; ++trial)
        expect_agreement(random.chance(0.3) ? crossing_edges(random, random_tau(random)) : random_edges(random), tally);
    tally.expect_hit_rates();
}

TEST(RandomPairs, DoublesAgreeWithRationalsOnVerticesAndFaces) {
    Random random(704);
    Tally tally;
    for (int trial = 0; trial < 500; ++trial) {
        const VertexFaceCase built = vertex_on_face(random, random_tau(random));
        const VertexFaceCase free{random_screw(random), in_doubles(random_place(random, 2)), random_triangle(random)};
        expect_agreement(random.chance(0.3) ? built : free, tally);
    }
    tally.expect_hit_rates();
}

/// A certain bracket in double-double is as narrow as the requested tolerance.
TEST(RandomPairs, DoubleDoubleBracketsAreNarrow) {
    Random random(708);
    int certain = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Answer edges = crossing_edges(random, random_tau(random)).ask<DoubleDouble>();
        const Answer vertex = vertex_on_face(random, random_tau(random)).ask<DoubleDouble>();
        for (const Answer& found : {edges, vertex})
            if (found && found->certain) {
                ++certain;
                EXPECT_LE(found->upper - found->lower, 1.001e-12);
            }
    }
    EXPECT_GT(certain, 100);
}

TEST(RandomPairs, CertainEdgeContactsCanBeSeen) {
    Random random(705);
    int certain = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const EdgeEdgeCase posed =
            random.chance(0.3) ? crossing_edges(random, random_tau(random)) : random_edges(random);
        const Answer found = posed.ask<double>();
        if (!found || !found->certain)
            continue;
        ++certain;
        const Rational tau(found->lower);
        const Segment3 moving{nearest(posed.screw.position(posed.moving.from, tau)),
                              nearest(posed.screw.position(posed.moving.to, tau))};
        EXPECT_LT(distance_of_segments(moving, {nearest(posed.fixed.from), nearest(posed.fixed.to)}), 1e-10);
    }
    EXPECT_GT(certain, 30);
}

TEST(RandomPairs, CertainVertexContactsCanBeSeen) {
    Random random(706);
    int certain = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const VertexFaceCase built = vertex_on_face(random, random_tau(random));
        const VertexFaceCase free{random_screw(random), in_doubles(random_place(random, 2)), random_triangle(random)};
        const VertexFaceCase& posed = random.chance(0.3) ? built : free;
        const Answer found = posed.ask<double>();
        if (!found || !found->certain)
            continue;
        ++certain;
        const Eigen::Vector3d place = nearest(posed.screw.position(posed.vertex, Rational(found->lower)));
        const Points& corners = posed.face.corners;
        EXPECT_LT(distance_to_triangle(place, {nearest(corners[0]), nearest(corners[1]), nearest(corners[2])}), 1e-10);
    }
    EXPECT_GT(certain, 30);
}

/// A clear answer must be clear at every sample. Sampling can only refute.
TEST(RandomPairs, ClearEdgesNeverComeTogether) {
    Random random(707);
    int clear = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const EdgeEdgeCase posed = random_edges(random);
        if (posed.ask<double>())
            continue;
        ++clear;
        const Segment3 fixed{nearest(posed.fixed.from), nearest(posed.fixed.to)};
        for (int i = 0; i <= 50; ++i) {
            const Rational tau = ratio(i, 50);
            const Segment3 moving{nearest(posed.screw.position(posed.moving.from, tau)),
                                  nearest(posed.screw.position(posed.moving.to, tau))};
            EXPECT_GT(distance_of_segments(moving, fixed), 1e-14);
        }
    }
    EXPECT_GT(clear, 60);
}

} // namespace
} // namespace chasles::elementary
