// Of two equal keys, a parser keeps one and drops the other without a word. Here they are an error.
#include "cli/strict_json.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

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

} // namespace chasles::cli
