// Values of messages of ROS that were read from YAML or JSON: numbers, lists and times.
#pragma once

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::cli {

/// Levels of lists and messages around a trajectory or a state.
constexpr int deepest_wrapper = 8;

/// The text of a value. YAML may hold bytes that are no UTF-8.
std::string shown(const nlohmann::json& json);

/// The member of an object. Null if there is no object, no member or no value.
const nlohmann::json* find_in(const nlohmann::json& json, const char* key);

/// Throws InvalidInput for anything but a finite number or its text.
double finite_in(const nlohmann::json& json);
/// Throws InvalidInput for anything but a list.
const nlohmann::json& entries_of(const nlohmann::json& json);
/// The names in a list. Throws InvalidInput for anything but a list of texts.
std::vector<std::string> names_in(const nlohmann::json& json);

/// A duration or the time of a stamp, in seconds: a number, or an object with sec or secs, and with nanosec, nanosecs,
/// nsec or nsecs, of which one may be left out where it is 0. Throws InvalidInput for any other key.
double seconds_in(const nlohmann::json& json);

/// The keys of an object that are not among the known ones and have a value.
std::vector<std::string> other_keys(const nlohmann::json& json, std::initializer_list<std::string_view> known);

} // namespace chasles::cli
