// The bodies of Rigid IPC's fixtures in touch with each other, with an overlap that is allowed: they go back as they
// came, slide, and meet when pushed, as FCL's distances of the moved bodies say. Source: docs/derivations/38-radius.md.
#include "chasles/base/invalid_input.h"
#include "chasles/query/first_contact.h"
#include "tests/data/rigid_ipc.h"
#include "tests/data/shared_data.h"
#include "tests/support/random_poses.h"

#include <array>
#include <cstdlib>
#include <optional>
#include <set>
#if CHASLES_TESTS_FCL
#include "tests/data/fcl_distance.h"
#endif

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// The overlap that is allowed, as a part of a body's size.
constexpr double allowed_part = 1e-6;

bool is_open(const Polyhedron& body) {
    return body.report().unpaired_edges > 0;
}

double size_of(const Polyhedron& body) {
    const MeshReport report = body.report();
    return (report.upper - report.lower).norm();
}

#if CHASLES_TESTS_FCL

/// Two bodies in touch: the way on which they came, backwards, and the way on.
struct TouchingPair {
    std::string name;
    Polyhedron moving, fixed;
    Motion moving_back, fixed_back, moving_on, fixed_on;
};

/// Where a body is after a flight, and how fast.
RigidIpcBody after(RigidIpcBody body, double seconds, RigidIpcFlight flight) {
    body.start = rigid_ipc_motion(body, seconds, flight).pose_at(1);
    if (flight == RigidIpcFlight::falling)
        body.velocity += seconds * body.acceleration;
    return body;
}

/// The flight up to here, backwards.
Motion back(RigidIpcBody body, double seconds, RigidIpcFlight flight) {
    body.velocity *= -1;
    body.angular_velocity *= -1;
    return rigid_ipc_motion(body, seconds, flight);
}

TouchingPair after_flight(const std::string& name, const RigidIpcBody& moving, const RigidIpcBody& fixed,
                          double seconds, RigidIpcFlight flight) {
    constexpr double on = 0.05; // seconds
    const RigidIpcBody a = after(moving, seconds, flight), b = after(fixed, seconds, flight);
    return {name,
            a.shape,
            b.shape,
            back(a, seconds, flight),
            back(b, seconds, flight),
            rigid_ipc_motion(a, on, flight),
            rigid_ipc_motion(b, on, flight)};
}

/// All contacts of a flight.
std::vector<TouchingPair> met_in_flight(const RigidIpcFixture& fixture, double seconds, RigidIpcFlight flight) {
    std::vector<TouchingPair> pairs;
    for (const SceneContact& contact : rigid_ipc_scene(fixture, seconds, flight).all_contacts().contacts)
        pairs.push_back(after_flight(fixture.name, fixture.bodies[contact.moving], fixture.bodies[contact.fixed],
                                     seconds * contact.contact.time.upper, flight));
    return pairs;
}

Eigen::AlignedBox3d box_in_world(const RigidIpcBody& body) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.shape.vertices())
        box.extend(body.start.isometry() * vertex);
    return box;
}

/// Pairs that touch where the fixture starts, bodies of one group among them. They are moved along
/// the line between the middles of their boxes.
std::vector<TouchingPair> in_touch_at_start(const RigidIpcFixture& fixture) {
    std::vector<TouchingPair> pairs;
    for (std::size_t i = 0; i < fixture.bodies.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            RigidIpcBody moving = fixture.bodies[i], fixed = fixture.bodies[j];
            const Eigen::AlignedBox3d a = box_in_world(moving), b = box_in_world(fixed);
            const FirstContact start =
                first_contact({moving.shape,
                               fixed.shape,
                               ScrewMotion::relative(moving.start, moving.start, fixed.start, fixed.start),
                               {.margin = 1e-9 * std::min(size_of(moving.shape), size_of(fixed.shape))}});
            if (start.verdict != Verdict::contact_at_start)
                continue;
            const auto at_rest = [](RigidIpcBody& body) {
                body.velocity = body.angular_velocity = body.acceleration = Vector3d::Zero();
            };
            at_rest(moving);
            at_rest(fixed);
            moving.velocity = b.center() - a.center();
            pairs.push_back(after_flight(fixture.name, moving, fixed, 0, RigidIpcFlight::even));
            pairs.back().moving_back = back(moving, 1, RigidIpcFlight::even);
        }
    return pairs;
}

