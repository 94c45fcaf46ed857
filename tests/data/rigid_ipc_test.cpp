// The fixtures of Rigid IPC as scenes, against dense discrete samples by FCL. Samples can only refute: no pair of
// bodies may overlap before its proven contact, and at the contact the bodies have to be near each other.
// CHASLES_LONG=1 takes a thousand samples instead of a hundred.
#include "tests/data/rigid_ipc.h"

#include "chasles/query/first_contact.h"
#include "tests/data/shared_data.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#if CHASLES_TESTS_FCL
#include "bench/fcl_scene.h"

#include <fcl/narrowphase/distance.h>
#endif

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// How long a fixture is followed where it is followed for longer than a step.
constexpr double longest = 1;

RigidIpcFixture fixture_named(const std::string& name) {
    return read_rigid_ipc(shared_data("rigid-ipc-scenes"), name);
}

/// A question about a fixture.
struct Flight {
    std::string name;
    double seconds;
    RigidIpcFlight kind;
};

/// One time step and a longer time at the given velocities, and a free fall.
std::vector<Flight> flights_of(const RigidIpcFixture& fixture) {
    const double seconds = std::min(longest, fixture.max_time);
    return {{"step", fixture.time_step, RigidIpcFlight::even},
            {"even", seconds, RigidIpcFlight::even},
            {"fall", seconds, RigidIpcFlight::falling}};
}

/// By Newton and Euler, without the library's motions.
Eigen::Isometry3d place_of(const RigidIpcBody& body, double t, RigidIpcFlight flight) {
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() = body.start.translation + t * body.velocity;
    if (flight == RigidIpcFlight::falling)
        place.translation() += t * t / 2 * body.acceleration;
    const Vector3d turn = t * body.angular_velocity;
    place.linear() = (turn.isZero(0) ? Eigen::Matrix3d::Identity().eval()
                                     : Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()) *
                     Eigen::Quaterniond(body.start.rotation).toRotationMatrix();
    return place;
}

TEST(RigidIpc, MotionsAreEvenOrFallFreely) {
    CHASLES_REQUIRE_DATA("rigid-ipc-scenes");
    int moving = 0;
    for (const std::string& name : rigid_ipc_names(shared_data("rigid-ipc-scenes"))) {
        const RigidIpcFixture fixture = fixture_named(name);
        for (const Flight& flight : flights_of(fixture))
            for (const RigidIpcBody& body : fixture.bodies) {
                const Motion motion = rigid_ipc_motion(body, flight.seconds, flight.kind);
                for (const double share : {0.0, 0.3, 0.7, 1.0}) {
                    const Eigen::Isometry3d expected = place_of(body, share * flight.seconds, flight.kind);
                    const double size = 1 + expected.translation().norm();
                    EXPECT_LT((motion.pose_at(share).isometry().matrix() - expected.matrix()).norm(), 1e-13 * size)
                        << name << ", " << flight.name << ", " << body.name;
                }
                moving += body.velocity.isZero(0) && body.angular_velocity.isZero(0) ? 0 : 1;
            }
    }
    EXPECT_GT(moving, 30);
}

Eigen::AlignedBox3d box_in_world(const RigidIpcBody& body) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.shape.vertices())
        box.extend(body.start.isometry() * vertex);
    return box;
}

/// Checks the comment of rigid_ipc.h with fixtures in which another convention puts bodies elsewhere.
TEST(RigidIpc, FixturesAreReadAsTheSimulatorReadsThem) {
    CHASLES_REQUIRE_DATA("rigid-ipc-scenes");
    EXPECT_EQ(rigid_ipc_names(shared_data("rigid-ipc-scenes")).size(), 25U);
    const RigidIpcFixture bat = fixture_named("unit-tests/bat");
    const Vector3d sizes = box_in_world(bat.bodies[0]).sizes();
    EXPECT_LT((sizes - Vector3d(0.0635, 0.0635, 0.8636)).norm(), 1e-12) << "sized first, then turned";
    EXPECT_NEAR(bat.bodies[0].angular_velocity.y(), 2000 * std::numbers::pi / 180, 1e-12) << "degrees a second";
    EXPECT_EQ(bat.bodies[0].acceleration, Vector3d::Zero()) << "its translations are fixed";
    EXPECT_EQ(bat.bodies[2].group, "fixed") << "all of its freedoms are fixed";

    const RigidIpcFixture corner = fixture_named("unit-tests/tet-corner");
    const RigidIpcBody& tet = corner.bodies[4];
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& vertex : tet.shape.vertices())
        mean += vertex / 4;
    EXPECT_LT(mean.norm(), 1e-15) << "the origin is the centre of mass";
    EXPECT_LT((box_in_world(tet).min() - Vector3d(-0.4995, 0.6, -0.4995)).norm(), 1e-12)
        << "the position is that of the origin of the mesh";

    const RigidIpcFixture gears = fixture_named("mechanisms/gears/single-kinematic");
    EXPECT_EQ(gears.unused, 2U);
    ASSERT_EQ(gears.bodies.size(), 2U);
    const Eigen::AlignedBox3d first = box_in_world(gears.bodies[0]), second = box_in_world(gears.bodies[1]);
    EXPECT_NEAR(first.sizes().z(), second.sizes().z(), 1e-12) << "about x, then about z: both have their axes along z";
    EXPECT_EQ(fixture_named("unit-tests/tunnel/3-walls").bodies[0].group, "fixed") << "before its own group";
}

