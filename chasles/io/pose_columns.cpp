// Names as in TUM and EuRoC trajectories, in tables made from ROS messages, and in ours.
#include "chasles/io/pose_columns.h"

#include "chasles/io/column_table.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace chasles::io {
namespace {

// Units that leave the meaning of a name as it is: lengths have the unit of the meshes, stamps any unit.
constexpr auto units_to_drop = std::to_array<std::string_view>({"", "m", "s", "ns"});
constexpr auto more_units_of_time = std::to_array<std::string_view>({"sec", "secs", "seconds", "ms", "us"});
// What stands before the axis.
constexpr auto of_position =
    std::to_array<std::string_view>({"", "t", "p_", "pos_", "position_", "translation_", "p_rs_r_"});
constexpr auto of_quaternion =
    std::to_array<std::string_view>({"q", "q_", "quat_", "quaternion_", "orientation_", "rotation_", "q_rs_"});
constexpr auto of_time =
    std::to_array<std::string_view>({"t", "time", "timestamp", "time_from_start", "stamp", "header_stamp", "__time"});

template <typename Names>
bool is_one_of(const Names& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

std::string without_unit(const std::string& text) {
    const auto [name, unit] = split_unit(text);
    return std::string(unit && is_one_of(units_to_drop, *unit) ? name : text);
}

std::string with_low_lines(std::string name) {
    std::ranges::replace(name, '.', '_');
    std::ranges::replace(name, '/', '_');
    return name;
}

// "Pose.Orientation.W" becomes "orientation_w".
std::string plain(std::string_view text) {
    std::string name = with_low_lines(without_unit(lower_case(text)));
    for (const std::string_view prefix : {"pose_", "pose_", "transform_"}) // PoseWithCovariance has a pose in a pose
        if (name.starts_with(prefix))
            name.erase(0, prefix.size());
    return name;
}

} // namespace

std::vector<std::string> pose_columns() {
    return {"x", "y", "z", "qw", "qx", "qy", "qz", "t"};
}

bool is_time_column(std::string_view text) {
    const std::string small = with_low_lines(lower_case(text));
    const auto [name, unit] = split_unit(small);
    return is_one_of(of_time, name) &&
           (!unit || is_one_of(units_to_drop, *unit) || is_one_of(more_units_of_time, *unit));
}

std::string pose_column(std::string_view text) {
    const std::string name = plain(text);
    if (is_one_of(of_time, name) || is_time_column(text))
        return "t";
    if (name.empty())
        return "";
    const std::string_view before = std::string_view(name).substr(0, name.size() - 1);
    const char axis = name.back();
    if (axis >= 'x' && axis <= 'z' && is_one_of(of_position, before))
        return {axis};
    if (axis >= 'w' && axis <= 'z' && is_one_of(of_quaternion, before))
        return {'q', axis};
    return "";
}

} // namespace chasles::io
