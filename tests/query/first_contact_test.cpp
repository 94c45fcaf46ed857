// The answers of a query on bodies whose first contact can be computed by hand.
#include "chasles/query/first_contact.h"

#include "chasles/base/invalid_input.h"
#include "tests/query/bodies.h"
#include "tests/support/refusal.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace chasles::test {
namespace {

using std::numbers::pi;

const Polyhedron& unit_box() {
    static const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    return body;
}

const Polyhedron& table() {
    static const Polyhedron body = box({5, 5, 0.5}).polyhedron();
    return body;
}

void expect_encloses(const Bracket& bracket, double value, double width = 1e-12) {
    EXPECT_LE(bracket.lower, value);
    EXPECT_GE(bracket.upper, value);
    EXPECT_LE(bracket.upper - bracket.lower, width);
}

TEST(FirstContact, TiltedBoxFallsOnTableWithOneCorner) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 0.3, 0.2).normalized();
    const double lowest = -[&] {
        double z = 0;
        for (const Eigen::Vector3d& v : unit_box().vertices())
            z = std::min(z, (Eigen::AngleAxisd(0.5, axis) * v).z());
        return z;
    }();
    const FirstContact found = first_contact(
        {.moving = unit_box(),
         .fixed = table(),
         .motion = ScrewMotion::between(turned({0.1, 0.2, 4}, axis, 0.5), turned({0.1, 0.2, 0}, axis, 0.5)),
         .options = {.find = Find::first_with_all_contacts}});
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    expect_encloses(found.time, (4 - 0.5 - lowest) / 4, 1e-11);
    ASSERT_EQ(found.contacts.size(), 1u);
    const Contact& contact = found.contacts[0];
    EXPECT_EQ(contact.kind, ContactKind::vertex_face);
    EXPECT_EQ(contact.fixed.first, 5u) << "the top of the table";
    EXPECT_TRUE(contact.normal.isApprox(Eigen::Vector3d::UnitZ(), 1e-12)) << "from the fixed body to the moving one";
    EXPECT_NEAR(contact.approach_speed, 4, 1e-12);
    EXPECT_NEAR(contact.point.z(), 0.5, 1e-11);
    EXPECT_NEAR(found.pose.translation.z(), 0.5 + lowest, 1e-11);
}

TEST(FirstContact, BoxLandsFlatWithItsFourCorners) {
    const FirstContact found = first_contact({.moving = unit_box(),
                                              .fixed = table(),
                                              .motion = ScrewMotion::between(shifted(0, 0, 3), shifted(0, 0, -1)),
                                              .options = {.find = Find::first_with_all_contacts}});
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    expect_encloses(found.time, 0.5);
    EXPECT_EQ(found.contacts.size(), 4u);
    for (std::size_t i = 0; i < found.contacts.size(); ++i) {
        EXPECT_EQ(found.contacts[i].kind, ContactKind::vertex_face);
        EXPECT_TRUE(i == 0 || found.contacts[i - 1].moving.first < found.contacts[i].moving.first);
    }
}

TEST(FirstContact, FacesAreNamedAsInTheInput) {
    // The first face collapses when equal corners are merged, and is dropped. The table's faces follow.
    Body with_collapsed = box({5, 5, 0.5});
    with_collapsed.vertices.push_back(with_collapsed.vertices[0]);
    with_collapsed.faces.insert(with_collapsed.faces.begin(), {0, 8, 1});
    const Eigen::Vector3d axis(1, 0.3, 0.2);
    const FirstContact found = first_contact(
        {.moving = unit_box(),
         .fixed = with_collapsed.polyhedron(),
         .motion = ScrewMotion::between(turned({0.1, 0.2, 4}, axis, 0.5), turned({0.1, 0.2, 0}, axis, 0.5))});
    ASSERT_EQ(found.contacts.size(), 1u);
    EXPECT_EQ(found.contacts[0].fixed.first, 6u);
    const FirstContact inside =
        first_contact({.moving = unit_box(),
                       .fixed = with_collapsed.polyhedron(),
                       .motion = ScrewMotion::between(turned({0.3, 0.2, 0.6}, axis, 0.4), Pose())});
    ASSERT_TRUE(inside.overlap.has_value());
    EXPECT_EQ(inside.overlap->face.first, 6u);
}

