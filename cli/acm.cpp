// chasles acm: which links of a robot can ever touch, proven.
#include "chasles/robot/srdf_writer.h"
#include "cli/commands.h"
#include "cli/interruption.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/robot_options.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/names.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace chasles::cli {
namespace {

struct AcmOptions {
    RobotOptions robot;
    std::string seconds = "600";
    std::string out;
    unsigned threads = 0;
    bool json = false;
};

std::string remark(const Robot& robot, const PairProof& proof) {
    if (proof.reason == PairReason::sometimes && !robot.is_tested(proof.first, proof.second))
        return ", but the robot does not test it";
    if (proof.reason == PairReason::open && proof.tried > 0)
        return fmt::format(", touching in {} of {} configurations that were tried",
                           proof.touching == proof.tried ? "all" : std::to_string(proof.touching), proof.tried);
    return {};
}

std::string listed(const Robot& robot, const std::vector<PairProof>& proofs) {
    std::string text;
    std::size_t width = 0;
    for (const PairProof& proof : proofs)
        width = std::max(width, proof.first.size() + proof.second.size() + 4);
    for (const PairProof& proof : proofs)
        text += fmt::format("{:<{}}{}{}\n", proof.first + "  " + proof.second, width, view::name_of(proof.reason),
                            remark(robot, proof));
    return text;
}

/// Each two links with shapes are a pair.
std::string counts(const Robot& robot, const std::vector<PairProof>& proofs) {
    const auto& links = robot.description().links;
    if (proofs.empty())
        return fmt::format("no pair: a pair needs two links with collision shapes, and there are {} among {}\n",
                           std::ranges::count_if(links, [](const auto& link) { return !link.collisions.empty(); }),
                           counted(links.size(), "link"));
    std::string text;
    for (const PairReason reason :
         {PairReason::never, PairReason::always, PairReason::adjacent, PairReason::sometimes, PairReason::open})
        if (const auto count = std::ranges::count(proofs, reason, &PairProof::reason); count > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, view::name_of(reason));
    return text + "\n";
}

int run_acm(const AcmOptions& options) {
    PairProofOptions search{.seconds = number_of("--seconds", options.seconds), .threads = options.threads};
    const NamedRobots robots = load_robots(options.robot);
    const Robot robot = together(robots);
    if (!options.out.empty() && is_cell(robots))
        throw InvalidInput(
            "--out: an SRDF file is that of one robot, whose links have no name of a robot in front: ask "
            "about each robot alone");
    std::optional<OutputFile> file;
    if (!options.out.empty())
        file.emplace(options.out);
    const Interruption interruption;
    std::optional<ProgressBar> bar;
    search.progress = [&](std::size_t done, std::size_t pairs) {
        if (!bar)
            bar.emplace("pairs", pairs, "the rest stays open after " + options.seconds + " s (--seconds)");
        bar->show(done);
        return !Interruption::is_requested();
    };
    const std::vector<PairProof> proofs = prove_pairs(robot, search);
    bar.reset();
    const bool is_whole = !Interruption::is_requested();
    if (file && is_whole) {
        file->write(robot::srdf_text(robot, proofs, options.robot.srdfs.empty() ? "" : options.robot.srdfs.front()));
        file->close();
    }
    print(options.json ? view::pair_proofs_json(robot, proofs).dump() + "\n"
                       : listed(robot, proofs) + counts(robot, proofs));
    print_warnings(robot.warnings());
    return is_whole ? is_clear
                    : report_interruption(std::string("pairs that are not decided are open") +
                                          (file ? "; no file is written" : ""));
}

} // namespace

void add_acm(CLI::App& app, Task& task) {
    const auto options = std::make_shared<AcmOptions>();
    CLI::App& command = *app.add_subcommand("acm", "Which links of a robot can ever touch? Proven, not sampled.");
    add_cell_options(command, options->robot);
    add_radius_option(command, options->robot.radii.first, "a shape of the robot");
    command.add_option("--seconds", options->seconds, "what is not decided after this time stays open")
        ->type_name("T")
        ->capture_default_str();
    command.add_option("--out", options->out, "write the result as an SRDF file; groups and states of --srdf are kept")
        ->type_name("FILE");
    command.add_option("--threads", options->threads, "number of threads; 0 for all cores")->capture_default_str();
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_acm(*options); }; });
}

} // namespace chasles::cli
