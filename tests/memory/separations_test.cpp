// Separations against heights of corners above planes.
#include "chasles/memory/separations.h"

#include "tests/memory/wanderer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace chasles::memory {
namespace {

using search::PieceContext;

/// A face of the moving body above a plane of the fixed body's frame.
struct FaceAndPlane {
    std::uint32_t face = 0;
    Eigen::Vector3f along = Eigen::Vector3f::Zero(); ///< no longer than 1
    double offset = 0;

    [[nodiscard]] double gap(const Polyhedron& body, const Pose& pose) const {
        double least = 1e300;
        for (const std::uint32_t corner : body.body().face(face))
            least = std::min(least, along.cast<double>().dot(pose.isometry() * body.body().vertices()[corner]));
        return least - offset;
    }
    [[nodiscard]] algebra::Vector3<float> vector() const { return {along.x(), along.y(), along.z()}; }
};

const BvhNode& leaf_of(const Polyhedron& body, std::uint32_t face) {
    return *std::ranges::find_if(body.body().bvh().nodes(),
                                 [&](const BvhNode& node) { return node.is_leaf() && node.first == face; });
}

/// Goes ways one after the other, and asks what is due on each.
class Walk {
public:
    explicit Walk(const Wanderer& bodies)
        : bodies_(bodies), travel_(bodies.moving().body()), apart_(bodies.moving().body()) {}

    Separations& apart() { return apart_; }
    std::vector<std::size_t> due(const Motion& motion, double margin) {
        const PieceContext context = bodies_.context(motion);
        const Way way = way_of(context, context.interval(margin, {}), margin);
        apart_.arrive(travel_.go_to(way));
        return apart_.due(way, margin + way.travel + with_rounding(travel_.sum()));
    }

private:
    const Wanderer& bodies_;
    Travel travel_;
    Separations apart_;
};

FaceAndPlane random_plane(const Wanderer& bodies, std::mt19937& random, const Pose& pose, double gap) {
    FaceAndPlane pair{std::uint32_t(random() % bodies.moving().face_count())};
    pair.along = (test::random_vector(random, 1).normalized() * (1 - 1e-6)).cast<float>();
    pair.offset = pair.gap(bodies.moving(), pose) - gap;
    return pair;
}

TEST(Separations, NothingIsFartherApartThanItIs) {
    Wanderer bodies;
    std::mt19937 random(5);
    int told = 0, trials = 0;
    for (int i = 0; i < 2000; ++i) {
        // the way is gone to its end, or left before
        const Motion way = bodies.next();
        const Pose arrival = way.pose_at(i % 2 == 0 ? 1 : 0.4);
        const FaceAndPlane pair = random_plane(bodies, random, way.pose_at(0), test::uniform(random, 0.001, 0.1));
        Walk walk(bodies);
        walk.apart().append_block();
        walk.apart().put(i % 4, leaf_of(bodies.moving(), pair.face));
        ASSERT_EQ(walk.due(way, 1e-4), std::vector<std::size_t>{std::size_t(i % 4)}) << "nothing is known of it";
        walk.apart().put_apart(i % 4, pair.vector(), pair.gap(bodies.moving(), way.pose_at(0)));
        const double gap = pair.gap(bodies.moving(), arrival);
        if (gap <= 1e-3)
            continue;
        ++trials;
        Walk other = walk;
        EXPECT_FALSE(walk.due(Motion::at_rest(arrival), gap * (1 + 1e-5)).empty()) << "trial " << i;
        told += other.due(Motion::at_rest(arrival), 0.8 * gap).empty() ? 1 : 0;
    }
    EXPECT_GT(trials, 1500);
    EXPECT_GT(told, 0.8 * trials) << "most of the gap is known";
}

/// Whether a way brings a pair of many near is told by its ends.
TEST(Separations, AllThatMayComeNearIsDue) {
    Wanderer bodies;
    std::mt19937 random(6);
    Walk walk(bodies);
    constexpr std::size_t count = 400;
    std::vector<FaceAndPlane> pairs;
    for (std::size_t i = 0; i < count; ++i) {
        pairs.push_back(random_plane(bodies, random, Wanderer::home(), test::uniform(random, 0, 0.05)));
        if (i % Separations::block_size == 0)
            walk.apart().append_block();
        walk.apart().put(i, leaf_of(bodies.moving(), pairs[i].face));
    }
    std::size_t near = 0, due_in_all = 0, asked = 0, skipped_although_within_travel = 0;
    for (int k = 0; k < 300; ++k) {
        const Motion way = bodies.next();
        if (way.trajectory().pieces()->size() > 1)
            continue; // its end is not that of the piece that is asked about
        const double margin = k % 3 == 0 ? 1e-2 : 1e-3;
        const std::vector<std::size_t> due = walk.due(way, margin);
        EXPECT_TRUE(std::ranges::is_sorted(due));
        const double travel = way_of(bodies.context(way), bodies.context(way).interval(margin, {}), margin).travel;
        for (std::size_t i = 0; i < count; ++i) {
            const bool is_due = std::ranges::binary_search(due, i);
            EXPECT_TRUE(walk.apart().holds(i) || !is_due);
            if (!walk.apart().holds(i))
                continue;
            const double start = pairs[i].gap(bodies.moving(), way.pose_at(0));
            const double least = std::min(start, pairs[i].gap(bodies.moving(), way.pose_at(1)));
            EXPECT_TRUE(is_due || least > margin) << "way " << k << ", pair " << i;
            near += least <= margin ? 1 : 0;
            skipped_although_within_travel += !is_due && start < margin + travel ? 1 : 0;
            ++asked;
            if (!is_due)
                continue;
            ++due_in_all;
            if (random() % 500 == 0)
                walk.apart().remove(i);
            else
                walk.apart().put_apart(i, pairs[i].vector(), start);
        }
    }
    EXPECT_GT(near, 1000U);
    EXPECT_LT(due_in_all, asked / 2);
    EXPECT_GT(skipped_although_within_travel, 1000U) << "told by how their faces move";
}

TEST(Separations, AnEmptiedPlaceTakesAnotherPair) {
    Wanderer bodies;
    Walk walk(bodies);
    const Motion way = bodies.next();
    walk.apart().append_block();
    EXPECT_TRUE(walk.due(way, 1).empty());
    walk.apart().put(2, leaf_of(bodies.moving(), 0));
    EXPECT_TRUE(walk.apart().holds(2));
    EXPECT_EQ(walk.due(way, 1), std::vector<std::size_t>{2});
    walk.apart().remove(2);
    EXPECT_FALSE(walk.apart().holds(2));
    EXPECT_TRUE(walk.due(way, 1).empty());
    walk.apart().put(2, leaf_of(bodies.moving(), 1));
    EXPECT_EQ(walk.due(way, 1), std::vector<std::size_t>{2});
    walk.apart().clear();
    EXPECT_TRUE(walk.due(way, 1).empty());
}

} // namespace
} // namespace chasles::memory