TEST(FirstContact, CrossedEdgesMeet) {
    // Two boxes stand on an edge, across each other. The lowest edge of one box touches the highest edge of the other
    // box.
    const double height = std::sqrt(0.5);
    const Pose fixed_pose = turned({0, 0, 0}, {1, 0, 0}, pi / 4);
    const Eigen::Quaterniond on_edge(Eigen::AngleAxisd(pi / 4, Eigen::Vector3d::UnitY()));
    const Pose start({0, 0, 3}, on_edge);
    const Pose goal({0, 0, 1}, on_edge);
    const FirstContact found = first_contact({.moving = unit_box(),
                                              .fixed = unit_box(),
                                              .motion = ScrewMotion::relative(start, goal, fixed_pose, fixed_pose),
                                              .options = {.find = Find::first_with_all_contacts}});
    ASSERT_EQ(found.verdict, Verdict::contact);
    expect_encloses(found.time, (3 - 2 * height) / 2, 1e-11);
    ASSERT_EQ(found.contacts.size(), 1u);
    const Contact& contact = found.contacts[0];
    EXPECT_EQ(contact.kind, ContactKind::edge_edge);
    EXPECT_TRUE(contact.normal.isApprox(Eigen::Vector3d::UnitZ(), 1e-9)) << contact.normal.transpose();
    EXPECT_TRUE(contact.point.isApprox(Eigen::Vector3d(0, 0, height), 1e-9)) << contact.point.transpose();
    EXPECT_NEAR(contact.approach_speed, 2, 1e-9);
}

TEST(FirstContact, DoorSwingsAgainstPostAtTheAngleOfGeometry) {
    // A thin door turns about z through the origin; a small post stands at 30 degrees, 0.8 from the hinge.
    const Polyhedron door = box({0.5, 0.001, 1}).polyhedron();
    const Polyhedron post = box({0.01, 0.01, 2}).polyhedron();
    const auto opened = [](double angle) {
        return Pose(0.5 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0),
                    Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())));
    };
    const double at = pi / 6;
    const Pose post_pose({0.8 * std::cos(at), 0.8 * std::sin(at), 0},
                         Eigen::Quaterniond(Eigen::AngleAxisd(at, Eigen::Vector3d::UnitZ())));
    const FirstContact found =
        first_contact({.moving = door,
                       .fixed = post,
                       .motion = ScrewMotion::relative(opened(0), opened(pi / 3), post_pose, post_pose, pi)});
    ASSERT_EQ(found.verdict, Verdict::contact);
    // The door's face y = 0.001 touches the post's nearer corner, (0.79, -0.01) in the post's frame.
    const double corner_angle = at + std::atan2(-0.01, 0.79);
    const double face_angle = std::asin(0.001 / std::hypot(0.79, 0.01));
    expect_encloses(found.time, (corner_angle - face_angle) / (pi / 3), 1e-11);
    const double tau = std::tan((corner_angle - face_angle) / 2) / std::tan(pi / 6);
    expect_encloses(found.tau, tau, 1e-11);
}

TEST(FirstContact, PassingByIsClear) {
    const FirstContact found =
        first_contact({.moving = unit_box(),
                       .fixed = unit_box(),
                       .motion = ScrewMotion::between(shifted(-5, 1.00001, 0), shifted(5, 1.00001, 0))});
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_TRUE(found.contacts.empty());
    EXPECT_GT(found.work.node_pairs, 0u);
    EXPECT_DOUBLE_EQ(found.pose.translation.x(), 5);
}

TEST(FirstContact, ClearanceOfAHundredBillionthIsClear) {
    const FirstContact found =
        first_contact({.moving = unit_box(),
                       .fixed = unit_box(),
                       .motion = ScrewMotion::between(shifted(-5, 1 + 1e-11, 0), shifted(5, 1 + 1e-11, 0))});
    EXPECT_EQ(found.verdict, Verdict::clear);
}

