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

bool is_comment(std::string_view text) {
    return text.starts_with("//") || text.starts_with("/*") || text.starts_with('#');
}

void require_no_comment(std::string_view text, std::size_t place) {
    if (!is_comment(text.substr(place)))
        return;
    const auto line = std::ranges::count(text.substr(0, place), '\n') + 1;
    io::fail_at_line(std::size_t(line), io::in_quotes(text.substr(place, text.find_first_of("\r\n", place) - place)) +
                                            " is a comment, and JSON has none");
}

} // namespace

std::string_view without_comments(std::string_view text) {
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        if (!is_comment(text))
            return text;
        const std::string_view end = text.starts_with("/*") ? "*/" : "\n";
        const std::size_t size = text.find(end);
        text.remove_prefix(size == std::string_view::npos ? text.size() : size + end.size());
    }
}

nlohmann::json parse_json(std::string_view text) {
    DifferentKeys watch;
    const std::string_view content = io::without_byte_order_mark(text);
    try {
        return Json::parse(content, std::ref(watch));
    } catch (const Json::exception& error) {
        const auto* const parse_error = dynamic_cast<const Json::parse_error*>(&error);
        if (parse_error && parse_error->byte > 0)
            require_no_comment(content, parse_error->byte - 1);
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