struct Gap {
    std::string fixture;
    double height;
    double gravity;
};

/// Where a body falls straight onto what is below it, the time follows from the gap.
TEST(RigidIpc, FallsThroughKnownGapsTakeTheirTime) {
    CHASLES_REQUIRE_DATA("rigid-ipc-scenes");
    const std::vector<Gap> gaps{{"chain/10-links", 0.05, 9.81},
                                {"unit-tests/5-cubes", 1.5, 9.8},
                                {"unit-tests/erleben/cliff-edges", 0.05, 9.8},
                                {"unit-tests/erleben/internal-edges", 0.05, 9.8},
                                {"unit-tests/erleben/spikes", 1e-4, 9.8},
                                {"unit-tests/erleben/wedges", 1e-4, 9.8},
                                {"unit-tests/lever-arm", 4, 9.81}};
    for (const Gap& gap : gaps) {
        const SceneAnswer answer =
            rigid_ipc_scene(fixture_named(gap.fixture), longest, RigidIpcFlight::falling).first_contact();
        ASSERT_EQ(answer.verdict, Verdict::contact) << gap.fixture;
        EXPECT_NEAR(answer.clear_until, std::sqrt(2 * gap.height / gap.gravity), 1e-12) << gap.fixture;
        EXPECT_LT(answer.contacts[0].contact.time.upper - answer.clear_until, 1e-12) << gap.fixture;
    }
}

#if CHASLES_TESTS_FCL

/// The fixture after a free fall, through whatever was in the way.
RigidIpcFixture later(RigidIpcFixture fixture, double t) {
    for (RigidIpcBody& body : fixture.bodies) {
        body.start = Pose(place_of(body, t, RigidIpcFlight::falling));
        body.velocity += t * body.acceleration;
    }
    return fixture;
}

/// The results of all questions of a kind.
struct Tally {
    int clear = 0, contact = 0, at_start = 0;
    std::size_t touching = 0, uncertain = 0, overlaps = 0;
};

/// One question, and FCL's opinion at single times.
class SampledScene {
public:
    SampledScene(std::string name, const RigidIpcFixture& fixture, const Flight& flight)
        : name_(std::move(name)), seconds_(flight.seconds),
          scene_(rigid_ipc_scene(fixture, flight.seconds, flight.kind)), fcl_(scene_) {}

    void expect_agreement(Tally& tally) {
        const Stopwatch watch;
        const SceneAnswer first = scene_.first_contact();
        const double first_ms = 1e3 * watch.seconds();
        const SceneAnswer all = scene_.all_contacts();
        const double all_ms = 1e3 * watch.seconds() - first_ms;
        expect_one_answer(first, all);
        for (const SceneContact& contact : all.contacts)
            by_pair_[std::minmax(contact.moving, contact.fixed)] = &contact.contact;
        const int samples = std::getenv("CHASLES_LONG") != nullptr ? 1000 : 100;
        expect_no_earlier_overlap(samples);
        for (const SceneContact& contact : all.contacts)
            expect_contact(contact, samples);
        print_figures("%-58s %3zu bodies %4zu pairs, %s; %zu pairs touch, %zu of them not certain; %zu overlaps in "
                      "samples; first %.2f ms, all %.2f ms",
                      name_.c_str(), scene_.bodies().size(), all.pairs, verdict_text(first).c_str(),
                      all.contacts.size(), uncertain_, overlaps_, first_ms, all_ms);
        ++(first.verdict == Verdict::clear     ? tally.clear
           : first.verdict == Verdict::contact ? tally.contact
                                               : tally.at_start);
        tally.touching += all.contacts.size();
        tally.uncertain += uncertain_;
        tally.overlaps += overlaps_;
    }

private:
    using Pair = std::pair<std::size_t, std::size_t>;