TEST(FirstContact, SlidingAlongFaceToFaceIsContactFromWhereTheyMeet) {
    const FirstContact found = first_contact({.moving = unit_box(),
                                              .fixed = unit_box(),
                                              .motion = ScrewMotion::between(shifted(-5, 1, 0), shifted(5, 1, 0)),
                                              .options = {.find = Find::first_with_all_contacts}});
    ASSERT_EQ(found.verdict, Verdict::contact);
    expect_encloses(found.time, 0.4);
    EXPECT_TRUE(found.certain) << "an exact touch is decided exactly";
}

TEST(FirstContact, BodiesTouchingAtTheStartSaySo) {
    for (const double away : {1.0, -1.0}) {
        const FirstContact found =
            first_contact({.moving = unit_box(),
                           .fixed = table(),
                           .motion = ScrewMotion::between(shifted(0, 0, 1), shifted(0, 0, 1 + away)),
                           .options = {.find = Find::first_with_all_contacts}});
        EXPECT_EQ(found.verdict, Verdict::contact_at_start);
        EXPECT_EQ(found.time.lower, 0);
        EXPECT_FALSE(found.contacts.empty());
    }
}

TEST(FirstContact, OverlapAtTheStartNamesAnEdgeAndAFace) {
    const FirstContact found =
        first_contact({.moving = unit_box(),
                       .fixed = table(),
                       .motion = ScrewMotion::between(turned({0.3, 0.2, 0.6}, {1, 2, 3}, 0.4), shifted(0, 0, 5))});
    ASSERT_EQ(found.verdict, Verdict::contact_at_start);
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(found.time.upper, 0);
    ASSERT_TRUE(found.overlap.has_value());
    EXPECT_NEAR(found.overlap->point.z(), 0.5, 1e-12) << "on the table's top";
    EXPECT_EQ(found.overlap->face.first, 5u);
}

TEST(FirstContact, NestedSurfacesThatDoNotTouchAreClear) {
    const Polyhedron small = box({0.1, 0.1, 0.1}).polyhedron();
    const Body large = box({0.5, 0.5, 0.5});
    const FirstContact found =
        first_contact({.moving = small,
                       .fixed = Polyhedron::from_polygons(large.vertices, large.faces, {.solid = Solid::no}),
                       .motion = ScrewMotion::between(shifted(-0.2, 0, 0), turned({0.2, 0.1, 0}, {0, 1, 1}, 2))});
    EXPECT_EQ(found.verdict, Verdict::clear);
}

TEST(FirstContact, NoMotionIsContactOnlyWhenTouchingAtTheStart) {
    const auto verdict_at = [](double height) {
        return first_contact({.moving = unit_box(),
                              .fixed = table(),
                              .motion = ScrewMotion::between(shifted(0, 0, height), shifted(0, 0, height))})
            .verdict;
    };
    EXPECT_EQ(verdict_at(1.001), Verdict::clear);
    EXPECT_EQ(verdict_at(1), Verdict::contact_at_start);
    EXPECT_EQ(verdict_at(0.9), Verdict::contact_at_start);
}

TEST(FirstContact, AnyStopsEarlyWithTheSameYesOrNo) {
    std::mt19937 random(7);
    int contacts = 0;
    for (int i = 0; i < 200; ++i) {
        const Polyhedron a = random_octahedron(random).polyhedron();
        const Polyhedron b = random_octahedron(random).polyhedron();
        const Motion motion = ScrewMotion::between(random_pose(random, 3, 1), random_pose(random, 3, 1));
        const FirstContact first = first_contact({.moving = a, .fixed = b, .motion = motion});
        const FirstContact any =
            first_contact({.moving = a, .fixed = b, .motion = motion, .options = {.find = Find::any}});
        EXPECT_EQ(first.verdict == Verdict::clear, any.verdict == Verdict::clear) << "seed 7, case " << i;
        EXPECT_LE(first.time.lower, any.time.upper);
        contacts += first.verdict == Verdict::clear ? 0 : 1;
    }
    EXPECT_GT(contacts, 40);
    EXPECT_LT(contacts, 180);
}

