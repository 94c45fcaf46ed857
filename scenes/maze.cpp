#include "scenes/maze.h"

#include "scenes/require.h"
#include "scenes/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <numbers>
#include <random>
#include <tuple>

namespace chasles::scenes {

namespace {

void require_usable(const Maze& size) {
    for (const double length : {size.corridor, size.wall, size.height, size.floor})
        require("maze", length > 0 && length < 1e6, "lengths", "each must be positive");
    for (const int count : {size.columns, size.rows})
        require("maze", count >= 1 && count <= 200, "columns and rows", "between 1 and 200");
}

/// The squares of the plate: those with two odd indices are cells, those with one odd index are open or a wall, and all
/// others are posts.
class Plan {
public:
    explicit Plan(const Maze& size)
        : columns_(2 * size.columns + 1), rows_(2 * size.rows + 1),
          came_from_(std::size_t(size.columns) * std::size_t(size.rows)),
          is_open_(std::size_t(columns_) * std::size_t(rows_), false) {
        std::mt19937 random(size.seed);
        open({0, 0}, {0, 0});
        std::vector<MazeCell> stack{{0, 0}};
        while (!stack.empty()) {
            const std::vector<MazeCell> next = closed_neighbours(stack.back());
            if (next.empty()) {
                stack.pop_back();
                continue;
            }
            const MazeCell chosen = next[random() % next.size()];
            open(stack.back(), chosen);
            stack.push_back(chosen);
        }
        square(columns_ - 1, rows_ - 2) = true; // the way out
    }

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] bool is_open(int i, int j) const { return is_open_[std::size_t(i) + std::size_t(j * columns_)]; }
    [[nodiscard]] bool is_wall(int i, int j) const {
        return i >= 0 && j >= 0 && i < columns_ && j < rows_ && !is_open(i, j);
    }

    [[nodiscard]] std::vector<MazeCell> way_to(MazeCell cell) const {
        std::vector<MazeCell> way{cell};
        while (cell != MazeCell{0, 0}) {
            cell = came_from_[index(cell)];
            way.push_back(cell);
        }
        return {way.rbegin(), way.rend()};
    }

private:
    std::vector<bool>::reference square(int i, int j) { return is_open_[std::size_t(i) + std::size_t(j * columns_)]; }
    [[nodiscard]] std::size_t index(const MazeCell& cell) const {
        return std::size_t(cell.column) + std::size_t(cell.row * (columns_ / 2));
    }

    /// Opens a cell and the square between it and the cell before.
    void open(const MazeCell& from, const MazeCell& cell) {
        square(2 * cell.column + 1, 2 * cell.row + 1) = true;
        square(from.column + cell.column + 1, from.row + cell.row + 1) = true;
        came_from_[index(cell)] = from;
    }

    [[nodiscard]] std::vector<MazeCell> closed_neighbours(const MazeCell& cell) const {
        std::vector<MazeCell> found;
        for (const auto& [i, j] : {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)}) {
            const MazeCell next{cell.column + i, cell.row + j};
            const bool is_inside =
                next.column >= 0 && next.row >= 0 && 2 * next.column + 1 < columns_ && 2 * next.row + 1 < rows_;
            if (is_inside && !is_open(2 * next.column + 1, 2 * next.row + 1))
                found.push_back(next);
        }
        return found;
    }

    int columns_;
    int rows_;
    std::vector<MazeCell> came_from_;
    std::vector<bool> is_open_;
};

/// The surface of a plan: the squares are posts, walls and cells of different widths.
class MazeMesh {
public:
    MazeMesh(const Plan& plan, const Maze& size) : plan_(plan), size_(size) {
        for (int j = 0; j < plan.rows(); ++j)
            for (int i = 0; i < plan.columns(); ++i)
                add_square(i, j);
    }

    [[nodiscard]] Polyhedron polyhedron() const { return mesh_.polyhedron(); }

private:
    enum Level : std::uint8_t { bottom, ground, top };

    /// The ends of the squares along one axis.
    [[nodiscard]] double place(int i) const { return (i / 2) * (size_.wall + size_.corridor) + (i % 2) * size_.wall; }

    Index corner(int i, int j, Level level) {
        const auto [entry, is_new] = corners_.try_emplace({i, j, level}, 0);
        const double height = level == bottom ? -size_.floor : level == ground ? 0 : size_.height;
        if (is_new)
            entry->second = mesh_.add({place(i), place(j), height});
        return entry->second;
    }

