// Joins each option with the numbers that follow it. CLI11 would otherwise parse "-.5" as an option.
#include "cli/arguments.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace chasles::cli {
namespace {

constexpr auto takes_numbers =
    std::to_array<std::string_view>({"--start", "--goal", "--fixed-start", "--fixed-goal", "--centre", "--fixed-centre",
                                     "--lock-axis", "--lock-point"});
constexpr auto takes_number = std::to_array<std::string_view>(
    {"--margin", "--hold", "--max-turn-deg", "--time-tolerance", "--tolerance", "--threads", "--friction"});
constexpr auto takes_file = std::to_array<std::string_view>(
    {"--out", "--page", "--save", "--poses", "--motions", "--goals", "--path", "--scene", "--srdf"});

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

// CLI11 would take the next argument for the value that is missing, and an empty name for an option that is not given.
void require_value(std::string_view option, std::string_view value) {
    if (value.empty())
        throw InvalidInput(std::string(option) + ": is empty, but takes " +
                           (contains(takes_file, option) ? "the name of a file" : "numbers"));
}

// Checks "--option=" and "--option" followed by an empty argument.
void check_value(const std::vector<std::string>& arguments, std::size_t i) {
    const std::string_view argument = arguments[i];
    const std::size_t sign = argument.find('=');
    const std::string_view name = argument.substr(0, sign);
    if (!contains(takes_numbers, name) && !contains(takes_number, name) && !contains(takes_file, name))
        return;
    if (sign != std::string_view::npos)
        require_value(name, argument.substr(sign + 1));
    else if (i + 1 < arguments.size())
        require_value(name, arguments[i + 1]);
}

} // namespace

std::vector<std::string> join_numbers(const std::vector<std::string>& arguments) {
    std::vector<std::string> joined;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        check_value(arguments, i);
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
