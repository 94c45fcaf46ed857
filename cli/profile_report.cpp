#include "cli/profile_report.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/io/csv_table.h"
#include "cli/options.h"
#include "cli/profile_picture.h"
#include "view/names.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>

namespace chasles::cli {
namespace {

std::string intervals_text(const std::vector<Bracket>& intervals) {
    std::string text;
    for (const Bracket& part : intervals)
        text += (text.empty() ? "" : ", ") + time_text(part.lower) + " to " + time_text(part.upper);
    return text.empty() ? "never" : text;
}

/// How long the intervals are in all.
double length_of(const std::vector<Bracket>& intervals) {
    double sum = 0;
    for (const Bracket& part : intervals)
        sum += part.upper - part.lower;
    return sum;
}

view::Json intervals_json(const std::vector<Bracket>& intervals) {
    view::Json json = view::Json::array();
    for (const Bracket& part : intervals)
        json.push_back({part.lower, part.upper});
    return json;
}

/// When each pair is the nearest.
std::string nearest_text(const NamedProfile& found) {
    const auto& [distance, pairs, has_names] = found;
    std::vector<std::vector<Bracket>> times(pairs.size());
    for (std::size_t i = 0; i < distance.nearest.size(); ++i) {
        std::vector<Bracket>& own = times[distance.nearest[i]];
        if (!own.empty() && own.back().upper == distance.times[i])
            own.back().upper = distance.times[i + 1];
        else
            own.push_back({distance.times[i], distance.times[i + 1]});
    }
    std::string text;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        text += labelled(i == 0 ? "nearest" : "",
                         pairs[i].first + " and " + pairs[i].second + ": " + intervals_text(times[i]));
    return text;
}

/// A column for each of two names, if pairs have names.
std::string csv_of(const NamedProfile& found) {
    const auto& [distance, pairs, has_names] = found;
    std::string text = !has_names ? "time,lower,upper\n" : "time,lower,upper,first,second\n";
    for (std::size_t i = 0; i < distance.times.size(); ++i) {
        text += fmt::format("{},{},{}", distance.times[i], distance.lower[i], distance.upper[i]);
        if (has_names && pairs.empty())
            text += ",,";
        if (!pairs.empty()) {
            const auto& [first, second] = pairs[distance.nearest[std::min(i, distance.nearest.size() - 1)]];
            text += "," + io::csv_cell(first) + "," + io::csv_cell(second);
        }
        text += "\n";
    }
    return text;
}

} // namespace

void write_to(std::optional<OutputFile>& file, const std::function<std::string()>& text) {
    if (!file)
        return;
    file->write(text());
    file->close();
}

void require_svg(const std::string& plot) {
    if (std::filesystem::path(plot).extension() == ".png")
        throw InvalidInput("--plot: " + plot + ": pictures are SVG: name a file .svg; Python's plot() draws others");
}

void require_answer_of(const ProfileFlags& files, bool is_given) {
    if (!is_given && !(files.csv.empty() && files.plot.empty()))
        throw InvalidInput(std::string(files.csv.empty() ? "--plot" : "--csv") +
                           ": is of --profile or --matrix: give one of them, too");
}

ProfileRequest::ProfileRequest(const ProfileFlags& flags, const std::string& tolerance) : flags_(flags) {
    if (!tolerance.empty())
        options_.tolerance = number_of("--tolerance", tolerance);
    options_.absolute_tolerance = number_of("--absolute-tolerance", flags.absolute_tolerance);
    for (const std::string& margin : flags.margins)
        options_.margins.push_back(number_of("--margins", margin));
    require_svg(flags.plot);
}

void ProfileRequest::open_files() {
    if (!flags_.csv.empty())
        csv_.emplace(flags_.csv);
    if (!flags_.plot.empty())
        plot_.emplace(flags_.plot);
}

void ProfileRequest::write(const NamedProfile& found) {
    write_to(csv_, [&] { return csv_of(found); });
    write_to(plot_, [&] { return profile_picture(found.distance, options_.margins); });
}

std::string ProfileRequest::text(const NamedProfile& found) const {
    const DistanceProfile& distance = found.distance;
    std::string text =
        labelled("steps", fmt::format("{}, {}", distance.times.size() - 1,
                                      distance.certain
                                          ? "as narrow as asked"
                                          : "some of them wider than asked: the time was over, or the bounds of the "
                                            "motion tell no more"));
    text += nearest_text(found) + labelled("free", intervals_text(distance.free()));
    for (const double margin : options_.margins) {
        const Zones zones = distance.zones(margin);
        const bool is_open = zones.inside.empty() && !zones.doubt.empty();
        text += labelled(
            "within", fmt::format("{:.9g}: {}", margin, is_open ? "nowhere for sure" : intervals_text(zones.inside)));
        if (!zones.doubt.empty())
            text +=
                labelled("", fmt::format("in doubt for {:.3g} of the motion",
                                         length_of(zones.doubt) / (distance.times.back() - distance.times.front())));
    }
    return text;
}

view::Json ProfileRequest::json(const NamedProfile& found, ExitStatus status) const {
    const auto& [distance, pairs, has_names] = found;
    view::Json zones = view::Json::array();
    for (const double margin : options_.margins) {
        const Zones parts = distance.zones(margin);
        zones.push_back(
            {{"margin", margin}, {"inside", intervals_json(parts.inside)}, {"doubt", intervals_json(parts.doubt)}});
    }
    view::Json json{{"times", distance.times}, {"lower", distance.lower},
                    {"upper", distance.upper}, {"certain", distance.certain},
                    {"zones", zones},          {"free", intervals_json(distance.free())}};
    if (has_names) {
        json["pairs"] = view::Json::array();
        for (const auto& [first, second] : pairs)
            json["pairs"].push_back({first, second});
        json["nearest"] = distance.nearest;
    }
    if (status == is_unknown)
        json["verdict"] = view::name_of(Verdict::unknown);
    return json;
}

std::string profile_headline(const DistanceProfile& found, std::string_view motion) {
    const double least = *std::ranges::min_element(found.lower), most = *std::ranges::max_element(found.upper);
    if (std::isinf(least))
        return naming_motion("DISTANCE WITHOUT A LIMIT: no two bodies are tested", motion);
    if (least == std::numeric_limits<double>::min())
        return naming_motion(fmt::format("DISTANCE from above 0 to {:.9g}: never 0, never above", most), motion);
    return naming_motion(least > 0
                             ? fmt::format("DISTANCE from {:.9g} to {:.9g}: never below, never above", least, most)
                             : fmt::format("DISTANCE from 0 to {:.9g}: the bodies touch, or may touch", most),
                         motion);
}

ExitStatus status_of(const DistanceProfile& found, bool time_was_over) {
    return status_of(Bracket{*std::ranges::min_element(found.lower), *std::ranges::min_element(found.upper)},
                     time_was_over);
}

void require_question_of(const std::string& tolerance, bool is_given, const std::string& questions) {
    if (!tolerance.empty() && !is_given)
        throw InvalidInput("--tolerance: is that of " + questions + ": give one of them, too");
}

void add_profile_options(CLI::App& command, ProfileFlags& flags, CLI::Option* needed) {
    CLI::Option* const absolute =
        command
            .add_option(
                "--absolute-tolerance", flags.absolute_tolerance,
                "differences of less do not matter, mesh unit; 0: a millionth of the bodies' size, and at most an "
                "eighth of an overlap that is allowed")
            ->type_name("T")
            ->capture_default_str();
    CLI::Option* const margins =
        command.add_option("--margins", flags.margins, "distances: when the bodies are within each of them, mesh unit")
            ->type_name("A,B,..")
            ->delimiter(',');
    CLI::Option* const csv =
        command.add_option("--csv", flags.csv, "write the bounds to this file: time, lower, upper")->type_name("FILE");
    CLI::Option* const plot = command.add_option("--plot", flags.plot, "draw the bounds, as SVG")->type_name("FILE");
    if (needed)
        for (CLI::Option* const option : {absolute, margins, csv, plot})
            option->needs(needed);
}

} // namespace chasles::cli
