// Maps of OctoMap are the cubes of their occupied cells.
#include "chasles/base/invalid_input.h"
#include "chasles/chasles.h"
#include "chasles/io/mesh_bytes.h"
#include "tests/io/post_files.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace chasles::io {
namespace {

using tests::OctomapCell;
using tests::OctomapWriter;
using Cells = std::set<OctomapCell>;

Cells block(const OctomapCell& lower, const OctomapCell& sides) {
    Cells cells;
    for (int x = 0; x < sides[0]; ++x)
        for (int y = 0; y < sides[1]; ++y)
            for (int z = 0; z < sides[2]; ++z)
                cells.insert({lower[0] + x, lower[1] + y, lower[2] + z});
    return cells;
}

Cells random_cells(std::mt19937& random, int side) {
    Cells cells;
    std::uniform_int_distribution<int> at(-side, side - 1);
    for (int i = 0; i < 4 * side; ++i) {
        const Cells part = block({at(random), at(random), at(random)}, {1 + i % 4, 1 + i % 3, 1 + i % 4});
        cells.insert(part.begin(), part.end());
    }
    return cells;
}

/// Faces between a cell and a free neighbour.
std::size_t free_sides(const Cells& cells) {
    std::size_t sides = 0;
    for (const OctomapCell& cell : cells)
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                OctomapCell next = cell;
                next[axis] += step;
                sides += 1 - cells.count(next);
            }
    return sides;
}

TEST(OctomapReader, ReadsOneCell) {
    const std::string bytes = OctomapWriter({{2, -1, 0}}, true).bt(0.5);
    const Polyhedron body = read_polyhedron(bytes, "one.bt");
    EXPECT_EQ(body.report().vertices, 8u);
    EXPECT_EQ(body.report().faces, 6u);
    EXPECT_EQ(body.report().lower, Eigen::Vector3d(1, -0.5, 0));
    EXPECT_EQ(body.report().upper, Eigen::Vector3d(1.5, 0, 0.5));
    EXPECT_TRUE(body.report().closed);
    EXPECT_EQ(body.report().volume, 0.125) << "faces look outwards";
}

// The bytes by hand: the root has one occupied child, the last one, with half of the map.
TEST(OctomapReader, ReadsBitsInTheOrderOfOctomap) {
    const std::string header = "# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.25\ndata\n";
    const PolygonSoup map = read_polygons(header + std::string("\x01\x80", 2), "hand.bt"); // the first child is free
    EXPECT_EQ(map.faces.size(), 6u);
    const Eigen::Vector3d far = Eigen::Vector3d::Constant(8192);
    EXPECT_TRUE(std::ranges::find(map.vertices, Eigen::Vector3d(0, 0, 0)) != map.vertices.end());
    EXPECT_TRUE(std::ranges::find(map.vertices, far) != map.vertices.end());
    const PolygonSoup x = read_polygons(header + std::string("\x09\x00", 2), "hand.bt"); // the second one: towards x
    EXPECT_TRUE(std::ranges::find(x.vertices, Eigen::Vector3d(8192, 0, 0)) != x.vertices.end());
    EXPECT_TRUE(std::ranges::find(x.vertices, Eigen::Vector3d(0, 0, -8192)) != x.vertices.end());
}

TEST(OctomapReader, IsTheSurfaceOfAllOccupiedCells) {
    std::mt19937 random(47);
    for (int i = 0; i < 40; ++i) {
        const Cells cells = random_cells(random, 6);
        for (const bool is_pruned : {false, true}) {
            const PolygonSoup map = read_polygons(OctomapWriter(cells, is_pruned).bt(0.25), "map.bt");
            EXPECT_EQ(!is_pruned && map.faces.size() != free_sides(cells), false);
            const Polyhedron body = make_polyhedron(map, {});
            EXPECT_EQ(body.report().solid_parts + body.report().inward_parts,
                      body.report().parts); // there are cavities
            EXPECT_EQ(body.report().unpaired_edges, 0u);
            EXPECT_EQ(body.report().volume, double(cells.size()) / 64);
        }
    }
}

// A ball of a quarter of a cell, at rest in the middle of each cell.
TEST(OctomapReader, HasAnInside) {
    std::mt19937 random(48);
    const Cells cells = random_cells(random, 4);
    const Polyhedron map = read_polyhedron(OctomapWriter(cells, true).ot(1, "ColorOcTree", 3), "map.ot");
    const Polyhedron ball = make_sphere(0.25);
    for (const OctomapCell& cell : block({-6, -6, -6}, {14, 14, 14})) {
        const Eigen::Vector3d middle = Eigen::Vector3d(cell[0], cell[1], cell[2]).array() + 0.5;
        const Pose here(middle, Eigen::Quaterniond::Identity());
        const FirstContact found = first_contact({ball, map, ScrewMotion::between(here, here)});
        EXPECT_EQ(found.verdict, cells.contains(cell) ? Verdict::contact_at_start : Verdict::clear)
            << middle.transpose();
    }
}

TEST(OctomapReader, ReadsBothFormatsAlike) {
    std::mt19937 random(49);
    const Cells cells = random_cells(random, 5);
    const PolygonSoup states = read_polygons(OctomapWriter(cells, true).bt(0.1), "map.BT");
    for (const auto& [id, further] : {std::pair("OcTree", 0u), {"OcTreeStamped", 0u}, {"ColorOcTree", 3u}}) {
        const PolygonSoup odds = read_polygons(OctomapWriter(cells, true).ot(0.1, id, further), "map.ot");
        EXPECT_EQ(odds.faces, states.faces) << id;
        EXPECT_EQ(odds.vertices, states.vertices) << id;
    }
}

