// Messages come from `ros2 topic echo` and from exports of recordings, which spell the parts of a time in several ways.
#include "cli/message_values.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/column_table.h"
#include "chasles/io/text_scan.h"
#include "cli/options.h"

#include <algorithm>
#include <optional>

namespace chasles::cli {
namespace {

using Json = nlohmann::json;

/// Writers leave out a part that is 0, or write a list whose second number is 0 in any unit.
double seconds_in_list(const Json& list) {
    if (list.size() == 2 && finite_in(list[1]) == 0)
        return finite_in(list[0]);
    throw InvalidInput(
        "a list is read only as [SECONDS, 0]; write {sec: SECONDS, nanosec: NANOSECONDS}, or the seconds");
}

/// The number of the key that the object has. Two spellings of one part may differ.
std::optional<double> part_of_time(const Json& json, std::initializer_list<const char*> keys) {
    std::optional<double> number;
    for (const char* key : keys) {
        const Json* value = find_in(json, key);
        if (value && number)
            throw InvalidInput("has two of " + io::shown_names(std::vector<std::string>(keys.begin(), keys.end())) +
                               ": leave one");
        if (value)
            number = at_place(key, [&] { return finite_in(*value); });
    }
    return number;
}

} // namespace

std::string shown(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

const Json* find_in(const Json& json, const char* key) {
    const auto found = json.is_object() ? json.find(key) : json.end();
    return found == json.end() || found->is_null() ? nullptr : &*found;
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

std::vector<std::string> names_in(const Json& json) {
    std::vector<std::string> names;
    for (const Json& name : entries_of(json)) {
        if (!name.is_string())
            throw InvalidInput("not a text: " +
                               io::in_quotes(name.is_structured() ? "a list or an object" : shown(name)));
        names.push_back(name.get<std::string>());
    }
    return names;
}

double seconds_in(const Json& json) {
    if (json.is_array())
        return seconds_in_list(json);
    if (!json.is_object())
        return finite_in(json);
    const std::string keys = "a time has sec or secs, and nanosec, nanosecs, nsec or nsecs";
    if (const auto others = other_keys(json, {"sec", "secs", "nanosec", "nanosecs", "nsec", "nsecs"}); !others.empty())
        throw InvalidInput("unknown key " + io::in_quotes(others.front()) + "; " + keys);
    const std::optional<double> seconds = part_of_time(json, {"sec", "secs"});
    const std::optional<double> nanoseconds = part_of_time(json, {"nanosec", "nanosecs", "nsec", "nsecs"});
    if (!seconds && !nanoseconds)
        throw InvalidInput("is empty; " + keys);
    return seconds.value_or(0) + 1e-9 * nanoseconds.value_or(0);
}

std::vector<std::string> other_keys(const Json& json, std::initializer_list<std::string_view> known) {
    std::vector<std::string> others;
    if (json.is_object())
        for (const auto& [key, value] : json.items())
            if (std::ranges::find(known, key) == known.end() && !value.is_null())
                others.push_back(key);
    return others;
}

} // namespace chasles::cli
