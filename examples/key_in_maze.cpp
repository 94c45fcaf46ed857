// A key is dragged out of a maze. The hand knows the way, but not how to go it: it pulls straight at a place two cells
// ahead, through the walls, and never turns the key. The walls lead the key and turn it at each corner. Each step is
// proven clear. With a file name, writes a page that replays it.
#include "examples/dragging/recording.h"
#include "scenes/maze.h"

#include <chasles/chasles.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using chasles::Pose;
using chasles::scenes::MazeCell;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr chasles::scenes::Maze size{.columns = 7, .rows = 5, .seed = 3};
constexpr int cells_ahead = 2;
constexpr int most_updates = 1500;

/// The cell of the way nearest to a place.
std::size_t nearest_cell(const std::vector<MazeCell>& way, const Vector3d& place) {
    const auto distance = [&](const MazeCell& cell) {
        return (chasles::scenes::middle_of(size, cell) - place).head<2>().norm();
    };
    return std::size_t(std::ranges::min_element(way, {}, distance) - way.begin());
}

/// In the second cell, with the bit in the first one.
Pose start_of(const std::vector<MazeCell>& way) {
    const Vector3d middle = chasles::scenes::middle_of(size, way[1]);
    const Vector3d ahead = middle - chasles::scenes::middle_of(size, way[0]);
    return {middle, Quaterniond(Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Vector3d::UnitZ()))};
}

} // namespace

int main(int count, char** arguments) {
    std::vector<MazeCell> way = chasles::scenes::way_out(size);
    for (int i = 0; i < cells_ahead + 1; ++i) // on the meadow
        way.push_back({size.columns + i, size.rows - 1});
    chasles::Scene scene;
    scene.add({"maze", chasles::scenes::maze(size)});
    scene.add({"key", chasles::scenes::maze_key(size), chasles::Motion::at_rest(start_of(way))});
    chasles::DraggedBody hand(scene, "key");
    chasles::examples::HandRecording recording(scene, "A key in a maze");

    const double outside = chasles::scenes::middle_of(size, {size.columns, 0}).x() + size.corridor / 2;
    int updates = 0, in_contact = 0;
    double turned = 0;
    std::size_t pieces = 0;
    for (; updates < most_updates && hand.pose().translation.x() < outside; ++updates) {
        const Pose before = hand.pose();
        const std::size_t ahead = std::min(nearest_cell(way, before.translation) + cells_ahead, way.size() - 1);
        Vector3d place = chasles::scenes::middle_of(size, way[ahead]);
        place.z() = -1; // into the floor
        const chasles::DragStep step = hand.update(Pose(place, Quaterniond(before.rotation)));
        turned += std::abs(chasles::examples::turns_about_z(before, step.pose));
        pieces += step.pieces.size();
        in_contact += !step.contacts.empty();
        recording.keep_contacts("key", step);
        recording.keep();
    }
    const bool is_out = hand.pose().translation.x() >= outside;
    std::printf("%d updates, %d in contact, %zu proven pieces: %zu cells, and the walls turned the key %.1f times\n",
                updates, in_contact, pieces, way.size() - std::size_t(cells_ahead) - 1, turned);
    std::printf(is_out ? "the key is out of the maze\n" : "the key is stuck\n");
    recording.write(count, arguments);
    return is_out ? 0 : 1;
}
