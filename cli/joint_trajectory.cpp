// A trajectory of ROS holds names of joints, and points with positions and the time since the start. A recording of
// states has the names and the positions in each message.
#include "cli/joint_trajectory.h"

#include "chasles/base/number_text.h"
#include "chasles/io/column_table.h"
#include "chasles/io/read_file.h"
#include "chasles/robot/joint_columns.h"
#include "cli/joint_states.h"
#include "cli/message_values.h"
#include "cli/options.h"
#include "cli/strict_json.h"
#include "cli/trajectory_start.h"
#include "cli/yaml_text.h"

#include <algorithm>
#include <optional>
#include <set>
#include <span>

namespace chasles::cli {
namespace {

using Json = nlohmann::json;

/// The first line that is neither blank nor a comment.
std::string_view first_line_of(std::string_view text) {
    io::Lines lines(io::without_byte_order_mark(text));
    while (lines.next()) {
        const std::string_view line = io::without_comment(lines.line());
        if (const std::size_t first = line.find_first_not_of(" \t"); first != std::string_view::npos)
            return line.substr(first);
    }
    return {};
}

bool is_json_text(const std::filesystem::path& file, std::string_view text) {
    const std::string extension = io::lower_case(file.extension().string());
    if (extension == ".json")
        return true;
    const std::string_view line = first_line_of(text);
    return extension != ".yaml" && extension != ".yml" && (line.starts_with('{') || line.starts_with('['));
}

/// Adds the trajectories below a node.
void find_trajectories(const Json& json, int depth, std::vector<const Json*>& found) {
    if (json.is_object() && json.contains("joint_names") && json.contains("points"))
        found.push_back(&json);
    else if (json.is_structured() && depth < deepest_wrapper)
        for (const auto& [key, value] : json.items()) {
            if (key != "multi_dof_joint_trajectory" && key != "multi_dof_trajectory")
                find_trajectories(value, depth + 1, found);
            else if (const Json* names = find_in(value, "joint_names"); names && !names->empty())
                throw InvalidInput(key + ": is not read; a table of columns can hold its joints");
        }
}

/// What messages call the parts.
struct Words {
    const char* names = "joint_names";
    const char* points = "points";
    const char* point = "point";
    const char* positions = "positions";
    const char* time = "time_from_start";
};

struct GivenTrajectory {
    Json content;
    Words words = {};
    bool is_recorded = false; ///< made of states, whose times do not count from the start of a motion
};

GivenTrajectory only_trajectory_in(const Json& json) {
    std::vector<const Json*> found;
    find_trajectories(json, 0, found);
    if (found.empty())
        if (std::optional<Json> states = trajectory_of_states(json))
            return {std::move(*states), {"name", "messages", "message", "position", "header: stamp"}, true};
    if (found.empty())
        throw InvalidInput("has no trajectory: no object has the keys joint_names and points, or name and position");
    if (found.size() > 1)
        throw InvalidInput("has " + std::to_string(found.size()) +
                           " trajectories (objects with the keys joint_names and points): leave one in the file");
    return {*found.front()};
}

std::vector<double> positions_in(const Json& point, std::size_t joints, const Words& words) {
    const Json* positions = find_in(point, "positions");
    if (!positions)
        throw InvalidInput("is missing");
    std::vector<double> numbers;
    for (const Json& number : entries_of(*positions))
        numbers.push_back(at_place("joint " + std::to_string(numbers.size() + 1), [&] { return finite_in(number); }));
    if (numbers.size() != joints)
        throw InvalidInput(std::to_string(numbers.size()) + " found, and " + words.names + " has " +
                           std::to_string(joints));
    return numbers;
}

std::string place_of(const Words& words, std::size_t number) {
    return std::string(words.points) + ": " + words.point + ' ' + std::to_string(number);
}

/// Reads the points one by one.
class PointReader {
public:
    /// The columns are those of the points, and after them joints that stay at the values of `rest`.
    PointReader(const robot::JointColumns& columns, std::size_t joints, std::vector<double> rest,
                const GivenTrajectory& trajectory)
        : columns_(columns), joints_(joints), rest_(std::move(rest)), trajectory_(trajectory) {}

    void read(const Json& point) {
        auto positions = at_place(words().positions, [&] { return positions_in(point, joints_, words()); });
        if (first_.empty())
            first_ = positions;
        positions.insert(positions.end(), rest_.begin(), rest_.end());
        rows_.configurations.push_back(columns_.configuration(positions));
        for (const std::string& key :
             other_keys(point, {"positions", "velocities", "accelerations", "effort", "time_from_start"}))
            ignored_.insert(key);
        for (const char* key : {"velocities", "accelerations"})
            if (const Json* rates = find_in(point, key); rates && !rates->empty())
                has_rates_ = true;
        if (const Json* time = find_in(point, "time_from_start"))
            times_.push_back(at_place(words().time, [&] { return seconds_in(*time); }));
    }

    /// The positions of the first point.
    [[nodiscard]] std::span<const double> first() const { return first_; }

