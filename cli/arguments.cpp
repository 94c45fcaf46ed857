// Joins each option with the numbers that follow it. CLI11 would otherwise parse "-.5" as an option.
#include "cli/arguments.h"

#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace chasles::cli {
namespace {

constexpr auto takes_numbers =
    std::to_array<std::string_view>({"--start", "--goal", "--fixed-start", "--fixed-goal", "--centre"});
constexpr auto takes_number =
    std::to_array<std::string_view>({"--margin", "--hold", "--max-turn-deg", "--time-tolerance", "--threads"});

template <typename Names>
bool contains(const Names& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Whether the argument is one or more numbers, separated by blanks or commas.
bool holds_numbers(std::string argument) {
    std::replace(argument.begin(), argument.end(), ',', ' ');
    io::Words words(argument);
    std::string_view word = words.next();
    if (word.empty())
        return false;
    for (; !word.empty(); word = words.next())
        if (!io::parse_number(word))
            return false;
    return true;
}

} // namespace

std::vector<std::string> join_numbers(const std::vector<std::string>& arguments) {
    std::vector<std::string> joined;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        joined.push_back(arguments[i]);
        const bool takes_many = contains(takes_numbers, arguments[i]);
        const bool takes_any = takes_many || contains(takes_number, arguments[i]);
        if (!takes_any || i + 1 == arguments.size() || arguments[i + 1].starts_with("--"))
            continue;
        joined.back() += "=" + arguments[++i];
        while (takes_many && i + 1 < arguments.size() && holds_numbers(arguments[i + 1]))
            joined.back() += " " + arguments[++i];
    }
    return joined;
}

} // namespace chasles::cli
