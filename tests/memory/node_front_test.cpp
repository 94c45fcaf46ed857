// The front of two bodies against the distances of all pairs of triangles.
#include "chasles/memory/node_front.h"

#include "tests/memory/wanderer.h"

#include <gtest/gtest.h>

namespace chasles::memory {
namespace {

using search::PieceContext;

/// Asks for all that a body meets on its way, as neighbour lists do.
class Watch {
public:
    explicit Watch(const Wanderer& bodies)
        : bodies_(bodies), travel_(bodies.moving().body()), front_(bodies.moving().body(), bodies.fixed().body()) {
        front_.restart();
    }

    /// The number of pairs of nodes that were tested.
    std::uint64_t go(const PieceContext& context, double margin) {
        const culling::TimeInterval whole = context.interval(margin, {});
        const Way way = way_of(context, whole, margin);
        front_.arrive(travel_.go_to(way));
        std::vector<NodeFront::PairOfNodes> leaves;
        Work work;
        const double bound = margin + way.travel + with_rounding(travel_.sum());
        front_.split({whole.boxes, way, bound, 1 << 20}, leaves, work);
        for (const auto& [moving, fixed] : leaves)
            EXPECT_TRUE(given_.insert({face_of(bodies_.moving(), moving), face_of(bodies_.fixed(), fixed)}).second)
                << "a pair of faces is given once";
        return work.node_pairs;
    }
    [[nodiscard]] const std::set<std::pair<std::uint32_t, std::uint32_t>>& given() const { return given_; }

private:
    static std::uint32_t face_of(const Polyhedron& body, std::uint32_t leaf) {
        EXPECT_TRUE(body.body().bvh().nodes()[leaf].is_leaf());
        return body.body().bvh().nodes()[leaf].first;
    }

    const Wanderer& bodies_;
    Travel travel_;
    NodeFront front_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> given_;
};

TEST(NodeFront, GivesAllPairsOfFacesThatComeNear) {
    Wanderer bodies;
    Watch watch(bodies);
    std::size_t near_pairs = 0;
    std::uint64_t first = 0, later = 0;
    constexpr int pieces = 60;
    for (int i = 0; i < pieces; ++i) {
        const Motion way = bodies.next();
        const double margin = i % 2 == 0 ? 0.02 : 0.005;
        // another way is asked about first, and then not gone
        const Pose aside = test::shifted(0.08 * (i % 3 - 1), 0.08 * (i / 3 % 3 - 1), 0.08 * (i / 9 % 3 - 1));
        const Motion other = ScrewMotion::between(way.pose_at(0), test::composed(aside, way.pose_at(0)));
        const std::uint64_t tested = watch.go(bodies.context(other), margin) + watch.go(bodies.context(way), margin);
        (i == 0 ? first : later) += tested;
        for (const auto& near : sampled_near(bodies, way, margin * (1 - 1e-9))) {
            ++near_pairs;
            EXPECT_TRUE(watch.given().contains(near)) << "piece " << i;
        }
    }
    EXPECT_GT(near_pairs, 500U);
    EXPECT_LT(double(later) / (pieces - 1), 0.9 * double(first)) << "many pairs of nodes need no new test";
    EXPECT_LT(watch.given().size(), bodies.moving().face_count() * bodies.fixed().face_count() / 4);
}

TEST(NodeFront, StopsWhereThereAreTooMany) {
    const Wanderer bodies;
    const Motion rest = Motion::at_rest(Wanderer::home());
    const PieceContext context = bodies.context(rest);
    const double margin = 10;
    const culling::TimeInterval whole = context.interval(margin, {});
    NodeFront front(bodies.moving().body(), bodies.fixed().body());
    front.restart();
    std::vector<NodeFront::PairOfNodes> leaves;
    Work work;
    front.split({whole.boxes, way_of(context, whole, margin), margin + 1, 100}, leaves, work);
    EXPECT_GT(front.size() + leaves.size(), 100U);
    EXPECT_LT(front.size() + leaves.size(), 110U);
}

} // namespace
} // namespace chasles::memory
