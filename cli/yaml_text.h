// YAML as JSON, so that one reader takes both.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace chasles::cli {

/// The documents of a text as a list. Every scalar is a text. Throws InvalidInput for text that is no YAML, for a key
/// that comes twice in one map, for deep nesting, and for aliases that make much more than the text has.
nlohmann::json parse_yaml(const std::string& text);

} // namespace chasles::cli
