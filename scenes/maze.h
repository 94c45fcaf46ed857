// A maze of walls on a plate with one way out, and a key that fits into its corridors, as closed triangle meshes.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <cstdint>
#include <vector>

namespace chasles::scenes {

/// The walls stand on z = 0, on a plate below. The corridors lie on a grid of columns along x and rows along y; the
/// corner of the plate is at x = y = 0. Any two places are connected by exactly one way. The way out is in the outer
/// wall beside the last cell (the last column and row), towards x.
struct Maze {
    int columns = 6;
    int rows = 5;
    double corridor = 10; ///< width of a corridor
    double wall = 2;      ///< thickness of a wall
    double height = 6;    ///< of the walls
    double floor = 2;     ///< thickness of the plate
    std::uint32_t seed = 1;
};

/// A cell by its column and row, from 0.
struct MazeCell {
    int column = 0;
    int row = 0;
    bool operator==(const MazeCell&) const = default;
};

/// The maze. The same numbers give the same maze on every platform. Throws InvalidInput if a length is not positive, or
/// if there are fewer than one or more than 200 columns or rows.
Polyhedron maze(const Maze& size);

/// The cells from the first cell (column and row 0) to the last one, neighbour by neighbour.
std::vector<MazeCell> way_out(const Maze& size);

/// The middle of a cell, on the floor. The column may be that after the last one: it is outside.
Eigen::Vector3d middle_of(const Maze& size, const MazeCell& cell);

/// A key that stands in a corridor: an eight-sided shaft about z, a bit along -x, and a bow above the walls. The bit is
/// so long that the key cannot turn across a corridor: it has to be turned at each corner.
Polyhedron maze_key(const Maze& size);

} // namespace chasles::scenes
