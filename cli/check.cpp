// chasles check: one motion between two poses.
#include "chasles/base/limit.h"
#include "chasles/certificate/certificate.h"
#include "cli/commands.h"
#include "cli/one_motion.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/warnings.h"
#include "view/answer_json.h"

#include <cstdio>
#include <memory>

namespace chasles::cli {
namespace {

struct CheckOptions {
    OneMotionOptions question;
    std::string certificate;
    bool json = false;
};

/// What a certificate does not prove goes to standard error, and into the JSON object. Returns whether it was made in
/// time.
bool write_certificate(const OneMotion& question, const std::string& name, view::Json& answer) {
    OutputFile file(name);
    Certificate certificate;
    try {
        certificate = certify({question.bodies.moving, question.bodies.fixed, question.motion, question.options});
    } catch (const Cancelled&) {
        std::fputs(("chasles: " + name + ": not written: the time of --seconds was over\n").c_str(), stderr);
        answer["certificate"] = {{"file", nullptr}, {"missing", "the time of --seconds was over"}};
        return false;
    }
    file.write(certificate.text);
    file.close();
    if (!certificate.missing.empty())
        std::fputs(("chasles: " + name + ": incomplete: " + certificate.missing + "\n").c_str(), stderr);
    answer["certificate"] = {{"file", name}, {"planes", certificate.planes}, {"missing", certificate.missing}};
    return true;
}

int run_check(const CheckOptions& options) {
    const OneMotion question = read_one_motion(options.question);
    const Limit limit(question.seconds); // of the answer and its certificate
    const FirstContact found = first_contact(question);
    view::Json answer = view::answer_json(found, question.numbers);
    const bool is_in_time = options.certificate.empty() || write_certificate(question, options.certificate, answer);
    add_warnings(answer, question.bodies.warnings);
    if (options.json)
        print(answer.dump() + "\n");
    else
        print(report(found, question.numbers, question.options, {question.bodies.moving, question.bodies.fixed}));
    return is_in_time ? status_of(found.verdict) : is_unknown;
}

} // namespace

void add_check(CLI::App& app, Task& task) {
    const auto options = std::make_shared<CheckOptions>();
    CLI::App& command =
        *app.add_subcommand("check", "When do two bodies first touch during a motion between two poses?");
    add_one_motion_options(command, options->question);
    command.add_option("--certificate", options->certificate, "write a proof of the answer, for chasles verify")
        ->type_name("FILE.cert");
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_check(*options); }; });
}

} // namespace chasles::cli
