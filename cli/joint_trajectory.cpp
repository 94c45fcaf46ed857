// A trajectory of ROS holds names of joints, and points with positions and the time since the start. A recording of
// states has the names and the positions in each message.
#include "cli/joint_trajectory.h"

#include "chasles/base/number_text.h"
#include "chasles/io/column_table.h"
#include "chasles/io/read_file.h"
#include "chasles/robot/joint_columns.h"
#include "cli/joint_states.h"
#include "cli/options.h"
#include "cli/strict_json.h"
#include "cli/yaml_text.h"

#include <algorithm>
#include <optional>

namespace chasles::cli {
namespace {

using Json = nlohmann::json;

constexpr int deepest_wrapper = 8; ///< levels of messages around a trajectory

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

/// The text of a value. YAML may hold bytes that are no UTF-8.
std::string shown(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

double finite_in(const Json& json) {
    if (json.is_number())
        return json.get<double>();
    const std::string text = json.is_string() ? json.get<std::string>() : shown(json);
    if (const auto number = io::parse_finite(text); number && json.is_string())
        return *number;
    throw InvalidInput("not a finite number: " + io::in_quotes(text) + io::decimal_comma_hint(text));
}

const Json& entries_of(const Json& json) {
    if (!json.is_array())
        throw InvalidInput("must be a list");
    return json;
}

const Json* find_in(const Json& json, const char* key) {
    const auto found = json.is_object() ? json.find(key) : json.end();
    return found == json.end() || found->is_null() ? nullptr : &*found;
}

/// Adds the trajectories below a node.
void find_trajectories(const Json& json, int depth, std::vector<const Json*>& found) {
    if (json.is_object() && json.contains("joint_names") && json.contains("points"))
        found.push_back(&json);
    else if (json.is_structured() && depth < deepest_wrapper)
        for (const auto& [key, value] : json.items()) {
            if (key != "multi_dof_joint_trajectory")
                find_trajectories(value, depth + 1, found);
            else if (const Json* names = find_in(value, "joint_names"); names && !names->empty())
                throw InvalidInput("multi_dof_joint_trajectory: is not read; a table of columns can hold its joints");
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

std::vector<std::string> joint_names_in(const GivenTrajectory& trajectory) {
    return at_place(trajectory.words.names, [&] {
        std::vector<std::string> names;
        for (const Json& name : entries_of(trajectory.content["joint_names"])) {
            if (!name.is_string())
                throw InvalidInput("not a text: " +
                                   io::in_quotes(name.is_structured() ? "a list or an object" : shown(name)));
            names.push_back(name.get<std::string>());
        }
        return names;
    });
}

/// Writers leave out a part that is 0, or write a list whose second number is 0 in any unit.
double seconds_in_list(const Json& list) {
    if (list.size() == 2 && finite_in(list[1]) == 0)
        return finite_in(list[0]);
    throw InvalidInput(
        "a list is read only as [SECONDS, 0]; write {sec: SECONDS, nanosec: NANOSECONDS}, or the seconds");
}

/// ROS 2 has sec and nanosec, ROS 1 secs and nsecs; others write the seconds.
double seconds_in(const Json& json) {
    if (json.is_array())
        return seconds_in_list(json);
    if (!json.is_object())
        return finite_in(json);
    const auto part = [&](const char* key, const char* other) {
        const Json* value = find_in(json, key) ? find_in(json, key) : find_in(json, other);
        return value ? std::optional(at_place(key, [&] { return finite_in(*value); })) : std::nullopt;
    };
    const std::optional<double> seconds = part("sec", "secs"), nanoseconds = part("nanosec", "nsecs");
    if (!seconds && !nanoseconds)
        throw InvalidInput("has no sec, no secs, no nanosec and no nsecs");
    return seconds.value_or(0) + 1e-9 * nanoseconds.value_or(0);
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
    PointReader(std::size_t joints, const robot::JointColumns& columns, const GivenTrajectory& trajectory)
        : joints_(joints), columns_(columns), trajectory_(trajectory) {}

    void read(const Json& point) {
        const auto positions = at_place(words().positions, [&] { return positions_in(point, joints_, words()); });
        rows_.configurations.push_back(columns_.configuration(positions));
        for (const char* key : {"velocities", "accelerations"})
            if (const Json* rates = find_in(point, key); rates && !rates->empty())
                has_rates_ = true;
        if (const Json* time = find_in(point, "time_from_start"))
            times_.push_back(at_place(words().time, [&] { return seconds_in(*time); }));
    }

    robot::ConfigurationRows finish() {
        take_stamps();
        if (!trajectory_.is_recorded && !rows_.stamps.empty() && rows_.stamps.front() > 0)
            rows_.warnings.push_back("points: the first one comes at " + number_text(rows_.stamps.front()) +
                                     " s: the way to it, from wherever the robot is then, is not tested");
        if (has_rates_)
            rows_.warnings.emplace_back(
                "velocities and accelerations are not used: the path is straight in joint space "
                "from point to point");
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

    std::size_t joints_;
    const robot::JointColumns& columns_;
    const GivenTrajectory& trajectory_;
    robot::ConfigurationRows rows_;
    std::vector<double> times_;
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
    const std::vector<std::string> names = joint_names_in(trajectory);
    const robot::JointColumns columns =
        at_place(words.names, [&] { return robot::JointColumns(names, robot, robot::JointUnits::radians); });
    PointReader reader(names.size(), columns, trajectory);
    std::size_t number = 0;
    const auto points = [&]() -> const Json& { return entries_of(trajectory.content["points"]); };
    for (const Json& point : at_place(words.points, points))
        at_place(place_of(words, ++number), [&] { reader.read(point); });
    robot::ConfigurationRows rows = reader.finish();
    for (const std::string& warning : columns.warnings("joints"))
        rows.warnings.push_back(std::string(words.names) + ": " + warning);
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
