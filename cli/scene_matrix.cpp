#include "cli/scene_matrix.h"

#include "chasles/base/limit.h"
#include "chasles/base/number_text.h"
#include "chasles/io/csv_table.h"
#include "cli/matrix_picture.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/profile_report.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/untested_text.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/names.h"
#include "view/nearest_first.h"
#include "view/page.h"
#include "view/proven_verdict.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace chasles::cli {
namespace {

std::string pair_text(const Scene& scene, const PairDistance& pair) {
    return scene.bodies()[pair.moving].name + " on " + scene.bodies()[pair.fixed].name;
}

std::size_t count_of(const DistanceMatrix& found, Verdict verdict) {
    return std::size_t(std::ranges::count_if(
        found.pairs, [&](const PairDistance& pair) { return view::proven_verdict(pair.nearest) == verdict; }));
}

Bracket least_of(const DistanceMatrix& found) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Bracket least{infinity, infinity};
    for (const PairDistance& pair : found.pairs)
        least = {std::min(least.lower, pair.nearest.distance.lower),
                 std::min(least.upper, pair.nearest.distance.upper)};
    return least;
}

std::string headline_of(const DistanceMatrix& found, bool time_was_over) {
    if (found.pairs.empty())
        return "CLEARANCE WITHOUT A LIMIT: no two bodies are tested";
    const std::string of_all = " of " + counted(found.pairs.size(), "pair");
    const std::size_t touching = count_of(found, Verdict::contact) + count_of(found, Verdict::contact_at_start),
                      open = count_of(found, Verdict::unknown);
    if (touching > 0)
        return fmt::format("TOUCH: {}{}{}", touching, of_all, open > 0 ? fmt::format(", {} more perhaps", open) : "");
    if (open > 0)
        return fmt::format("NO CLEARANCE PROVEN: {}{}{}", open, of_all, time_was_over ? "; the time was over" : "");
    return fmt::format("CLEARANCE {:.9g}: the least one{}", least_of(found).lower, of_all);
}

std::string touch_text(const LeastDistance& nearest) {
    if (nearest.time.upper > 0)
        return "at time " + time_text(nearest.time.lower);
    if (nearest.inside)
        return "at the start, one inside of the other";
    return nearest.overlap ? "at the start, overlapping" : "at the start";
}

std::string text_of(const SceneFile& file, const DistanceMatrix& found, bool time_was_over) {
    std::string text =
        naming_motion(headline_of(found, time_was_over), file.motion) + report_of_scene(found.untested, "--matrix");
    const std::vector<const PairDistance*> pairs = view::nearest_first(found);
    std::size_t width = 0, numbers = 0;
    for (const PairDistance* pair : pairs) {
        width = std::max(width, pair_text(file.scene, *pair).size());
        numbers = std::max(numbers, view::distance_text(pair->nearest).size());
    }
    std::string last;
    for (const PairDistance* pair : pairs) {
        const LeastDistance& nearest = pair->nearest;
        const std::string label = nearest.distance.upper == 0 ? "contact" : "distance";
        const std::string name = fmt::format("{:<{}}  ", pair_text(file.scene, *pair), width);
        text += labelled(label == last ? "" : label,
                         label == "contact" ? name + touch_text(nearest)
                                            : fmt::format("{}{:<{}}  at time {}", name, view::distance_text(nearest),
                                                          numbers, time_text(nearest.time.lower)));
        last = label;
    }
    if (found.pairs.size() > pairs.size())
        text += labelled("", fmt::format("and {} more, farther apart: --csv and --json have all",
                                         found.pairs.size() - pairs.size()));
    Work work;
    for (const PairDistance& pair : found.pairs)
        work += pair.nearest.work;
    return text + report(work);
}

std::string json_of(const SceneFile& file, const DistanceMatrix& found, ExitStatus status) {
    view::Json answer = view::distance_matrix_json(file.scene, found);
    if (status == is_unknown)
        answer["verdict"] = view::name_of(Verdict::unknown);
    return json_line(std::move(answer), file);
}

std::string csv_of(const Scene& scene, const DistanceMatrix& found) {
    std::string text = "first,second,distance,distance_upper,time,time_upper,certain\n";
    for (const auto& [moving, fixed, nearest] : found.pairs)
        text += fmt::format("{},{},{},{},{},{},{}\n", io::csv_cell(scene.bodies()[moving].name),
                            io::csv_cell(scene.bodies()[fixed].name), nearest.distance.lower, nearest.distance.upper,
                            nearest.time.lower, nearest.time.upper, nearest.certain);
    return text;
}

/// The files of an answer. They are opened before the question is answered.
class Files {
public:
    explicit Files(const SceneMatrixQuestion& question) : question_(question) {
        require_svg(question.plot);
        if (!question.page.empty())
            view::require_page_template();
        open(csv_, question.csv);
        open(plot_, question.plot);
        open(page_, question.page);
    }
    void write(const DistanceMatrix& found) {
        const Scene& scene = question_.file.scene;
        write_to(csv_, [&] { return csv_of(scene, found); });
        write_to(plot_, [&] { return matrix_picture(scene, found); });
        write_to(page_, [&] {
            view::SceneRecord record = view::scene_record(scene, found);
            record.title = question_.title;
            if (question_.wants_curve)
                record.curve = view::curve_of(scene, 0);
            return view::scene_page(record);
        });
        if (page_ && !question_.json)
            print(page_lines(question_.page, shapes_of(scene.bodies())));
    }

private:
    static void open(std::optional<OutputFile>& file, const std::string& name) {
        if (!name.empty())
            file.emplace(name);
    }

    const SceneMatrixQuestion& question_;
    std::optional<OutputFile> csv_, plot_, page_;
};

DistanceMatrix answer_of(const SceneMatrixQuestion& question) {
    const Scene& scene = question.file.scene;
    std::optional<ProgressBar> bar;
    const std::size_t pairs = scene.untested().tested;
    DistanceMatrix found =
        scene.least_distances(question.options, {.threads = question.threads, .progress = [&](std::size_t done) {
                                                     if (!bar)
                                                         bar.emplace("pairs", pairs);
                                                     bar->show(done);
                                                 }});
    found.untested = scene.untested(); // with names
    return found;
}

} // namespace

int run_scene_matrix(const SceneMatrixQuestion& question) {
    Files files(question);
    const Limit limit(seconds_of(question.seconds));
    const DistanceMatrix found = answer_of(question);
    const bool time_was_over =
        limit.is_over() && std::ranges::any_of(found.pairs, [](const auto& pair) { return !pair.nearest.certain; });
    const ExitStatus status = status_of(least_of(found), time_was_over);
    print(question.json ? json_of(question.file, found, status) : text_of(question.file, found, time_was_over));
    print_warnings(question.file.warnings);
    files.write(found);
    return status;
}

} // namespace chasles::cli