TEST(FirstContact, HalfTurnsAreCutWhateverMaxTurn) {
    const Pose start({2, 0, 0}, Eigen::Quaterniond(1, 0, 0, 0));
    const Pose goal({-2, 0, 0}, Eigen::Quaterniond(0, 0, 0, 1));
    for (const double max_turn : {0.1, pi}) {
        const FirstContact found = first_contact({.moving = unit_box(),
                                                  .fixed = box({0.1, 3, 0.1}).polyhedron(),
                                                  .motion = ScrewMotion::between(start, goal, max_turn)});
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_GT(found.time.lower, 0.2);
        EXPECT_LT(found.time.upper, 0.5);
    }
}

TEST(FirstContact, SweepAnswersForItsOwnMotion) {
    // Without a turn, screw and sweep agree: the reference point moves along a line. With a turn they differ.
    const Pose start = shifted(0, 0, 3);
    const auto time_of = [&](const Motion& motion) {
        return first_contact({.moving = unit_box(), .fixed = table(), .motion = motion}).time.lower;
    };
    EXPECT_NEAR(time_of(ScrewMotion::between(start, shifted(0, 0, 0))), 2.0 / 3, 1e-11);
    EXPECT_NEAR(time_of(SweepMotion::between(start, shifted(0, 0, 0))), 2.0 / 3, 1e-11);
    const Pose goal = turned({0, 3, 0}, {1, 0, 0}, 1.5);
    EXPECT_GT(std::abs(time_of(ScrewMotion::between(start, goal)) - time_of(SweepMotion::between(start, goal))), 1e-3);
}

TEST(FirstContact, OptionsOutOfRangeAreRefusedWithAReason) {
    const Motion still = ScrewMotion::between(Pose(), Pose());
    const auto message_of = [&](const FirstContactQuery& query) -> std::string {
        try {
            static_cast<void>(first_contact(query));
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "";
    };
    const auto refusal_of_turn = [](double max_turn) {
        return refusal([&] { static_cast<void>(ScrewMotion::between(Pose(), Pose(), max_turn)); });
    };
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    const Polyhedron& body = unit_box();
    EXPECT_EQ(message_of({.moving = body, .fixed = body, .motion = still, .options = {.margin = -0.1}}),
              "query: margin: must be in [0, 1e30]");
    EXPECT_NE(message_of({.moving = body, .fixed = body, .motion = still, .options = {.margin = nan}}), "");
    EXPECT_NE(message_of({.moving = body, .fixed = body, .motion = still, .options = {.margin = 2e30}}), "");
    EXPECT_EQ(message_of({.moving = body, .fixed = body, .motion = still, .options = {.hold = 0.1}}),
              "query: hold: 0.1 is not less than the margin, which is 0 unless one is given");
    EXPECT_EQ(message_of({.moving = body, .fixed = body, .motion = still, .options = {.margin = 1, .hold = 2}}),
              "query: hold: 2 is not less than the margin 1");
    EXPECT_EQ(message_of({.moving = body, .fixed = body, .motion = still, .options = {.margin = 1, .hold = nan}}),
              "query: hold: must be in [0, 1e30]");
    EXPECT_NE(message_of({.moving = body, .fixed = body, .motion = still, .options = {.time_tolerance = 0}}), "");
    EXPECT_NE(message_of({.moving = body, .fixed = body, .motion = still, .options = {.time_tolerance = nan}}), "");
    EXPECT_EQ(refusal_of_turn(0), "motion: max_turn: must be at least 1e-4 radians (0.00573 degrees)");
    EXPECT_EQ(refusal_of_turn(10), // degrees
              "motion: max_turn: must be at most pi radians (180 degrees): one screw in one piece");
    EXPECT_EQ(refusal_of_turn(std::numbers::pi), "accepted");
    EXPECT_NE(refusal_of_turn(nan), "accepted");
}

} // namespace
} // namespace chasles::test
