// The tree has the right size and depth, encloses all boxes exactly, and contains each face once.
#include "chasles/hierarchy/bvh.h"

#include "chasles/mesh/body.h"
#include "tests/mesh/shapes.h"

#include <cstring>
#include <gmpxx.h>
#include <gtest/gtest.h>

namespace chasles {
namespace {

/// A box in double precision, in the body's frame.
struct Box {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
};

/// A hierarchy over faces with two corners, one per box.
Bvh hierarchy_of(const std::vector<Box>& boxes, unsigned threads = 1) {
    std::vector<Eigen::Vector3d> vertices;
    FlatLists<std::uint32_t> outlines;
    for (const Box& box : boxes) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), {box.lower, box.upper});
        outlines.append(std::array{first, first + 1});
    }
    return {outlines, vertices, threads};
}

/// Checks the layout and the enclosure of child boxes. Returns the number of leaves of each face.
std::vector<int> leaf_counts(const Bvh& tree, std::size_t face_count) {
    struct Visit {
        std::uint32_t node;
        std::size_t depth;
    };
    std::vector<int> leaves(face_count, 0);
    std::vector<int> visits(tree.nodes().size(), 0);
    std::vector<Visit> waiting{{0, 0}};
    while (!waiting.empty()) {
        const auto [index, depth] = waiting.back();
        waiting.pop_back();
        const BvhNode& node = tree.nodes()[index];
        ++visits[index];
        EXPECT_LE(depth, Bvh::max_depth);
        if (node.is_leaf()) {
            ++leaves.at(node.first);
            continue;
        }
        const std::uint32_t left = node.first;
        for (const std::uint32_t child : {left, left + 1}) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                EXPECT_LE(node.lower[axis], tree.nodes()[child].lower[axis]);
                EXPECT_GE(node.upper[axis], tree.nodes()[child].upper[axis]);
            }
            waiting.push_back({child, depth + 1});
        }
    }
    EXPECT_TRUE(std::ranges::all_of(visits, [](int count) { return count == 1; }));
    return leaves;
}

void expect_whole(const Bvh& tree, std::size_t face_count) {
    ASSERT_EQ(tree.nodes().size(), 2 * face_count - 1);
    const std::array<float, 3>& corner = tree.nodes()[0].upper; // of a box with its middle at 0, up to rounding
    const double reach = std::hypot(double(corner[0]), double(corner[1]), double(corner[2]));
    EXPECT_NEAR(tree.radius(), reach, 1e-6 * reach);
    const std::vector<int> leaves = leaf_counts(tree, face_count);
    EXPECT_TRUE(std::ranges::all_of(leaves, [](int count) { return count == 1; }));
}

/// Checks in exact arithmetic that each leaf encloses the box of its face, and that no leaf could be narrower by one
/// float.
void expect_tight_leaves(const Bvh& tree, const std::vector<Box>& boxes) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    for (const BvhNode& node : tree.nodes()) {
        if (!node.is_leaf())
            continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<Eigen::Index>(axis);
            const mpq_class lower = mpq_class(boxes[node.first].lower[i]) - tree.centre()[i];
            const mpq_class upper = mpq_class(boxes[node.first].upper[i]) - tree.centre()[i];
            ASSERT_LE(mpq_class(node.lower[axis]), lower);
            ASSERT_GT(mpq_class(std::nextafter(node.lower[axis], infinite)), lower);
            ASSERT_GE(mpq_class(node.upper[axis]), upper);
            ASSERT_LT(mpq_class(std::nextafter(node.upper[axis], -infinite)), upper);
        }
    }
}

std::vector<Box> random_boxes(std::mt19937_64& random, std::size_t count, double offset) {
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::vector<Box> boxes(count);
    for (Box& box : boxes) {
        box.lower = Eigen::Vector3d(place(random) + offset, place(random), std::ldexp(place(random), -40));
        box.upper = box.lower + 0.1 * Eigen::Vector3d(1 + place(random), 1 + place(random), 1e-20);
    }
    return boxes;
}

TEST(Bvh, OfOneFaceIsALeaf) {
    const Bvh tree = hierarchy_of({Box{{1, 2, 3}, {2, 3, 4}}});
    ASSERT_EQ(tree.nodes().size(), 1U);
    EXPECT_TRUE(tree.nodes()[0].is_leaf());
    EXPECT_EQ(tree.nodes()[0].first, 0U);
    EXPECT_EQ(tree.centre(), Eigen::Vector3d(1.5, 2.5, 3.5));
}

TEST(Bvh, EnclosesExactlyAndTightly) {
    const unsigned seed = 20240509;
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    for (const double offset : {0.0, 1e3, 1e9}) {
        const std::vector<Box> boxes = random_boxes(random, 1000, offset);
        const Bvh tree = hierarchy_of(boxes);
        expect_whole(tree, boxes.size());
        expect_tight_leaves(tree, boxes);
    }
}

TEST(Bvh, IsWholeForAnyFewFaces) {
    const unsigned seed = 20240510;
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    for (std::size_t count = 1; count < 40; ++count)
        expect_whole(hierarchy_of(random_boxes(random, count, 0.0)), count);
}

TEST(Bvh, StaysShallowWhenAllBoxesAreEqual) {
    const std::vector<Box> boxes(10000, Box{{0, 0, 0}, {1, 1, 1}});
    expect_whole(hierarchy_of(boxes), boxes.size());
}

