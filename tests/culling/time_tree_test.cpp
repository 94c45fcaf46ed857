// The intervals of a motion that cubic motions only enclose: true paths leave their chords by no more than is stated,
// and parts are told to be short only if they are.
#include "chasles/culling/time_tree.h"

#include "chasles/search/piece_context.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::culling {
namespace {

using namespace test;
using Eigen::Vector3d;

/// Speeds up on a straight way, turns faster and faster, flies past a spinning body, turns evenly.
std::vector<Motion> motions() {
    const Motion spin = Motion::hinge({0.3, 0, 0}, {1, 2, 3}, {0, 0.5, 1});
    return {Motion::polynomial({{0, 0, 0}, {1, 0, 0}, {1, 2, 2}}), spin * Motion::hinge({1, 0, 0}, {0, 1, 0}, {0, 1}),
            relative(Motion::polynomial({{1, 2, 3}, {2, 0, 1}, {-3, 1, 2}}) * spin,
                     Motion::hinge({-1, 0, 2}, {0, 0, 1}, {0, 1})),
            Motion::velocity(shifted(1, 2, 3), turned({3, 1, 0}, {1, 1, 0}, 1))};
}

/// A point of the moving body as seen from the fixed body, at a tau of the piece.
Vector3d seen(const motion::AnyPiece& piece, const Vector3d& point, double tau) {
    return piece.fixed_pose_at(tau).isometry().inverse() * (piece.pose_at(tau).isometry() * point);
}

TEST(TimeTree, TruePathsLeaveTheirChordsByNoMoreThanTheDeviation) {
    std::mt19937 random(1851);
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    double greatest = 0;
    for (const Motion& motion : motions()) {
        const auto pieces = motion.trajectory().pieces();
        for (std::size_t i = 0; i < pieces->size(); ++i) {
            const search::PieceContext context(cube.body(), cube.body(), pieces->at(i));
            const TimeTree tree = context.time_tree(0, context.parts(0));
            for (const TimeRange& range : {TimeRange{0, 1}, TimeRange{0.25, 0.5}, TimeRange{0.5, 0.5625}}) {
                const TimeInterval interval = tree.interval(range);
                for (int k = 0; k < 20; ++k) {
                    const Vector3d point = random_vector(random, 0.5);
                    const double share = uniform(random, 0, 1);
                    const Vector3d chord = (1 - share) * seen(context.piece(), point, range.lower) +
                                           share * seen(context.piece(), point, range.upper);
                    const double distance = (seen(context.piece(), point, range.at(share)) - chord).norm();
                    EXPECT_LE(distance, interval.deviation + 1e-13) << "piece " << i;
                    greatest = std::max(greatest, distance / interval.deviation);
                }
            }
        }
    }
    std::cout << "at most " << greatest << " of the deviation\n";
    EXPECT_GT(greatest, 0.5);
}

TEST(PieceParts, InAShortPartNoPointMovesByMoreThanTheRadius) {
    std::mt19937 random(1852);
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const double radius = cube.body().bvh().radius();
    int is_short = 0, is_long = 0;
    for (const Motion& motion : motions()) {
        const auto pieces = motion.trajectory().pieces();
        for (std::size_t i = 0; i < pieces->size(); ++i) {
            const search::PieceContext context(cube.body(), cube.body(), pieces->at(i));
            const PieceParts parts = context.parts(0);
            for (int k = 0; k < 20; ++k) {
                const double lower = uniform(random, 0, 1), upper = std::min(1.0, lower + uniform(random, 0, 1));
                if (!parts.is_short(parts.enclosure({lower, upper}).bounds)) {
                    ++is_long;
                    continue;
                }
                ++is_short;
                for (const Vector3d& corner : cube.vertices())
                    EXPECT_LE((seen(context.piece(), corner, upper) - seen(context.piece(), corner, lower)).norm(),
                              radius);
            }
        }
    }
    EXPECT_GT(is_short, 100);
    EXPECT_GT(is_long, 20);
}

} // namespace
} // namespace chasles::culling