struct OverlapTally {
    int pairs = 0, touching = 0, asked = 0, back = 0, slides = 0, slides_clear = 0, on = 0;
    std::array<int, 2> open{}; ///< pairs with an open surface as the moving and as the fixed body
};

Pose in_frame_of(const Pose& frame, const Pose& pose) {
    return Pose(Eigen::Isometry3d(frame.isometry().inverse() * pose.isometry()));
}

/// A pair of bodies with radii below 0, or 0.
class OverlappingPair {
public:
    OverlappingPair(std::string name, const Polyhedron& moving, const Polyhedron& fixed)
        : name_(std::move(name)), moving_(moving), fixed_(fixed), distance_(moving, fixed),
          size_(std::min(size_of(moving), size_of(fixed))) {}

    /// The answer, which agrees with FCL at many times of the motions.
    [[nodiscard]] FirstContact ask(const char* what, const Motion& moving, const Motion& fixed) const {
        const FirstContact found = first_contact({moving_, fixed_, relative(moving, fixed)});
        const auto distance_at = [&](double time) {
            return distance_(in_frame_of(fixed.pose_at(time), moving.pose_at(time)));
        };
        const int samples = std::getenv("CHASLES_LONG") ? 100 : 10; // NOLINT(concurrency-mt-unsafe)
        const double until = found.verdict == Verdict::clear ? 1 : found.time.lower;
        for (int i = 0; i < samples; ++i)
            if (const double time = until * i / samples; time < until) {
                EXPECT_GT(distance_at(time), 0) << name_ << ", " << what << " at " << time;
            }
        if (found.verdict != Verdict::clear) {
            EXPECT_LT(distance_at(found.time.upper), 1e-9 * size_) << name_ << ", " << what;
        }
        return found;
    }

private:
    std::string name_;
    Polyhedron moving_, fixed_;
    FclDistance distance_;
    double size_;
};

/// Back as they came, to four sides, and on.
void ask_about(const TouchingPair& pair, const Polyhedron& moving, const Polyhedron& fixed, Random& random,
               OverlapTally& tally) {
    ++tally.asked;
    const OverlappingPair bodies(pair.name, moving, fixed);
    tally.back += bodies.ask("back", pair.moving_back, pair.fixed_back).verdict == Verdict::clear;
    const Pose start = pair.moving_on.pose_at(0);
    const Motion rest = Motion::at_rest(pair.fixed_on.pose_at(0));
    const double way = 0.1 * std::min(size_of(moving), size_of(fixed));
    for (int i = 0; i < 4; ++i) {
        const Pose goal(start.translation + way * random_point(random, 1).normalized(), start.rotation);
        ++tally.slides;
        tally.slides_clear += bodies.ask("slides", Motion::velocity(start, goal), rest).verdict == Verdict::clear;
    }
    tally.on += bodies.ask("on", pair.moving_on, pair.fixed_on).verdict == Verdict::contact;
}

/// The overlap is that of the moving body, of the fixed one, or shared by both.
void ask_with_overlaps(const TouchingPair& pair, Random& random, OverlapTally& tally) {
    const double allowed = allowed_part * std::min(size_of(pair.moving), size_of(pair.fixed));
    const bool moving_is_open = is_open(pair.moving), fixed_is_open = is_open(pair.fixed);
    tally.open[0] += moving_is_open;
    tally.open[1] += fixed_is_open;
    if (!moving_is_open)
        ask_about(pair, pair.moving.with_radius(-allowed), pair.fixed, random, tally);
    if (!fixed_is_open)
        ask_about(pair, pair.moving, pair.fixed.with_radius(-allowed), random, tally);
    if (!moving_is_open && !fixed_is_open)
        ask_about(pair, pair.moving.with_radius(-allowed / 2), pair.fixed.with_radius(-allowed / 2), random, tally);
}

