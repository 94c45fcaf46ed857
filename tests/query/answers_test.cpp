// What an answer and a question are as values: nothing is claimed before a query, roles can be swapped, and many
// questions at once have the answers of each alone.
#include "chasles/query/batch.h"
#include "chasles/query/path.h"
#include "tests/query/bodies.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <type_traits>

namespace chasles::test {
namespace {

bool same(const Contact& a, const Contact& b) {
    return a.kind == b.kind && a.moving == b.moving && a.fixed == b.fixed && a.point == b.point &&
           a.normal == b.normal && a.gap == b.gap && a.approach_speed == b.approach_speed;
}
bool same(const Pose& a, const Pose& b) {
    return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}
bool same(const std::optional<Overlap>& a, const std::optional<Overlap>& b) {
    if (!a || !b)
        return !a && !b;
    return a->edge_is_moving == b->edge_is_moving && a->edge == b->edge && a->face == b->face && a->point == b->point &&
           a->certain == b->certain;
}
bool same(const std::vector<Contact>& a, const std::vector<Contact>& b) {
    return std::ranges::equal(a, b, [](const Contact& x, const Contact& y) { return same(x, y); });
}
bool same(const Bracket& a, const Bracket& b) {
    return a.lower == b.lower && a.upper == b.upper;
}

/// Bit by bit, but for the work.
bool same(const FirstContact& a, const FirstContact& b) {
    return a.verdict == b.verdict && same(a.time, b.time) && same(a.tau, b.tau) && a.certain == b.certain &&
           same(a.contacts, b.contacts) && same(a.held, b.held) && a.clear_until == b.clear_until &&
           same(a.overlap, b.overlap) && same(a.pose, b.pose) && same(a.fixed_pose, b.fixed_pose);
}

const Polyhedron& cube() {
    static const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    return body;
}

TEST(Answer, OfNoQueryClaimsNothing) {
    const FirstContact nothing;
    EXPECT_EQ(nothing.verdict, Verdict::unknown);
    EXPECT_FALSE(nothing.certain);
    EXPECT_EQ(nothing.clear_until, 0);
    EXPECT_TRUE(nothing.contacts.empty());
    EXPECT_TRUE(nothing.held.empty());
    EXPECT_FALSE(nothing.overlap);
    EXPECT_EQ(PathContact().contact.verdict, Verdict::unknown);
    static_assert(!std::is_convertible_v<FirstContact, bool> && !std::is_constructible_v<bool, FirstContact>);
    static_assert(!std::is_constructible_v<bool, const PathContact&>);
}

/// Two bodies that both move in the world.
struct Pair {
    Polyhedron a;
    Polyhedron b;
    Pose poses[4]; ///< of a at both ends, of b at both ends

