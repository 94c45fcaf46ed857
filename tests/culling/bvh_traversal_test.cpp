// A traversal of two small hierarchies with leaf tests that only record what they are given.
#include "chasles/culling/bvh_traversal.h"

#include "chasles/culling/body_ball.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/any_trajectory.h"
#include "tests/query/bodies.h"
#include "tests/support/surface_distance.h"

#include <gtest/gtest.h>
#include <set>

namespace chasles::culling {
namespace {

using namespace test;

/// Records every pair of faces. By the test's wish it ends the search, or calls nodes apart.
struct Recorder {
    std::vector<FacePair> visited;
    double best_time = 1;
    std::size_t most = 1000000; ///< pairs until the search is over
    bool everything_is_apart = false;
    double apart_from = 2;

    [[nodiscard]] double best() const { return best_time; }
    [[nodiscard]] bool is_over() const { return visited.size() >= most; }
    [[nodiscard]] bool is_kept_apart(const NodePair&, double tau) const {
        return everything_is_apart || tau >= apart_from;
    }
    void test(const FacePair& faces) { visited.push_back(faces); }

    /// Whether the two faces are visited in an interval and a window that hold tau.
    [[nodiscard]] bool has_visited(std::uint32_t moving, std::uint32_t fixed, double tau) const {
        return std::ranges::any_of(visited, [&](const FacePair& pair) {
            return pair.moving == moving && pair.fixed == fixed && pair.interval.at(pair.when.lower) <= tau &&
                   tau <= pair.interval.at(pair.when.upper);
        });
    }
    [[nodiscard]] bool has_visited(std::uint32_t moving, std::uint32_t fixed) const {
        return std::ranges::any_of(visited,
                                   [&](const FacePair& pair) { return pair.moving == moving && pair.fixed == fixed; });
    }
};
static_assert(LeafTests<Recorder>);

/// Two bodies and the first piece of a motion.
struct Scene {
    Polyhedron moving;
    Polyhedron fixed;
    std::unique_ptr<const motion::AnyPiece> piece;
    motion::ControlMaps<double> maps = motion::double_maps(piece->cubic());

    Scene(const Polyhedron& mover, const Polyhedron& target, const Motion& motion)
        : moving(mover), fixed(target), piece(motion.trajectory().pieces()->at(0)) {}

    void run(Recorder& recorder, double margin = 0, bool by_time = true) const {
        const Bvh& a = moving.body().bvh();
        const Bvh& b = fixed.body().bvh();
        motion::Ball mover = ball_around(a);
        motion::Ball target = ball_around(b);
        mover.radius += margin;
        target.radius += margin;
        const double extent = 10;
        const TimeTree times({maps, elementary::error_scale(maps, extent, extent)},
                             motion::ChordDeviation(piece->cubic(), mover, target), mover, target, margin);
        BvhTraversal traversal(a, b, times, margin, by_time, recorder);
        traversal.run();
    }

    /// The distance of two faces, triangles of both bodies, at tau.
    [[nodiscard]] double distance(std::uint32_t face, std::uint32_t other, double tau) const {
        const Eigen::Isometry3d placement = piece->pose_at(tau).isometry();
        Triangle3<double> a, b;
        for (std::size_t k = 0; k < 3; ++k) {
            a[k] = placement * moving.vertices()[moving.body().face(face)[k]];
            b[k] = fixed.vertices()[fixed.body().face(other)[k]];
        }
        return std::sqrt(squared_distance_of_triangles<double>(a, b));
    }
};

/// Octahedra that turn by up to 2 radians on their way through each other.
Scene random_scene(std::mt19937& random) {
    return {random_octahedron(random).polyhedron(), random_octahedron(random).polyhedron(),
            Motion::sweep(random_pose(random, 1.5, 1), random_pose(random, 1.5, 1))};
}

TEST(BvhTraversal, VisitsEveryPairOfFacesThatMeetsWhenItMeets) {
    std::mt19937 random(821);
    int meetings = 0, skipped = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const Scene scene = random_scene(random);
        for (const double margin : {0.0, 0.05}) {
            Recorder recorder;
            scene.run(recorder, margin, trial % 2 == 0);
            for (std::uint32_t a = 0; a < 8; ++a)
                for (std::uint32_t b = 0; b < 8; ++b) {
                    bool meets = false;
                    for (int i = 0; i <= 40; ++i)
                        if (const double tau = i / 40.0; scene.distance(a, b, tau) <= margin) {
                            meets = true;
                            ASSERT_TRUE(recorder.has_visited(a, b, tau)) << "trial " << trial << ", tau " << tau;
                        }
                    meetings += meets ? 1 : 0;
                    skipped += recorder.has_visited(a, b) ? 0 : 1;
                }
        }
    }
    std::cout << meetings << " pairs meet, " << skipped << " were not visited\n";
    EXPECT_GT(meetings, 200);
    EXPECT_GT(skipped, 200);
}

TEST(BvhTraversal, VisitsNoPairOfFacesTwiceInOneInterval) {
    std::mt19937 random(822);
    for (int trial = 0; trial < 30; ++trial) {
        Recorder recorder;
        random_scene(random).run(recorder);
        std::set<std::tuple<std::uint32_t, std::uint32_t, double, double>> seen;
        for (const FacePair& pair : recorder.visited)
            EXPECT_TRUE(seen.insert({pair.moving, pair.fixed, pair.interval.lower, pair.interval.upper}).second);
    }
}

TEST(BvhTraversal, SkipsPairsThatStartAfterBest) {
    std::mt19937 random(823);
    int before = 0, left = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const Scene scene = random_scene(random);
        Recorder all, early;
        early.best_time = 0.3;
        scene.run(all);
        scene.run(early);
        for (const FacePair& pair : early.visited)
            EXPECT_LE(pair.interval.at(pair.when.lower), 0.3);
        for (const FacePair& pair : all.visited)
            if (pair.interval.at(pair.when.lower) <= 0.3) {
                EXPECT_TRUE(early.has_visited(pair.moving, pair.fixed, pair.interval.at(pair.when.lower)));
            }
        before += int(all.visited.size());
        left += int(early.visited.size());
    }
    EXPECT_LT(left, before / 2);
}

