// Joins each option that takes several numbers with those that follow it, and refuses empty values.
#include "cli/arguments.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace chasles::cli {
namespace {

constexpr auto take_numbers =
    std::to_array<std::string_view>({"--start", "--goal", "--fixed-start", "--fixed-goal", "--centre", "--fixed-centre",
                                     "--lock-axis", "--lock-point"});

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

// Null for an argument that is no option of the command.
const CLI::Option* option_of(const CLI::App& command, std::string_view argument) {
    const std::string name(argument.substr(0, argument.find('=')));
    return name.starts_with("--") ? command.get_option_no_throw(name) : nullptr;
}

// The value that follows an option, as "--option=value" or as the next argument. Empty if there is none.
std::optional<std::string_view> value_at(const std::vector<std::string>& arguments, std::size_t i) {
    const std::string_view argument = arguments[i];
    if (const std::size_t sign = argument.find('='); sign != std::string_view::npos)
        return argument.substr(sign + 1);
    return i + 1 < arguments.size() ? std::optional<std::string_view>(arguments[i + 1]) : std::nullopt;
}

// CLI11 would take the next argument for the value that is missing, and an empty name for an option that is not given.
void require_value(const CLI::Option& option, const std::vector<std::string>& arguments, std::size_t i) {
    if (option.get_items_expected_max() > 0 && value_at(arguments, i) == "")
        throw InvalidInput(option.get_name() + ": is empty, but takes " + option.get_type_name());
}

bool has_empty_entry(std::string_view list) {
    const bool is_open = list.starts_with(',') || list.ends_with(',');
    return is_open || list.find(",,") != std::string_view::npos;
}

// CLI11 would leave the entry out. A list may have several arguments.
void require_entries(const CLI::Option& option, const std::vector<std::string>& arguments, std::size_t i) {
    if (option.get_delimiter() == '\0')
        return;
    const auto check = [&](std::string list) {
        std::erase_if(list, [](char c) { return c == ' ' || c == '\t'; });
        if (has_empty_entry(list))
            throw InvalidInput(option.get_name() + ": " + io::in_quotes(list) +
                               ": an entry before or after a comma is empty");
    };
    check(std::string(value_at(arguments, i).value_or("")));
    for (std::size_t next = i + 1; next < arguments.size() && !arguments[next].starts_with("--"); ++next)
        check(arguments[next]);
}

} // namespace

void require_values(const CLI::App& app, const std::vector<std::string>& arguments) {
    const auto is_asked = [&](const CLI::App* command) {
        return !arguments.empty() && command->get_name() == arguments.front();
    };
    for (const CLI::App* command : app.get_subcommands(is_asked))
        for (std::size_t i = 1; i < arguments.size(); ++i)
            if (const CLI::Option* const option = option_of(*command, arguments[i])) {
                require_value(*option, arguments, i);
                require_entries(*option, arguments, i);
            }
}

std::vector<std::string> join_numbers(const std::vector<std::string>& arguments) {
    std::vector<std::string> joined;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        joined.push_back(arguments[i]);
        const bool takes_numbers = std::ranges::find(take_numbers, arguments[i]) != take_numbers.end();
        if (!takes_numbers || i + 1 == arguments.size() || arguments[i + 1].starts_with("--"))
            continue;
        joined.back() += "=" + arguments[++i];
        while (i + 1 < arguments.size() && holds_numbers(arguments[i + 1]))
            joined.back() += " " + arguments[++i];
    }
    return joined;
}

} // namespace chasles::cli