    void add_quadrangle(const std::array<Index, 4>& at) {
        mesh_.triangles.push_back({at[0], at[1], at[2]});
        mesh_.triangles.push_back({at[0], at[2], at[3]});
    }

    /// The wall from one corner to another one, with its outside on the right.
    void add_wall(const std::array<int, 2>& from, const std::array<int, 2>& to, Level low, Level high) {
        add_quadrangle({corner(from[0], from[1], low), corner(to[0], to[1], low), corner(to[0], to[1], high),
                        corner(from[0], from[1], high)});
    }

    void add_square(int i, int j) {
        const Level level = plan_.is_open(i, j) ? ground : top;
        add_quadrangle(
            {corner(i, j, level), corner(i + 1, j, level), corner(i + 1, j + 1, level), corner(i, j + 1, level)});
        add_quadrangle(
            {corner(i, j, bottom), corner(i, j + 1, bottom), corner(i + 1, j + 1, bottom), corner(i + 1, j, bottom)});
        add_side(i, j, {i, j - 1}, {i, j}, {i + 1, j});
        add_side(i, j, {i + 1, j}, {i + 1, j}, {i + 1, j + 1});
        add_side(i, j, {i, j + 1}, {i + 1, j + 1}, {i, j + 1});
        add_side(i, j, {i - 1, j}, {i, j + 1}, {i, j});
    }

    /// The side of a square towards a neighbour.
    void add_side(int i, int j, const std::array<int, 2>& other, const std::array<int, 2>& from,
                  const std::array<int, 2>& to) {
        const bool is_rim = other[0] < 0 || other[1] < 0 || other[0] >= plan_.columns() || other[1] >= plan_.rows();
        if (is_rim)
            add_wall(from, to, bottom, ground);
        if (plan_.is_wall(i, j) && !plan_.is_wall(other[0], other[1]))
            add_wall(from, to, ground, top);
    }

    const Plan& plan_;
    const Maze& size_;
    TriangleMesh mesh_;
    std::map<std::tuple<int, int, Level>, Index> corners_;
};

/// A prism over a convex outline, or one that is star-shaped about its first corner.
void add_prism(TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& outline, double low, double high) {
    std::vector<Index> lower, upper;
    for (const Eigen::Vector2d& point : outline) {
        lower.push_back(mesh.add({point.x(), point.y(), low}));
        upper.push_back(mesh.add({point.x(), point.y(), high}));
    }
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t next = (i + 1) % outline.size();
        mesh.triangles.push_back({lower[i], lower[next], upper[next]});
        mesh.triangles.push_back({lower[i], upper[next], upper[i]});
    }
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
        mesh.triangles.push_back({lower[0], lower[i + 1], lower[i]});
        mesh.triangles.push_back({upper[0], upper[i], upper[i + 1]});
    }
}

std::vector<Eigen::Vector2d> octagon(double radius) {
    std::vector<Eigen::Vector2d> outline;
    for (int i = 0; i < 8; ++i) {
        const double angle = (2 * i + 1) * std::numbers::pi / 8;
        outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return outline;
}

} // namespace

Polyhedron maze(const Maze& size) {
    require_usable(size);
    return MazeMesh(Plan(size), size).polyhedron();
}

std::vector<MazeCell> way_out(const Maze& size) {
    require_usable(size);
    return Plan(size).way_to({size.columns - 1, size.rows - 1});
}

Eigen::Vector3d middle_of(const Maze& size, const MazeCell& cell) {
    const double step = size.wall + size.corridor, first = size.wall + size.corridor / 2;
    return {first + step * cell.column, first + step * cell.row, 0};
}

Polyhedron maze_key(const Maze& size) {
    require_usable(size);
    TriangleMesh mesh;
    const double shaft = 0.3 * size.corridor, bit = 0.9 * size.corridor, half_bit = 0.08 * size.corridor;
    add_prism(mesh, octagon(shaft), 0.1 * size.height, 1.4 * size.height);
    // the parts overlap: a surface may
    add_prism(mesh, {{-bit, -half_bit}, {-shaft / 2, -half_bit}, {-shaft / 2, half_bit}, {-bit, half_bit}},
              0.1 * size.height, 0.8 * size.height);
    add_prism(mesh, octagon(0.8 * size.corridor), 1.2 * size.height, 1.6 * size.height);
    return mesh.polyhedron();
}

} // namespace chasles::scenes