// Files that OctoMap 1.9.7 wrote itself: the post of post_files.h, and the same with colours.
TEST(OctomapReader, ReadsWhatOctomapWrites) {
    const auto folder = std::filesystem::path(__FILE__).parent_path() / "../fuzz/corpus/mesh_files";
    const Polyhedron written = read_polyhedron(tests::post_octomap().bt(0.0625), "post.bt");
    for (const char* const name : {"post.bt", "post.ot", "color.ot"}) {
        const Polyhedron read = Polyhedron::load(folder / name);
        EXPECT_EQ(read.report().lower, Eigen::Vector3d(-0.0625, -0.0625, 0)) << name;
        EXPECT_EQ(read.report().upper, Eigen::Vector3d(0.0625, 0.0625, 1)) << name;
        EXPECT_EQ(read.report().faces, written.report().faces) << name;
        EXPECT_EQ(read.report().volume, 1.0 / 64) << name;
    }
}

std::string refusal(const std::string& bytes) {
    try {
        (void)read_polygons(bytes, "map.bt");
        return "read";
    } catch (const InvalidInput& error) {
        return error.what();
    }
}

TEST(OctomapReader, RefusesWithAReason) {
    const std::string map = OctomapWriter({{0, 0, 0}, {0, 0, 1}}, false).bt(0.5);
    const auto with = [&](const std::string& old, const std::string& now) {
        std::string text = map;
        return text.replace(text.find(old), old.size(), now);
    };
    EXPECT_EQ(refusal(with("# Octomap", "# OctoMap")),
              "map.bt: does not begin with \"# Octomap OcTree\"; write it again "
              "with OctoMap 1.4 or later");
    EXPECT_EQ(refusal(with("id OcTree", "id SemanticOcTree")),
              "map.bt: trees of the kind 'SemanticOcTree' are not read; OcTree, OcTreeStamped and ColorOcTree are");
    EXPECT_EQ(refusal(with("res 0.5", "res -1")), "map.bt: line 6: res needs a positive length: '-1'");
    EXPECT_EQ(refusal(with("res 0.5", "res nan")), "map.bt: line 6: res needs a positive length: 'nan'");
    EXPECT_EQ(refusal(with("res 0.5\n", "")), "map.bt: has no line 'res' before the line 'data'");
    EXPECT_EQ(refusal(with("size 18\n", "")), "map.bt: has no line 'size' before the line 'data'");
    EXPECT_EQ(refusal(with("res 0.5\n", "res 0.5\nres 1\n")), "map.bt: line 7: is a second line 'res'");
    EXPECT_EQ(refusal(with("data\n", "")), "map.bt: ends before the line 'data'");
    EXPECT_EQ(refusal(with("size 18", "size 0")), "map.bt: goes on behind its tree (bytes: 32)");
    EXPECT_EQ(refusal(with("size 18", "size 17")), "map.bt: has a tree of another size (18) than its header says (17)");
    EXPECT_EQ(refusal(map.substr(0, map.size() - 1)), "map.bt: ends in the middle of its tree (node 16 of 18)");
    EXPECT_EQ(refusal(map + "x"), "map.bt: goes on behind its tree (bytes: 1)");
    const std::string header = map.substr(0, map.find("size")) + "size 99\nres 1\ndata\n";
    EXPECT_EQ(refusal(header + std::string(400, '\xff')), "map.bt: is deeper than 16 levels");
    EXPECT_EQ(refusal(map.substr(0, map.find("size")) + "size 1\nres 1\ndata\n" + std::string(2, '\0')),
              "map.bt: has no occupied cell");
}

// A tree of equal levels in which each node has four children, no two of which share a side: 4^11 cubes.
TEST(OctomapReader, RefusesMoreThanFitsBeforeTheMemoryIsTaken) {
    std::string bytes;
    const std::function<void(int)> add = [&](int level) {
        bytes += level < 10 ? std::string("\xc3\x3c", 2) : std::string("\x82\x28", 2);
        for (int child = 0; level < 10 && child < 4; ++child)
            add(level + 1);
    };
    add(0);
    const std::string header = fmt::format("# Octomap OcTree binary file\nid OcTree\nsize {}\nres 1\ndata\n", 5592405);
    EXPECT_EQ(refusal(header + bytes),
              "map.bt: has cubes with more than 16777216 free sides; make a map of larger cells, "
              "or of a part");
}

TEST(OctomapReader, RefusesLogOddsThatAreNoNumber) {
    std::string map = OctomapWriter({{0, 0, 0}}, true).ot(0.5);
    const std::string odds = tests::bytes_of(0.85f);
    map.replace(map.rfind(odds), odds.size(), tests::bytes_of(std::nanf("")));
    EXPECT_NE(refusal(map).find("has log odds that are no number (node "), std::string::npos);
}

TEST(OctomapReader, RefusesOrReadsAnyCut) {
    const std::string map = OctomapWriter(block({-1, -1, -1}, {3, 2, 2}), true).ot(0.5);
    for (std::size_t size = 0; size < map.size(); ++size)
        EXPECT_NE(refusal(map.substr(0, size)), "read") << size;
}

} // namespace
} // namespace chasles::io
