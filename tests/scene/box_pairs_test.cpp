// The tree of boxes against all pairs of them.
#include "chasles/scene/box_pairs.h"

#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::scene {
namespace {

using test::Random;

Box random_box(Random& random, double size) {
    const auto corner = [&](double spread) { // on a grid, so that some boxes are equal and some only touch
        return Eigen::Vector3d((test::random_point(random, spread) * 4).array().round() / 4);
    };
    const Eigen::Vector3d place = corner(size);
    return Box(place).extend(place + corner(1));
}

/// The pairs of all boxes that overlap.
std::vector<IndexPair> pairs_of(const std::vector<SweptBody>& bodies) {
    std::vector<IndexPair> pairs;
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
        for (std::uint32_t j = i + 1; j < bodies.size(); ++j)
            if (bodies[i].box.intersects(bodies[j].box))
                pairs.emplace_back(i, j);
    return pairs;
}

std::vector<std::uint32_t> found_by_all(const std::vector<SweptBody>& bodies, const Box& box) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
        if (bodies[i].box.intersects(box))
            found.push_back(i);
    return found;
}

void expect_all_are_found(const BoxTree& tree, const std::vector<SweptBody>& bodies, Random& random, double size) {
    for (const unsigned threads : {1U, 3U}) {
        std::vector<IndexPair> pairs = tree.overlapping_pairs(threads);
        std::ranges::sort(pairs);
        ASSERT_EQ(pairs, pairs_of(bodies));
    }
    for (int question = 0; question < 20; ++question) {
        const Box box = random_box(random, size);
        ASSERT_EQ(tree.overlapping(box), found_by_all(bodies, box));
    }
}

TEST(BoxTree, FindsWhatAllPairsFindAlsoAfterBoxesHaveMoved) {
    Random random(2721);
    for (int trial = 0; trial < 100; ++trial) {
        const double size = random.uniform(0.5, 6);
        std::vector<SweptBody> bodies(std::size_t(std::pow(10, random.uniform(0, 3))));
        for (SweptBody& body : bodies)
            body.box = random_box(random, size);
        BoxTree tree(bodies);
        expect_all_are_found(tree, bodies, random, size);
        for (int moves = random.integer(1, 40); moves > 0; --moves) {
            const int index = random.integer(0, int(bodies.size()) - 1);
            bodies[std::size_t(index)].box = random_box(random, 2 * size);
            tree.replace(std::uint32_t(index), bodies[std::size_t(index)].box);
        }
        expect_all_are_found(tree, bodies, random, 2 * size);
    }
    EXPECT_TRUE(BoxTree({}).overlapping_pairs(1).empty());
    EXPECT_TRUE(BoxTree({}).overlapping(Box(Eigen::Vector3d::Zero())).empty());
}

/// Boxes of all sizes, at places near and far: numbers that floats do not hold.
TEST(BoxTree, LosesNoPairToRounding) {
    Random random(2722);
    std::size_t found_in_all = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Eigen::Vector3d place = test::random_point(random, std::abs(random.scaled(-3, 9)));
        std::vector<SweptBody> bodies(std::size_t(random.integer(1, 60)));
        for (SweptBody& body : bodies) {
            const Eigen::Vector3d corner = place + test::random_point(random, std::abs(random.scaled(-6, 1)));
            body.box = Box(corner).extend(corner + test::random_point(random, std::abs(random.scaled(-6, 1))));
        }
        bodies.front().box.extend(Eigen::Vector3d::Constant(random.chance(0.2) ? INFINITY : 0));
        std::vector<IndexPair> found = BoxTree(bodies, 2).overlapping_pairs(2);
        std::ranges::sort(found);
        const std::vector<IndexPair> expected = pairs_of(bodies);
        ASSERT_TRUE(std::ranges::includes(found, expected)) << trial;
        ASSERT_EQ(std::ranges::adjacent_find(found), found.end()) << "twice";
        found_in_all += expected.size();
    }
    EXPECT_GT(found_in_all, 10'000);
}

} // namespace
} // namespace chasles::scene