TEST(Bvh, StaysShallowWhenEachBoxIsHalfTheOneBefore) {
    // Points concentrate towards the middle along all three axes. The best split separates only the farthest points.
    std::vector<Box> boxes{{Eigen::Vector3d::Constant(-std::ldexp(1.0, 99)), Eigen::Vector3d::Zero()}};
    for (int axis = 0; axis < 3; ++axis)
        for (int exponent = 99; exponent > -149; --exponent) {
            const Eigen::Vector3d point = std::ldexp(1.0, exponent) * Eigen::Vector3d::Unit(axis);
            boxes.push_back({point, point});
        }
    boxes.insert(boxes.end(), 10000, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
    expect_whole(hierarchy_of(boxes), boxes.size());
}

TEST(Bvh, HoldsAtTheEndsOfTheRange) {
    const unsigned seed = 20240511;
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    for (const double scale : {1e30, 1e-30, 1e-300}) {
        std::vector<Box> boxes = random_boxes(random, 300, 0.0);
        for (Box& box : boxes)
            box = {box.lower * scale / 2, box.upper * scale / 2};
        const Bvh tree = hierarchy_of(boxes);
        expect_whole(tree, boxes.size());
        expect_tight_leaves(tree, boxes);
    }
}

bool are_the_same(const Bvh& a, const Bvh& b) {
    return a.centre() == b.centre() && a.nodes().size() == b.nodes().size() &&
           std::memcmp(a.nodes().data(), b.nodes().data(), a.nodes().size_bytes()) == 0;
}

TEST(Bvh, IsTheSameEachTime) {
    const unsigned seed = 20240512;
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::vector<Box> boxes = random_boxes(random, 3000, 0.0);
    EXPECT_TRUE(are_the_same(hierarchy_of(boxes), hierarchy_of(boxes)));
}

/// Enough boxes to be sorted into groups, which are split in parallel.
constexpr std::size_t many = 100'000;

TEST(Bvh, IsTheSameForAnyNumberOfThreads) {
    const unsigned seed = 20240513;
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::vector<Box> boxes = random_boxes(random, many, 0.0);
    for (std::size_t i = 0; i < boxes.size(); i += 3) // zeros of both signs
        boxes[i].lower.z() = boxes[i].upper.z() = i % 2 == 0 ? 0.0 : -0.0;
    const Bvh one = hierarchy_of(boxes);
    for (const unsigned threads : {2U, 3U, 0U})
        EXPECT_TRUE(are_the_same(one, hierarchy_of(boxes, threads))) << threads;
}

TEST(Bvh, OfManyFacesIsWholeAndTight) {
    const unsigned seed = 20240514;
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::vector<Box> boxes = random_boxes(random, many, 1e3);
    const Bvh tree = hierarchy_of(boxes, 2);
    expect_whole(tree, boxes.size());
    expect_tight_leaves(tree, boxes);
}

TEST(Bvh, OfManyFacesStaysShallowWhereverTheyCrowd) {
    const std::vector<Box> equal(many, Box{{0, 0, 0}, {1, 1, 1}});
    expect_whole(hierarchy_of(equal, 2), many);
    std::vector<Box> crowded(many); // each a fraction nearer to the corner than the one before
    for (std::size_t i = 0; i < many; ++i)
        crowded[i].lower = crowded[i].upper = Eigen::Vector3d::Constant(std::pow(0.999, double(i)));
    expect_whole(hierarchy_of(crowded, 2), many);
}

/// The expected number of nodes hit by a random line that hits the root.
double nodes_met(const Bvh& tree) {
    const auto area = [](const BvhNode& node) {
        const Eigen::Vector3d size(node.upper[0] - node.lower[0], node.upper[1] - node.lower[1],
                                   node.upper[2] - node.lower[2]);
        return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
    };
    double sum = 0.0;
    for (const BvhNode& node : tree.nodes())
        sum += area(node);
    return sum / area(tree.nodes()[0]);
}

TEST(Bvh, IsGoodForATorus) {
    // Measured 34.4; a split into halves along the longest side gives 39.5.
    const test::Soup soup = test::torus(100, 50);
    const Polyhedron torus = Polyhedron::from_polygons(soup.vertices, soup.faces);
    EXPECT_LT(nodes_met(torus.body().bvh()), 35.0);
}

TEST(Bvh, EnclosesTheVerticesOfRealFaces) {
    const auto rows = test::obj_files_of_manifest();
    if (rows.empty())
        GTEST_SKIP() << "no external data";
    for (const test::ManifestRow& row : rows) {
        if (row.faces > 10000)
            continue; // exact arithmetic takes its time
        SCOPED_TRACE(row.file);
        const test::Soup soup = test::read_obj(test::shared_data() / row.file);
        const Polyhedron body = Polyhedron::from_polygons(soup.vertices, soup.faces);
        std::vector<Box> boxes(body.face_count());
        for (std::size_t f = 0; f < boxes.size(); ++f) {
            boxes[f] = {soup.vertices[body.face(f)[0]], soup.vertices[body.face(f)[0]]};
            for (const std::uint32_t v : body.face(f)) {
                boxes[f].lower = boxes[f].lower.cwiseMin(soup.vertices[v]);
                boxes[f].upper = boxes[f].upper.cwiseMax(soup.vertices[v]);
            }
        }
        expect_whole(body.body().bvh(), body.face_count());
        expect_tight_leaves(body.body().bvh(), boxes);
    }
}

TEST(Bvh, OfManyFacesIsAsGoodAsOneThatIsDividedWhole) {
    // Measured 45.806; without groups it is 45.809.
    const test::Soup soup = test::torus(500, 250);
    const Polyhedron torus = Polyhedron::from_polygons(soup.vertices, soup.faces);
    EXPECT_LT(nodes_met(torus.body().bvh()), 46.0);
}

} // namespace
} // namespace chasles
