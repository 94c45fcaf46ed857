// chasles scene: many bodies in one world.
#include "chasles/io/text_scan.h"
#include "cli/certificate_file.h"
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/output.h"
#include "cli/profile_report.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/scene_clearance.h"
#include "cli/scene_file.h"
#include "cli/scene_matrix.h"
#include "cli/untested_text.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/page.h"
#include "view/why_uncertain.h"

#include "cli/options.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace chasles::cli {
namespace {

struct SceneOptions {
    std::string file;
    PolyhedronOptions polyhedron;
    std::string margin; ///< empty: that of the file
    std::string hold;   ///< likewise
    std::string until = "1";
    std::string time_tolerance = "1e-12";
    std::string seconds;   ///< empty: no limit
    std::string tolerance; ///< of the clearance or the profile; empty: that of the library
    ProfileFlags profile;
    CertificateOptions certificate;
    std::string page; ///< empty: none
    std::string title;
    bool finds_clearance = false;
    bool finds_profile = false;
    bool finds_matrix = false;
    bool wants_curve = false; ///< on the page
    bool all = false;
    bool any = false;
    bool all_contacts = false;
    bool json = false;
};

QueryOptions query_options(const SceneOptions& options, const SceneFile& file) {
    return {.margin = file.margin,
            .hold = options.hold.empty() ? file.hold : number_of("--hold", options.hold),
            .time_tolerance = number_of("--time-tolerance", options.time_tolerance),
            .find = options.any            ? Find::any
                    : options.all_contacts ? Find::first_with_all_contacts
                                           : Find::first};
}

LeastDistanceOptions least_options(const SceneOptions& options) {
    return {.tolerance = options.tolerance.empty() ? LeastDistanceOptions().tolerance
                                                   : number_of("--tolerance", options.tolerance),
            .time_tolerance = number_of("--time-tolerance", options.time_tolerance),
            .find = options.all_contacts ? Find::first_with_all_contacts : Find::first};
}

std::string pair_of(const Scene& scene, const SceneContact& contact) {
    return scene.bodies()[contact.moving].name + " on " + scene.bodies()[contact.fixed].name;
}

std::string summary(const Scene& scene, const SceneAnswer& answer) {
    return labelled("scene",
                    fmt::format("{} {}, {} may touch", scene.bodies().size(),
                                scene.bodies().size() == 1 ? "body" : "bodies", counted(answer.pairs, "pair"))) +
           report(answer.work);
}

std::string headline_without_contact(const SceneAnswer& answer, const SceneQuery& query) {
    return answer.verdict == Verdict::unknown
               ? unknown_headline(answer.clear_until, query.options.margin, query.options.hold)
               : clear_headline(answer.untested, query.options, query.until);
}

/// The first contact in full, and a line for each that may be at the same time.
std::string report_first(const SceneFile& file, const SceneAnswer& answer, const SceneQuery& query) {
    const Scene& scene = file.scene;
    const double margin = query.options.margin;
    if (answer.contacts.empty())
        return naming_motion(headline_without_contact(answer, query), file.motion) + report_of_scene(answer.untested) +
               summary(scene, answer);
    const SceneContact& first = answer.contacts.front();
    std::string text = headline(first.contact, margin, file.motion) + report_of_scene(answer.untested) +
                       labelled("pair", pair_of(scene, first)) +
                       report_contact(first.contact, margin, view::why_uncertain(first.contact)) +
                       way_out_line(first.contact, query.options,
                                    {scene.bodies()[first.moving].shape, scene.bodies()[first.fixed].shape});
    for (std::size_t i = 1; i < answer.contacts.size(); ++i)
        text += labelled(i == 1 ? "also" : "", pair_of(scene, answer.contacts[i]));
    return text + summary(scene, answer);
}

/// A line for each pair that touches.
std::string report_all(const SceneFile& file, const SceneAnswer& answer, const SceneQuery& query) {
    const Scene& scene = file.scene;
    if (answer.verdict == Verdict::unknown)
        return report_first(file, answer, query);
    const auto certain = std::size_t(
        std::ranges::count_if(answer.contacts, [](const SceneContact& found) { return found.contact.certain; }));
    const std::size_t open = answer.contacts.size() - certain;
    const std::string verb = certain == 1 ? " touches" : " touch";
    const std::string perhaps = open > 0 ? fmt::format(", {}{} perhaps", open, certain > 0 ? " more" : "") : "";
    const std::string limit = query.until < 1 ? " " + during(query.until) : "";
    std::string text = naming_motion(counted(certain, "pair") + verb + perhaps + limit, file.motion) +
                       report_of_scene(answer.untested);
    for (const SceneContact& contact : answer.contacts)
        text += labelled(fmt::format("{:.6f}", contact.contact.time.lower),
                         pair_of(scene, contact) + (contact.contact.certain ? "" : " (not certain)"));
    return text + summary(scene, answer);
}

std::string title_of(const SceneOptions& options) {
    return options.title.empty() ? std::filesystem::path(options.file).filename().string() : options.title;
}

/// The page of an answer. The file is opened before the question is answered.
class PageFile {
public:
    explicit PageFile(const SceneOptions& options) : options_(options) {
        if (options.page.empty())
            return;
        view::require_page_template();
        file_.emplace(options.page);
    }
    /// After the verdict: the page of many bodies may take longer than the answer.
    void write(const Scene& scene, const SceneAnswer& answer, const SceneQuery& query) {
        if (!file_ || answer.verdict == Verdict::unknown)
            return;
        using enum view::RecordSource;
        view::SceneRecord record = view::scene_record(scene, answer, options_.all ? all_contacts : first_contact);
        record.margin = query.options.margin;
        record.until = query.until;
        if (options_.wants_curve)
            record.curve = view::curve_of(scene, query.options.margin);
        record.title = title_of(options_);
        file_->write(view::scene_page(record));
        file_->close();
        if (!options_.json)
            print(page_lines(options_.page, shapes_of(scene.bodies())));
    }

private:
    const SceneOptions& options_;
    std::optional<OutputFile> file_;
};

std::string report_of(const SceneOptions& options, const SceneFile& file, const SceneAnswer& answer,
                      const SceneQuery& asked, const view::Json& json) {
    if (options.json)
        return json_line(json, file);
    return options.all ? report_all(file, answer, asked) : report_first(file, answer, asked);
}

/// An error names the file, unless it is about an option.
SceneAnswer answer_of(const SceneOptions& options, const SceneFile& file, const SceneQuery& query) {
    try {
        return options.all ? file.scene.all_contacts(query) : file.scene.first_contact(query);
    } catch (const InvalidInput& error) {
        const std::string why = error.what();
        const bool has_hold_of_file = file.hold && options.hold.empty();
        if (why.starts_with("query: ") && !has_hold_of_file)
            throw;
        throw InvalidInput(io::one_line(options.file) + ": " + why);
    }
}

int run_scene(const SceneOptions& options) {
    require_question_of(options.tolerance, options.finds_clearance || options.finds_profile || options.finds_matrix,
                        "--clearance, --profile or --matrix");
    require_answer_of(options.profile, options.finds_profile || options.finds_matrix);
    std::optional<double> margin;
    if (!options.margin.empty())
        margin = number_of("--margin", options.margin);
    const SceneFile file = load_scene(options.file, options.polyhedron, margin);
    if (options.finds_clearance)
        return run_scene_clearance({file, least_options(options), options.seconds, options.json});
    if (options.finds_profile)
        return run_scene_profile({file, options.profile, options.tolerance, options.seconds, options.json});
    if (options.finds_matrix)
        return run_scene_matrix({file, least_options(options), options.polyhedron.threads, options.seconds,
                                 options.json, options.profile.csv, options.profile.plot, options.page,
                                 title_of(options), options.wants_curve});
    PageFile page(options);
    CertificateFile certificate(options.certificate);
    const Interruption interruption;
    const Limit limit(seconds_of(options.seconds), [] { return !Interruption::is_requested(); });
    std::optional<ProgressBar> bar;
    SceneQuery query{.options = query_options(options, file),
                     .until = number_of("--until", options.until),
                     .threads = options.polyhedron.threads};
    query.progress = [&](std::size_t done, std::size_t pairs) {
        if (!bar)
            bar.emplace("pairs", pairs);
        bar->show(done);
        return true;
    };
    SceneAnswer answer = answer_of(options, file, query);
    answer.untested = file.scene.untested(query); // with names
    bar.reset();
    if (Interruption::is_requested() && answer.verdict == Verdict::unknown)
        return report_interruption("the scene is not answered");
    view::Json json = view::scene_answer_json(file.scene, answer, options.all);
    const bool is_in_time = certificate.write([&] { return certify(file.scene, query); }, json);
    print(report_of(options, file, answer, query, json));
    print_warnings(file.warnings);
    page.write(file.scene, answer, query);
    return is_in_time ? status_of(answer.verdict) : is_unknown;
}

} // namespace