TEST(AllowedOverlapsOfScenes, BodiesInTouchGoBackAndMeetWhenPushed) {
    CHASLES_REQUIRE_DATA("rigid-ipc-scenes");
    Random random(4411);
    OverlapTally tally;
    std::size_t at_start = 0;
    for (const std::string& name : rigid_ipc_names(shared_data("rigid-ipc-scenes"))) {
        const RigidIpcFixture fixture = read_rigid_ipc(shared_data("rigid-ipc-scenes"), name);
        std::vector<TouchingPair> pairs = in_touch_at_start(fixture);
        at_start += pairs.size();
        for (const RigidIpcFlight flight : {RigidIpcFlight::even, RigidIpcFlight::falling})
            for (TouchingPair& pair : met_in_flight(fixture, std::min(1.0, fixture.max_time), flight))
                pairs.push_back(std::move(pair));
        for (const TouchingPair& pair : pairs) {
            ++tally.pairs;
            const Motion start =
                relative(Motion::at_rest(pair.moving_on.pose_at(0)), Motion::at_rest(pair.fixed_on.pose_at(0)));
            tally.touching += first_contact({pair.moving, pair.fixed, start}).verdict == Verdict::contact_at_start;
            ask_with_overlaps(pair, random, tally);
        }
    }
    print_figures("%d pairs, %zu of them as the fixtures start; %d in contact as given; %d and %d bodies are open; %d "
                  "with an overlap: back %d clear, %d of %d slides clear, on %d contacts",
                  tally.pairs, at_start, tally.touching, tally.open[0], tally.open[1], tally.asked, tally.back,
                  tally.slides_clear, tally.slides, tally.on);
    EXPECT_EQ(at_start, 7U) << "cubes on a plane and at each other; walls";
    EXPECT_GT(tally.touching, 90);
    EXPECT_GT(tally.asked, 90);
    EXPECT_EQ(tally.back, tally.asked);
    EXPECT_EQ(tally.on, tally.asked);
    EXPECT_GT(tally.slides_clear, tally.slides / 4);
    EXPECT_LT(tally.slides_clear, tally.slides * 3 / 4);
}

#endif

TEST(AllowedOverlapsOfScenes, ClosedBodiesMoveInwardsAndOpenOnesAreRefused) {
    CHASLES_REQUIRE_DATA("rigid-ipc-scenes");
    int bodies = 0, closed = 0, open = 0, thick = 0;
    for (const std::string& name : rigid_ipc_names(shared_data("rigid-ipc-scenes"))) {
        const RigidIpcFixture fixture = read_rigid_ipc(shared_data("rigid-ipc-scenes"), name);
        std::set<const Body*> seen;
        for (const RigidIpcBody& body : fixture.bodies) {
            ++bodies;
            if (!seen.insert(&body.shape.body()).second)
                continue;
            const double size = size_of(body.shape);
            if (is_open(body.shape)) {
                ++open;
                EXPECT_THROW((void)body.shape.with_radius(-allowed_part * size), InvalidInput) << body.name;
                continue;
            }
            ++closed;
            EXPECT_NO_THROW((void)body.shape.with_radius(-allowed_part * size)) << name << ", " << body.name;
            try {
                thick += body.shape.with_radius(-1e-3 * size).report().unpaired_edges == 0;
            } catch (const InvalidInput& error) {
                print_figures("%s, %s: %s", name.c_str(), body.name.c_str(), error.what());
            }
        }
    }
    print_figures("%d bodies; %d closed shapes, %d of them move by a thousandth of their size; %d open ones", bodies,
                  closed, thick, open);
    EXPECT_GT(closed, 30);
    EXPECT_GT(open, 5);
    EXPECT_GE(thick, closed - 4);
}

} // namespace
} // namespace chasles::test