    [[nodiscard]] std::string verdict_text(const SceneAnswer& answer) const {
        if (answer.contacts.empty())
            return "clear";
        const SceneContact& contact = answer.contacts[0];
        const std::string bodies = scene_.bodies()[contact.moving].name + " and " + scene_.bodies()[contact.fixed].name;
        if (answer.verdict == Verdict::contact_at_start)
            return bodies + " touch at the start";
        std::array<char, 40> time{};
        std::snprintf(time.data(), time.size(), " touch at %.9f s", answer.clear_until * seconds_);
        return bodies + time.data();
    }
    void expect_one_answer(const SceneAnswer& first, const SceneAnswer& all) const {
        EXPECT_NE(first.verdict, Verdict::unknown) << name_;
        EXPECT_EQ(first.verdict, all.verdict) << name_;
        EXPECT_EQ(first.clear_until, all.clear_until) << name_;
        EXPECT_EQ(first.verdict == Verdict::clear, all.contacts.empty()) << name_;
        SceneQuery yes_or_no;
        yes_or_no.options.find = Find::any;
        EXPECT_EQ(scene_.first_contact(yes_or_no).verdict == Verdict::clear, all.contacts.empty()) << name_;
    }
    void expect_no_overlap_before_contact(const Pair& pair, double time) const {
        const auto found = by_pair_.find(pair);
        const bool is_known = found != by_pair_.end() && found->second->time.lower <= time;
        EXPECT_TRUE(is_known) << name_ << ": " << scene_.bodies()[pair.first].name << " overlaps with "
                              << scene_.bodies()[pair.second].name << " at " << time;
    }
    /// All pairs, all along.
    void expect_no_earlier_overlap(int samples) {
        for (int i = 0; i <= samples; ++i)
            for (const Pair& pair : fcl_.overlaps_at(double(i) / samples)) {
                expect_no_overlap_before_contact(pair, double(i) / samples);
                ++overlaps_;
            }
    }
    bool overlap_at(const Pair& pair, double time) {
        const auto [a, b] = fcl_.pair_at(pair.first, pair.second, time);
        fcl::CollisionResultd result;
        return fcl::collide(a, b, fcl::CollisionRequestd(), result) > 0;
    }
    double distance_at(const Pair& pair, double time) {
        const auto [a, b] = fcl_.pair_at(pair.first, pair.second, time);
        fcl::DistanceResultd result;
        return fcl::distance(a, b, fcl::DistanceRequestd(), result);
    }
    /// No sample just before the contact overlaps; at its time the bodies are near each other, and they overlap soon.
    void expect_contact(const SceneContact& contact, int samples) {
        const Pair pair = std::minmax(contact.moving, contact.fixed);
        const Bracket time = contact.contact.time;
        uncertain_ += contact.contact.certain ? 0 : 1;
        for (int i = 1; i <= samples; ++i)
            if (const double before = time.lower - 0.01 * i / samples; before >= 0 && overlap_at(pair, before))
                expect_no_overlap_before_contact(pair, before);
        EXPECT_LE(distance_at(pair, time.upper), 1e-6) << name_ << " at " << time.upper;
        bool overlap = overlap_at(pair, time.upper);
        for (double after = 1e-7; after < 0.1 && !overlap; after *= 4)
            overlap = overlap_at(pair, std::min(1.0, time.upper + after));
        EXPECT_TRUE(overlap) << name_ << ": no sample sees the contact at " << time.upper;
    }

    std::string name_;
    double seconds_;
    Scene scene_;
    bench::FclScene fcl_;
    std::map<Pair, const FirstContact*> by_pair_;
    std::size_t uncertain_ = 0, overlaps_ = 0;
};

void print_tally(const std::string& name, const Tally& tally) {
    print_figures(
        "%s: %d clear, %d contact, %d at the start; %zu pairs touch, %zu of them not certain; %zu overlaps in "
        "samples",
        name.c_str(), tally.clear, tally.contact, tally.at_start, tally.touching, tally.uncertain, tally.overlaps);
}

TEST(RigidIpc, FixturesAgreeWithSamples) {
    CHASLES_REQUIRE_DATA("rigid-ipc-scenes");
    std::map<std::string, Tally> tallies;
    for (const std::string& name : rigid_ipc_names(shared_data("rigid-ipc-scenes"))) {
        const RigidIpcFixture fixture = fixture_named(name);
        for (const Flight& flight : flights_of(fixture))
            SampledScene(name + ", " + flight.name, fixture, flight).expect_agreement(tallies[flight.name]);
    }
    for (const auto& [name, tally] : tallies)
        print_tally(name, tally);
    EXPECT_EQ(tallies["step"].contact, 4) << "piston, gears, spike in a hole, tunneling";
    EXPECT_EQ(tallies["even"].contact, 5) << "the bat, too";
    EXPECT_EQ(tallies["fall"].contact, 21) << "four have no gravity and no way to touch";
    for (const auto& [name, tally] : tallies)
        EXPECT_EQ(tally.clear + tally.contact, 25) << "no fixture starts in contact";
}

/// No fixture starts in contact, but bodies that have fallen through each other do.
TEST(RigidIpc, LaterStartsAreInContactWhereSamplesAre) {
    CHASLES_REQUIRE_DATA("rigid-ipc-scenes");
    Tally tally;
    for (const std::string& name : rigid_ipc_names(shared_data("rigid-ipc-scenes"))) {
        const RigidIpcFixture fixture = fixture_named(name);
        for (const double start : {0.15, 0.5}) {
            const Flight flight{"later", std::min(longest, fixture.max_time) * (1 - start), RigidIpcFlight::falling};
            const RigidIpcFixture started = later(fixture, std::min(longest, fixture.max_time) * start);
            SampledScene(name + (start < 0.3 ? ", later" : ", much later"), started, flight).expect_agreement(tally);
        }
    }
    print_tally("later", tally);
    EXPECT_GE(tally.at_start, 15);
    EXPECT_GE(tally.contact, 8);
}

#endif

} // namespace
} // namespace chasles::test