void add_scene(CLI::App& app, Task& task) {
    const auto options = std::make_shared<SceneOptions>();
    CLI::App& command = *app.add_subcommand("scene", "Which of many moving bodies touch first, and when?");
    command.add_option("SCENE", options->file, "JSON file with bodies, motions and filters")
        ->required()
        ->type_name("FILE");
    add_mesh_options(command, options->polyhedron);
    add_radius_option(command, options->polyhedron.radius, "a body");
    auto* const all = command.add_flag("--all", options->all, "list the first contact of each pair, in order of time");
    auto* const clearance = command.add_flag("--clearance", options->finds_clearance,
                                             "find how near the bodies come to each other, and which two");
    clearance->excludes(all);
    auto* const profile = command.add_flag("--profile", options->finds_profile,
                                           "find the distance of the nearest two bodies over the time, and which two");
    profile->excludes(all)->excludes(clearance);
    auto* const matrix = command.add_flag("--matrix", options->finds_matrix,
                                          "find how near each two bodies come to each other, or when they touch");
    matrix->excludes(all)->excludes(clearance)->excludes(profile);
    command
        .add_option("--tolerance", options->tolerance,
                    "aimed width of the bracket of each distance, as a part of it (1e-6), or of the profile (0.01)")
        ->type_name("T");
    add_profile_options(command, options->profile, profile);
    command.get_option("--csv")->remove_needs(profile);
    command.get_option("--csv")->description(
        "write the bounds of the profile, or the pairs of the matrix, to this file");
    command.get_option("--plot")->remove_needs(profile);
    command.get_option("--plot")->description("draw the bounds of the profile, or the matrix, as SVG");
    command.add_option("--until", options->until, "leave out contacts after this time")
        ->excludes(clearance)
        ->excludes(profile)
        ->excludes(matrix)
        ->type_name("T")
        ->capture_default_str();
    command
        .add_option("--margin", options->margin,
                    "distance of the surfaces that counts as contact; instead of the file's")
        ->excludes(clearance)
        ->excludes(profile)
        ->excludes(matrix)
        ->type_name("D");
    command
        .add_option("--hold", options->hold,
                    "bodies that start within the margin may move on, but never come within this distance; instead of "
                    "the file's")
        ->excludes(clearance)
        ->excludes(profile)
        ->excludes(matrix)
        ->type_name("H");
    command.add_option("--time-tolerance", options->time_tolerance, "aimed width of the bracket around the time")
        ->type_name("T")
        ->capture_default_str();
    auto* const any = command.add_flag("--any", options->any, "stop at any contact, which need not be the first one");
    any->excludes(all);
    any->excludes(clearance)->excludes(profile)->excludes(matrix);
    command
        .add_flag("--all-contacts", options->all_contacts, "list every contact of a pair at the time of the first one")
        ->excludes(any);
    add_certificate_options(command, options->certificate)
        ->excludes(all)
        ->excludes(any)
        ->excludes(clearance)
        ->excludes(profile)
        ->excludes(matrix);
    command.add_option("--threads", options->polyhedron.threads, "number of threads; 0 for all cores")
        ->capture_default_str();
    add_seconds_option(command, options->seconds);
    command.add_flag("--json", options->json, "print one JSON object");
    auto* const page =
        command.add_option("--page", options->page, "write a page (HTML) that shows the scene and its contacts too")
            ->excludes(clearance)
            ->excludes(profile)
            ->type_name("FILE");
    command.add_option("--title", options->title, "title of the page; default: the name of the scene file")
        ->type_name("TEXT")
        ->needs(page);
    add_curve_option(command, options->wants_curve)->needs(page);
    command.callback([options, &task] { task = [options] { return run_scene(*options); }; });
}

} // namespace chasles::cli