TEST(BvhTraversal, StopsWhenItIsOver) {
    std::mt19937 random(824);
    for (int trial = 0; trial < 30; ++trial) {
        const Scene scene = random_scene(random);
        Recorder all;
        scene.run(all);
        for (const std::size_t most : {std::size_t(0), std::size_t(1), all.visited.size() / 2}) {
            Recorder some;
            some.most = most;
            scene.run(some);
            EXPECT_EQ(some.visited.size(), std::min(most, all.visited.size()));
        }
    }
}

TEST(BvhTraversal, SkipsWhatIsKeptApart) {
    std::mt19937 random(825);
    for (int trial = 0; trial < 30; ++trial) {
        const Scene scene = random_scene(random);
        Recorder none;
        none.everything_is_apart = true;
        scene.run(none);
        EXPECT_TRUE(none.visited.empty());
        Recorder later;
        later.apart_from = 0.5;
        scene.run(later);
        for (const FacePair& pair : later.visited)
            EXPECT_LT(pair.interval.at(pair.when.lower), 0.5);
    }
}

TEST(BvhTraversal, HalvesIntervalsWherePathsBendAndGoesFromEarlierToLater) {
    std::mt19937 random(826);
    int halved = 0;
    for (int trial = 0; trial < 30; ++trial) {
        Recorder recorder;
        random_scene(random).run(recorder);
        for (std::size_t i = 0; i < recorder.visited.size(); ++i) {
            const TimeRange& range = recorder.visited[i].interval;
            const double width = range.width();
            EXPECT_EQ(std::exp2(std::round(std::log2(width))), width);
            EXPECT_EQ(range.lower / width, std::round(range.lower / width)) << "not dyadic";
            halved += width < 1 ? 1 : 0;
            if (i > 0) { // an interval comes before its halves, and the earlier half before the later one
                const TimeRange& last = recorder.visited[i - 1].interval;
                EXPECT_TRUE(range == last || range.lower >= last.upper ||
                            (range.lower >= last.lower && range.upper <= last.upper));
            }
            EXPECT_GE(recorder.visited[i].first_left, range.lower);
            EXPECT_LE(recorder.visited[i].first_left, range.upper);
        }
    }
    EXPECT_GT(halved, 1000);
}

TEST(BvhTraversal, HalvesNothingOnAStraightWay) {
    std::mt19937 random(827);
    const Polyhedron body = random_octahedron(random).polyhedron();
    Recorder recorder;
    Scene(body, body, Motion::sweep(shifted(-3, 0, 0), shifted(3, 0.1, 0))).run(recorder);
    EXPECT_FALSE(recorder.visited.empty());
    for (const FacePair& pair : recorder.visited)
        EXPECT_TRUE(pair.interval == TimeRange());
}

/// Both windows of a pair that is deferred to the halves meet in the middle: no time is lost between them.
TEST(BvhTraversal, APairThatMeetsAllTheTimeIsVisitedAllTheTime) {
    const Polyhedron large = triangle({-9, -9, 0}, {9, -9, 0}, {0, 9, 0}).polyhedron();
    const Polyhedron small = triangle({0, 0, -1}, {0, 0, 1}, {0.2, 0.1, 1}).polyhedron();
    const Scene scene(small, large, Motion::sweep(Pose(), turned({0, 0, 0}, {0, 0, 1}, 2)));
    Recorder recorder;
    scene.run(recorder);
    for (int i = 0; i <= 1024; ++i)
        EXPECT_TRUE(recorder.has_visited(0, 0, i / 1024.0)) << i;
}

} // namespace
} // namespace chasles::culling
