// Of two equal keys, a parser keeps one and drops the other without a word. Here they are an error.
#include "cli/strict_json.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace chasles::cli {
namespace {

using Json = nlohmann::json;

/// Follows a parser through the objects of a text.
class DifferentKeys {
public:
    // NOLINTNEXTLINE(readability-non-const-parameter): the parser demands this signature
    bool operator()(int /*depth*/, Json::parse_event_t event, Json& parsed) {
        if (event == Json::parse_event_t::object_start)
            open_.emplace_back();
        else if (event == Json::parse_event_t::object_end)
            open_.pop_back();
        else if (event == Json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second)
            throw InvalidInput("the key " + io::in_quotes(parsed.get<std::string>()) + " comes twice in one object");
        return true;
    }

private:
    std::vector<std::set<std::string>> open_; ///< keys of the objects that have begun and not ended
};

} // namespace

nlohmann::json parse_json(std::string_view text) {
    DifferentKeys watch;
    try {
        return Json::parse(io::without_byte_order_mark(text), std::ref(watch));
    } catch (const Json::exception& error) {
        const std::string why = error.what(); // "[json.exception.parse_error.101] parse error at ..."
        throw InvalidInput("is not JSON: " + why.substr(why.find(']') + 2));
    }
}

std::string with_quoted_nan(std::string_view text) {
    constexpr auto words = std::to_array<std::string_view>({"NaN", "Infinity", "-Infinity"});
    std::string quoted;
    bool is_in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto begins = [&](std::string_view word) { return text.substr(i).starts_with(word); };
        const auto* const word = is_in_text ? words.end() : std::ranges::find_if(words, begins);
        if (word != words.end()) {
            quoted.append("\"").append(*word).append("\"");
            i += word->size() - 1;
            continue;
        }
        if (text[i] == '"')
            is_in_text = !is_in_text;
        quoted += text[i];
        if (is_in_text && text[i] == '\\' && i + 1 < text.size())
            quoted += text[++i]; // no end of the text
    }
    return quoted;
}

} // namespace chasles::cli