    robot::ConfigurationRows finish() {
        take_stamps();
        if (!trajectory_.is_recorded && !rows_.stamps.empty() && rows_.stamps.front() > 0)
            rows_.warnings.push_back("points: the first one comes at " + number_text(rows_.stamps.front()) +
                                     " s: the way to it, from wherever the robot is then, is not tested");
        if (has_rates_)
            rows_.warnings.emplace_back(
                "velocities and accelerations are not used: the path is straight in joint space "
                "from point to point");
        if (!ignored_.empty())
            rows_.warnings.push_back(std::string(words().points) + ": ignored keys: " +
                                     io::shown_names(std::vector<std::string>(ignored_.begin(), ignored_.end())));
        if (rows_.configurations.size() < 2)
            throw InvalidInput(std::string(words().points) + ": a path needs at least two, and there are " +
                               std::to_string(rows_.configurations.size()) +
                               (rows_.configurations.size() == 1
                                    ? std::string("; the state before it is missing: write it as the first ") +
                                          words().point + ", or repeat the " + words().point +
                                          " with a later time to ask about it at rest"
                                    : ""));
        return std::move(rows_);
    }

private:
    [[nodiscard]] const Words& words() const { return trajectory_.words; }

    // A planner that has not timed its path leaves all times at 0.
    void take_stamps() {
        if (times_.empty() || std::ranges::all_of(times_, [](double time) { return time == 0; }))
            return;
        if (times_.size() != rows_.configurations.size())
            throw InvalidInput(std::string(words().points) + ": " + std::to_string(times_.size()) + " of " +
                               std::to_string(rows_.configurations.size()) + " have " + words().time);
        for (std::size_t i = 0; i < times_.size(); ++i)
            at_place(place_of(words(), i + 1), [&] { io::add_stamp(times_[i], words().time, rows_.stamps); });
    }

    const robot::JointColumns& columns_;
    std::size_t joints_;
    std::vector<double> rest_, first_;
    const GivenTrajectory& trajectory_;
    robot::ConfigurationRows rows_;
    std::vector<double> times_;
    std::set<std::string> ignored_; ///< keys of points
    bool has_rates_ = false;
};

} // namespace

bool is_joint_trajectory(const std::filesystem::path& file, const std::string& text) {
    const std::string extension = io::lower_case(file.extension().string());
    if (extension == ".yaml" || extension == ".yml" || is_json_text(file, text))
        return true;
    const std::string_view line = first_line_of(text);
    const bool begins_a_map =
        line.find(": ") != std::string_view::npos || line.substr(0, line.find_last_not_of(" \t") + 1).ends_with(':');
    return extension != ".csv" && (line.starts_with("---") || begins_a_map);
}

robot::ConfigurationRows read_joint_trajectory(const std::string& text, bool is_json, const Robot& robot) {
    const Json json = is_json ? parse_json(with_quoted_nan(text)) : parse_yaml(text);
    const GivenTrajectory trajectory = only_trajectory_in(json);
    const Words& words = trajectory.words;
    const auto columns_of = [&](std::span<const std::string> names) {
        return at_place(words.names, [&] { return robot::JointColumns(names, robot, robot::JointUnits::radians); });
    };
    std::vector<std::string> names = at_place(words.names, [&] { return names_in(trajectory.content["joint_names"]); });
    const std::size_t joints = names.size();
    (void)columns_of(names); // a state alone is no path
    const TrajectoryStart start = trajectory.is_recorded ? TrajectoryStart() : trajectory_start_in(json, robot);
    const TrajectoryStart rest = start.without(names);
    names.insert(names.end(), rest.joints.begin(), rest.joints.end());
    const robot::JointColumns columns = columns_of(names);
    PointReader reader(columns, joints, rest.values, trajectory);
    std::size_t number = 0;
    const auto points = [&]() -> const Json& { return entries_of(trajectory.content["points"]); };
    for (const Json& point : at_place(words.points, points))
        at_place(place_of(words, ++number), [&] { reader.read(point); });
    robot::ConfigurationRows rows = reader.finish();
    names.resize(joints);
    for (std::string& warning : start.warnings_about(names, reader.first()))
        rows.warnings.push_back(std::move(warning));
    for (const std::string& warning : columns.warnings("joints"))
        rows.warnings.push_back(std::string(words.names) + ": " + warning);
    for (std::size_t i = 0; i < rest.joints.size(); ++i)
        if (columns.reads(joints + i))
            rows.warnings.push_back(std::string(words.names) + ": " + io::in_quotes(rest.joints[i]) + " stays at " +
                                    number_text(rest.values[i]) + ", its value in " + rest.key);
    return rows;
}

robot::ConfigurationRows load_joint_path(const std::filesystem::path& file, const Robot& robot, std::size_t least) {
    const std::string text = io::read_file(file);
    return at_place(io::shown_name(file), [&] {
        robot::ConfigurationRows rows = is_joint_trajectory(file, text)
                                            ? read_joint_trajectory(text, is_json_text(file, text), robot)
                                            : robot::read_configurations(text, robot, least);
        for (std::string& warning : rows.warnings)
            warning = io::shown_name(file) + ": " + warning;
        return rows;
    });
}

} // namespace chasles::cli
