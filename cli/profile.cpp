// chasles profile: how far apart two bodies are over a motion, with bounds, and when they are within margins.
#include "chasles/base/number_text.h"
#include "cli/commands.h"
#include "cli/one_motion.h"
#include "cli/output.h"
#include "cli/profile_picture.h"
#include "cli/report.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/names.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace chasles::cli {
namespace {

struct ProfileCommand {
    OneMotionOptions question;
    std::string tolerance = "0.01";
    std::string absolute_tolerance = "0";
    std::vector<std::string> margins;
    std::string csv;
    std::string plot;
    bool json = false;
};

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

view::Json profile_json(const DistanceProfile& found, const std::vector<double>& margins, ExitStatus status) {
    view::Json zones = view::Json::array();
    for (const double margin : margins) {
        const Zones parts = found.zones(margin);
        zones.push_back(
            {{"margin", margin}, {"inside", intervals_json(parts.inside)}, {"doubt", intervals_json(parts.doubt)}});
    }
    view::Json json{{"times", found.times},     {"lower", found.lower}, {"upper", found.upper},
                    {"certain", found.certain}, {"zones", zones},       {"free", intervals_json(found.free())}};
    if (status == is_unknown)
        json["verdict"] = view::name_of(Verdict::unknown);
    return json;
}

std::string profile_text(const DistanceProfile& found, const OneMotion& question, const std::vector<double>& margins) {
    const auto least = std::ranges::min_element(found.lower), most = std::ranges::max_element(found.upper);
    const std::string motion = "; motion: " + std::string(view::name_of(question.numbers.kind)) + "\n";
    std::string text =
        *least > 0 ? fmt::format("DISTANCE from {:.9g} to {:.9g}: never below, never above", *least, *most) + motion
                   : fmt::format("DISTANCE from 0 to {:.9g}: the bodies touch, or may touch", *most) + motion;
    text += labelled("steps", fmt::format("{}, {}", found.times.size() - 1,
                                          found.certain ? "as narrow as asked"
                                                        : "some of them wider than asked: the time was over, or the "
                                                          "bounds of the motion tell no more"));
    text += labelled("free", intervals_text(found.free()));
    for (const double margin : margins) {
        const Zones zones = found.zones(margin);
        const bool is_open = zones.inside.empty() && !zones.doubt.empty();
        text += labelled(
            "within", fmt::format("{:.9g}: {}", margin, is_open ? "nowhere for sure" : intervals_text(zones.inside)));
        if (!zones.doubt.empty())
            text += labelled("", fmt::format("in doubt for {:.3g} of the motion", length_of(zones.doubt)));
    }
    return text;
}

std::string csv_of(const DistanceProfile& found) {
    std::string text = "time,lower,upper\n";
    for (std::size_t i = 0; i < found.times.size(); ++i)
        text += fmt::format("{},{},{}\n", found.times[i], found.lower[i], found.upper[i]);
    return text;
}

/// A file that is refused before the answer is looked for; empty without a name.
std::optional<OutputFile> file_of(const std::string& name) {
    return name.empty() ? std::nullopt : std::optional<OutputFile>(std::in_place, name);
}

void write(OutputFile& file, const std::string& text) {
    file.write(text);
    file.close();
}

int run_profile(const ProfileCommand& options) {
    ProfileOptions asked{.tolerance = number_of("--tolerance", options.tolerance),
                         .absolute_tolerance = number_of("--absolute-tolerance", options.absolute_tolerance)};
    for (const std::string& margin : options.margins)
        asked.margins.push_back(number_of("--margins", margin));
    if (std::filesystem::path(options.plot).extension() == ".png")
        throw InvalidInput("--plot: " + options.plot +
                           ": pictures are SVG: name a file .svg; Python's profile.plot() draws others");
    const OneMotion question = read_one_motion(options.question);
    std::optional<OutputFile> csv = file_of(options.csv), plot = file_of(options.plot);
    const Limit limit(question.seconds);
    const DistanceProfile found = profile({.moving = question.bodies.moving,
                                           .fixed = question.bodies.fixed,
                                           .motion = question.motion,
                                           .options = asked});
    if (csv)
        write(*csv, csv_of(found));
    if (plot)
        write(*plot, profile_picture(found, asked.margins));
    const Bracket least{*std::ranges::min_element(found.lower), *std::ranges::min_element(found.upper)};
    const ExitStatus status = status_of(least, !found.certain && limit.is_over());
    if (options.json) {
        view::Json json = profile_json(found, asked.margins, status);
        add_warnings(json, question.bodies.warnings);
        print(json.dump() + "\n");
    } else {
        print(profile_text(found, question, asked.margins));
    }
    return status;
}

} // namespace

void add_profile(CLI::App& app, Task& task) {
    const auto options = std::make_shared<ProfileCommand>();
    CLI::App& command =
        *app.add_subcommand("profile", "How far apart are two bodies over a motion, and when are they within margins?");
    add_motion_options(command, options->question);
    command
        .add_option("--tolerance", options->tolerance, "greatest difference of the bounds, as a part of the distance")
        ->type_name("T")
        ->capture_default_str();
    command
        .add_option("--absolute-tolerance", options->absolute_tolerance,
                    "differences of less do not matter, mesh unit; 0: a millionth of the bodies' size")
        ->type_name("T")
        ->capture_default_str();
    command.add_option("--margins", options->margins, "distances: when the bodies are within each of them, mesh unit")
        ->type_name("A,B,..")
        ->delimiter(',');
    command.add_option("--csv", options->csv, "write the bounds to this file: time, lower, upper")->type_name("FILE");
    command.add_option("--plot", options->plot, "draw the bounds, as SVG")->type_name("FILE");
    add_seconds_option(command, options->question.query.seconds);
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_profile(*options); }; });
}

} // namespace chasles::cli