    explicit Pair(std::mt19937& random, double distance)
        : a(random_octahedron(random).polyhedron()), b(random_octahedron(random).polyhedron()) {
        for (Pose& pose : poses)
            pose = random_pose(random, distance, 1);
    }
    [[nodiscard]] FirstContactQuery query(const QueryOptions& options = {}) const {
        return {a, b, ScrewMotion::relative(poses[0], poses[1], poses[2], poses[3]), options};
    }
    [[nodiscard]] FirstContactQuery swapped(const QueryOptions& options = {}) const {
        return {b, a, ScrewMotion::relative(poses[2], poses[3], poses[0], poses[1]), options};
    }
};

TEST(Answer, SwappedTwiceIsTheSameUpToTheRoundingOfPoints) {
    std::mt19937 random(811);
    int contacts = 0, overlaps = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const FirstContact found = first_contact(Pair(random, trial % 2 == 0 ? 1 : 2.5).query());
        FirstContact twice = found.swapped().swapped();
        ASSERT_EQ(twice.contacts.size(), found.contacts.size());
        for (std::size_t i = 0; i < found.contacts.size(); ++i) { // the gap is added to the point and taken off again
            EXPECT_LE((twice.contacts[i].point - found.contacts[i].point).norm(), 1e-15);
            twice.contacts[i].point = found.contacts[i].point;
        }
        EXPECT_TRUE(same(twice, found)) << "trial " << trial;
        contacts += found.contacts.empty() ? 0 : 1;
        overlaps += found.overlap ? 1 : 0;
    }
    EXPECT_GT(contacts, 5);
    EXPECT_GT(overlaps, 5);
}

/// Both bodies move straight: so their motion is the same seen from either. With a margin, the points are apart.
class SwappedAnswer : public testing::TestWithParam<double> {};

TEST_P(SwappedAnswer, IsTheAnswerForSwappedBodies) {
    const QueryOptions options{.margin = GetParam()};
    const Polyhedron small = box({0.5, 0.25, 0.125}).polyhedron();
    const Pose turn = turned({0, 0, 0}, {1, 2, 3}, 0.7);
    const Pose start = composed(shifted(-3, 0.1, 0.05), turn);
    const Pose goal = composed(shifted(1, 0.1, 0.05), turn);
    const FirstContact found = first_contact(
        {small, cube(), ScrewMotion::relative(start, goal, shifted(1, 0, 0), shifted(-1, 0, 0)), options});
    const FirstContact other = first_contact(
        {cube(), small, ScrewMotion::relative(shifted(1, 0, 0), shifted(-1, 0, 0), start, goal), options});
    const FirstContact swapped = other.swapped();
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_EQ(swapped.verdict, found.verdict);
    EXPECT_EQ(swapped.certain, found.certain);
    EXPECT_NEAR(swapped.time.lower, found.time.lower, 1e-11);
    EXPECT_NEAR(swapped.clear_until, found.clear_until, 1e-11);
    EXPECT_TRUE(swapped.pose.isometry().isApprox(found.pose.isometry(), 1e-10));
    EXPECT_TRUE(swapped.fixed_pose.isometry().isApprox(found.fixed_pose.isometry(), 1e-10));
    ASSERT_EQ(swapped.contacts.size(), 1U);
    ASSERT_EQ(found.contacts.size(), 1U);
    const Contact& a = swapped.contacts[0];
    const Contact& b = found.contacts[0];
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.moving, b.moving);
    EXPECT_EQ(a.fixed, b.fixed);
    EXPECT_NEAR(a.gap, GetParam(), 1e-9);
    EXPECT_NEAR(b.gap, GetParam(), 1e-9);
    EXPECT_LE((a.point - b.point).norm(), 1e-9);
    EXPECT_LE((a.normal - b.normal).norm(), 1e-9);
    EXPECT_NEAR(a.approach_speed, b.approach_speed, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(TouchAndMargin, SwappedAnswer, testing::Values(0.0, 0.2));

TEST(Answer, SwappedTellsTheSameVerdictForRandomPairs) {
    std::mt19937 random(812);
    for (int trial = 0; trial < 40; ++trial) {
        const Pair pair(random, 2);
        const FirstContact found = first_contact(pair.query());
        const FirstContact swapped = first_contact(pair.swapped()).swapped();
        // A pair that turns moves on another screw when seen from the other body, but starts alike.
        EXPECT_EQ(swapped.verdict == Verdict::contact_at_start, found.verdict == Verdict::contact_at_start);
        if (found.overlap && swapped.overlap) {
            EXPECT_TRUE(swapped.pose.isometry().isApprox(found.pose.isometry(), 1e-12));
        }
    }
}

TEST(Answer, IsClearUntilTheLowerEndOfTheFirstContact) {
    std::mt19937 random(813);
    int contacts = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const FirstContact found = first_contact(Pair(random, 2).query({.margin = trial % 2 == 0 ? 0 : 0.05}));
        if (found.verdict == Verdict::clear) {
            EXPECT_EQ(found.clear_until, 1);
            continue;
        }
        ++contacts;
        EXPECT_EQ(found.clear_until, found.time.lower);
        if (found.verdict == Verdict::contact_at_start) {
            EXPECT_EQ(found.clear_until, 0);
        }
    }
    EXPECT_GT(contacts, 10);
}

TEST(Question, IsAValueThatCanBeAssignedAndStored) {
    static_assert(std::is_copy_assignable_v<FirstContactQuery> && std::is_copy_constructible_v<FirstContactQuery>);
    static_assert(std::is_nothrow_move_constructible_v<FirstContactQuery>);
    std::mt19937 random(814);
    std::vector<FirstContactQuery> questions;
    for (int i = 0; i < 10; ++i)
        questions.push_back(Pair(random, 2).query());
    FirstContactQuery one = questions[0];
    const FirstContact before = first_contact(one);
    one = questions[1];
    EXPECT_TRUE(same(first_contact(one), first_contact(questions[1])));
    EXPECT_TRUE(same(first_contact(questions[0]), before));
    EXPECT_EQ(&one.moving.body(), &questions[1].moving.body()) << "copies share bodies";
    EXPECT_EQ(&one.motion.trajectory(), &questions[1].motion.trajectory()) << "copies share motions";
}

/// Each question has bodies, a motion and options of its own.
TEST(Batch, OfManyPairsHasTheAnswersOfEachAlone) {
    std::mt19937 random(815);
    std::vector<FirstContactQuery> questions;
    for (int i = 0; i < 60; ++i) {
        QueryOptions options{.margin = i % 3 == 0 ? 0.05 : 0};
        options.find = std::array{Find::first, Find::any, Find::first_with_all_contacts}[std::size_t(i % 3)];
        if (i % 6 == 0)
            options.hold = 0.01;
        questions.push_back(Pair(random, 2).query(options));
        if (i % 4 == 0)
            questions.back().motion = SweepMotion::between(random_pose(random, 2, 2), random_pose(random, 2, 2));
    }
    for (const unsigned threads : {1U, 2U}) {
        std::size_t last = 0;
        const auto answers =
            first_contact_batch(std::span<const FirstContactQuery>(questions),
                                {.threads = threads, .progress = [&](std::size_t done) { last = done; }});
        ASSERT_EQ(answers.size(), questions.size());
        EXPECT_EQ(last, questions.size());
        for (std::size_t i = 0; i < questions.size(); ++i)
            EXPECT_TRUE(same(answers[i], first_contact(questions[i]))) << "question " << i;
    }
    EXPECT_TRUE(first_contact_batch(std::span<const FirstContactQuery>()).empty());
    PairMemory memory(questions[7].moving, questions[7].fixed);
    questions[7].memory = &memory;
    EXPECT_EQ(refusal([&] { static_cast<void>(first_contact_batch(std::span<const FirstContactQuery>(questions))); }),
              "query: memory: serves one thread, and a batch has several: ask one by one");
}

TEST(Path, OfSweepsTellsTheSegment) {
    const PathContact found = first_contact_on_path(
        {cube(),
         cube(),
         {Motion::sweep(shifted(-4, 0, 0), shifted(-3, 0, 0)), Motion::sweep(shifted(-3, 0, 0), shifted(1, 0, 0))}});
    EXPECT_EQ(found.contact.verdict, Verdict::contact);
    EXPECT_EQ(found.segment, 1U);
    EXPECT_NEAR(found.contact.time.lower, 0.5, 1e-11);
}

TEST(Path, OfMixedMotionsWithAMovingSecondBody) {
    // Seen from the second body, the first one comes from x = -6 to -3, and then from -3 to 0.
    const std::vector<Motion> motions{
        ScrewMotion::relative(shifted(-3, 0, 0), shifted(-2, 0, 0), shifted(3, 0, 0), shifted(1, 0, 0)),
        SweepMotion::relative(shifted(-2, 0, 0), shifted(-1, 0, 0), shifted(1, 0, 0), shifted(-1, 0, 0))};
    const PathContact found = first_contact_on_path({cube(), cube(), motions});
    EXPECT_EQ(found.contact.verdict, Verdict::contact);
    EXPECT_EQ(found.segment, 1U);
    EXPECT_NEAR(found.contact.time.lower, 2.0 / 3, 1e-11);
    EXPECT_NEAR(found.contact.pose.translation.x(), -4.0 / 3, 1e-10);
    EXPECT_NEAR(found.contact.fixed_pose.translation.x(), -1.0 / 3, 1e-10);
    for (const Contact& contact : found.contact.contacts)
        EXPECT_NEAR(contact.point.x(), -4.0 / 3 + 0.5, 1e-10) << "in the world";
}

TEST(Path, WithHoldGoesOnFromContactToContact) {
    const Polyhedron table = box({5, 5, 0.5}).polyhedron();
    const std::vector<Motion> slides{Motion::screw(shifted(0, 0, 1.05), shifted(1, 0, 1.05)),
                                     Motion::sweep(shifted(1, 0, 1.05), shifted(2, 0, 1.05)),
                                     Motion::sweep(shifted(2, 0, 1.05), shifted(2, 0, 1.01))};
    const PathContact held = first_contact_on_path({cube(), table, slides, {.margin = 0.1, .hold = 0.02}});
    EXPECT_EQ(held.contact.verdict, Verdict::contact);
    EXPECT_EQ(held.segment, 2U);
    EXPECT_NEAR(held.contact.time.lower, 0.75, 1e-9) << "where the gap is `hold`";
    EXPECT_FALSE(held.contact.held.empty());
    const PathContact touching = first_contact_on_path({cube(), table, slides, {.margin = 0.1}});
    EXPECT_EQ(touching.contact.verdict, Verdict::contact_at_start);
    EXPECT_EQ(touching.segment, 0U);
}

/// Bytes of one of many motions, as glibc counts them; 0 with another allocator.
template <class Make>
std::size_t bytes_of_one(Make make) {
    constexpr std::size_t count = 10000;
    const auto used = [] {
        const auto info = mallinfo2();
        return info.uordblks + info.hblkhd;
    };
    const std::size_t before = used();
    std::vector<Motion> motions;
    motions.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        motions.push_back(make());
    return (used() - before) / count;
}

/// The handle, what it shares, and at most 16 bytes that glibc adds to each allocation.
TEST(Motion, AMillionOfThemFitInAThirdOfAGigabyte) {
    const Pose start = turned({1, 2, 3}, {1, 0, 1}, 0.3);
    const Pose goal = turned({3, 2, 1}, {1, 1, 1}, 1.3);
    const std::size_t screw = bytes_of_one([&]() -> Motion { return ScrewMotion::between(start, goal); });
    const std::size_t sweep = bytes_of_one([&]() -> Motion { return SweepMotion::between(start, goal); });
    std::cout << screw << " bytes a screw, " << sweep << " a sweep\n";
    if (screw == 0)
        GTEST_SKIP() << "another allocator than glibc's";
    EXPECT_LE(screw, 300U);
    EXPECT_LE(sweep, 320U);
}

} // namespace
} // namespace chasles::test
