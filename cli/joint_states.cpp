#include "cli/joint_states.h"

#include "chasles/base/invalid_input.h"
#include "cli/message_values.h"

#include <string>
#include <vector>

namespace chasles::cli {
namespace {

using Json = nlohmann::json;

bool is_state(const Json& json) {
    return json.is_object() && json.contains("name") && json["name"].is_array() && json.contains("position");
}

/// Adds the states below a node, in their order.
void find_states(const Json& json, int depth, std::vector<const Json*>& found) {
    if (is_state(json))
        found.push_back(&json);
    else if (json.is_structured() && depth < deepest_wrapper)
        for (const Json& value : json)
            find_states(value, depth + 1, found);
}

/// Null where the message has no such key.
Json value_in(const Json& message, const char* key) {
    return message.is_object() ? message.value(key, Json()) : Json();
}

} // namespace

std::optional<Json> trajectory_of_states(const Json& json) {
    std::vector<const Json*> states;
    find_states(json, 0, states);
    if (states.empty())
        return std::nullopt;
    const Json& names = (*states.front())["name"];
    Json points = Json::array();
    for (const Json* state : states) {
        if ((*state)["name"] != names)
            throw InvalidInput("messages: message " + std::to_string(points.size() + 1) +
                               " has other names than the first one: leave the messages of one publisher in the file");
        const Json header = value_in(*state, "header");
        Json point = {{"positions", (*state)["position"]},
                      {"velocities", value_in(*state, "velocity")},
                      {"time_from_start", value_in(header, "stamp")}};
        for (const std::string& key : other_keys(*state, {"header", "name", "position", "velocity", "effort"}))
            point["message: " + key] = true;
        for (const std::string& key : other_keys(header, {"seq", "stamp", "frame_id"}))
            point["header: " + key] = true;
        points.push_back(std::move(point));
    }
    return Json{{"joint_names", names}, {"points", points}};
}

} // namespace chasles::cli
