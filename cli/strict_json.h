// JSON files of users: what is wrong gets one line, and no key may come twice in one object.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace chasles::cli {

/// Throws InvalidInput "is not JSON: WHY", and for a key that comes twice in one object.
nlohmann::json parse_json(std::string_view text);

/// The text without blanks and comments at its start: those of JSON with comments, and "#".
std::string_view without_comments(std::string_view text);

/// The text with NaN, Infinity and -Infinity in quotes, as texts: Python's json writes these words, which are no JSON.
std::string with_quoted_nan(std::string_view text);

} // namespace chasles::cli
