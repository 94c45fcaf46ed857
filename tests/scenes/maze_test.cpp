// Mazes are closed meshes with one way out, which a thin body can go; the key fits, but not across a corridor.
#include "scenes/maze.h"

#include "chasles/base/invalid_input.h"
#include "chasles/query/first_contact.h"
#include "tests/scenes/mesh_measures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::scenes {
namespace {

TEST(Maze, IsClosedAndHasTheVolumeOfItsWalls) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const Maze size{.columns = 3 + int(seed % 5), .rows = 2 + int(seed % 3), .seed = seed};
        const Polyhedron body = maze(size);
        EXPECT_EQ(unpaired_edges(body), 0);
        // a tree: one passage less than cells, and the way out
        const double cells = size.columns * size.rows, c = size.corridor, w = size.wall;
        const double length = size.columns * (c + w) + w, width = size.rows * (c + w) + w;
        const double open = cells * c * c + cells * c * w;
        EXPECT_NEAR(volume(body), length * width * (size.floor + size.height) - open * size.height, 1e-6);
    }
}

/// A pin of three corners that stands in the maze.
Polyhedron pin() {
    const std::vector<Eigen::Vector3d> vertices{{0.1, 0, 1}, {-0.1, 0.1, 1}, {-0.1, -0.1, 1}, {0, 0, 3}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return Polyhedron::from_polygons(vertices, faces);
}

Verdict straight(const Polyhedron& body, const Polyhedron& maze, const Eigen::Vector3d& from,
                 const Eigen::Vector3d& to) {
    const Eigen::Isometry3d start(Eigen::Translation3d{from}), goal(Eigen::Translation3d{to});
    return first_contact({.moving = body, .fixed = maze, .motion = ScrewMotion::between(start, goal)}).verdict;
}

TEST(Maze, HasAWayOutFromCellToCell) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const Maze size{.seed = seed};
        const Polyhedron body = maze(size);
        std::vector<MazeCell> way = way_out(size);
        EXPECT_EQ(way.front(), (MazeCell{0, 0}));
        EXPECT_EQ(way.back(), (MazeCell{size.columns - 1, size.rows - 1}));
        way.push_back({size.columns, size.rows - 1});
        for (std::size_t i = 1; i < way.size(); ++i) {
            const MazeCell &from = way[i - 1], &to = way[i];
            EXPECT_EQ(std::abs(from.column - to.column) + std::abs(from.row - to.row), 1);
            EXPECT_EQ(straight(pin(), body, middle_of(size, from), middle_of(size, to)), Verdict::clear);
        }
        // and no other one
        EXPECT_EQ(straight(pin(), body, middle_of(size, {0, 0}), middle_of(size, {-1, 0})), Verdict::contact);
        EXPECT_EQ(straight(pin(), body, middle_of(size, {0, 0}), middle_of(size, {0, -1})), Verdict::contact);
    }
}

TEST(Maze, AKeyFitsAlongACorridorButNotAcross) {
    const Maze size{.columns = 2, .rows = 1};
    const Polyhedron body = maze(size), key = maze_key(size);
    EXPECT_EQ(straight(key, body, middle_of(size, {1, 0}), middle_of(size, {2, 0})), Verdict::clear);
    const Eigen::Isometry3d from(Eigen::Translation3d{middle_of(size, {1, 0})});
    const Eigen::Isometry3d across = from * Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
    EXPECT_EQ(first_contact({.moving = key, .fixed = body, .motion = ScrewMotion::between(from, across)}).verdict,
              Verdict::contact);
}

TEST(Maze, RefusesWrongSizes) {
    EXPECT_THROW((void)maze({.columns = 0}), InvalidInput);
    EXPECT_THROW((void)maze({.rows = 201}), InvalidInput);
    EXPECT_THROW((void)maze({.corridor = -1}), InvalidInput);
    EXPECT_THROW((void)maze_key({.height = std::nan("")}), InvalidInput);
    EXPECT_THROW((void)way_out({.wall = 0}), InvalidInput);
}

} // namespace
} // namespace chasles::scenes
