// How far points of a body get on a way, and where a body came to, against the places of its vertices.
#include "chasles/memory/way.h"

#include "tests/memory/wanderer.h"

#include <gtest/gtest.h>

namespace chasles::memory {
namespace {

using search::PieceContext;

Way way_on(const PieceContext& context, double margin) {
    return way_of(context, context.interval(margin, {}), margin);
}

/// The greatest distance of two places of a vertex.
template <class A, class B>
double farthest(const Polyhedron& body, const A& a, const B& b) {
    double most = 0;
    for (const Eigen::Vector3d& vertex : body.vertices())
        most = std::max(most, length(a(motion::vector_in<double>(vertex)) - b(motion::vector_in<double>(vertex))));
    return most;
}

TEST(Way, ItsTravelBoundsThatOfPoints) {
    Wanderer bodies;
    for (int i = 0; i < 100; ++i) {
        const Motion motion = bodies.next();
        const Way way = way_on(bodies.context(motion), 0.01);
        for (const double time : {0.25, 0.5, 0.75, 1.0}) {
            const Eigen::Isometry3d pose = motion.pose_at(time).isometry(), start = motion.pose_at(0).isometry();
            double most = 0;
            for (const Eigen::Vector3d& vertex : bodies.moving().vertices())
                most = std::max(most, (pose * vertex - start * vertex).norm());
            EXPECT_LE(most, way.travel) << "piece " << i;
            if (time == 1) {
                EXPECT_LE(way.travel, 4 * most + 1e-9) << "piece " << i;
            }
        }
    }
}

TEST(Way, RestsIfNoPointMoves) {
    Wanderer bodies;
    for (int i = 0; i < 20; ++i) {
        const Motion motion = bodies.next();
        EXPECT_TRUE(way_on(bodies.context(Motion::at_rest(motion.pose_at(0))), 0.01).rests());
        EXPECT_FALSE(way_on(bodies.context(motion), 0.01).rests());
    }
}

TEST(Way, TheArrivalBoundsWherePointsAre) {
    Wanderer bodies;
    Travel travel(bodies.moving().body());
    std::optional<Way> last;
    std::vector<double> gone(bodies.moving().vertices().size(), 0);
    int at_end = 0, between = 0;
    for (int i = 0; i < 200; ++i) {
        // half of the ways are gone to their end, others are left at some time
        const Motion motion = bodies.next();
        const Motion next = ScrewMotion::between(motion.pose_at(i % 2 == 0 ? 0 : 0.4), motion.pose_at(1));
        const Way way = way_on(bodies.context(next), 0.01);
        const Arrival arrival = travel.go_to(way);
        if (last) {
            for (std::size_t v = 0; v < gone.size(); ++v) {
                const auto vertex = motion::vector_in<double>(bodies.moving().vertices()[v]);
                gone[v] += length(way.ends.start(vertex) - last->ends.start(vertex));
                EXPECT_LE(gone[v], arrival.travelled);
            }
            EXPECT_LE(farthest(bodies.moving(), last->ends.at(arrival.share), way.ends.start), arrival.beside);
            const double from_end = farthest(bodies.moving(), last->ends.end, way.ends.start);
            at_end += from_end < 1e-9 && arrival.beside < 1e-9 ? 1 : 0;
            between += arrival.beside < 0.5 * from_end ? 1 : 0;
        }
        last = way;
    }
    EXPECT_GT(at_end, 50);
    EXPECT_GT(between, 0);
    EXPECT_GT(travel.sum(), 0);
}

} // namespace
} // namespace chasles::memory
