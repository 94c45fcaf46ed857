// chasles check: one motion between two poses.
#include "chasles/base/limit.h"
#include "cli/certificate_file.h"
#include "cli/commands.h"
#include "cli/one_motion.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/warnings.h"
#include "view/answer_json.h"

#include <memory>

namespace chasles::cli {
namespace {

struct CheckOptions {
    OneMotionOptions question;
    CertificateOptions certificate;
    bool json = false;
};

int run_check(const CheckOptions& options) {
    const OneMotion question = read_one_motion(options.question);
    CertificateFile certificate(options.certificate);
    const Limit limit(question.seconds); // of the answer and its certificate
    const FirstContact found = first_contact(question);
    view::Json answer = view::answer_json(found, question.numbers);
    const auto prove = [&] {
        return certify(
            FirstContactQuery{question.bodies.moving, question.bodies.fixed, question.motion, question.options});
    };
    const bool is_in_time = certificate.write(prove, answer);
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
    add_certificate_options(command, options->certificate);
    command.add_flag("--json", options->json, "print one JSON object");
    command.callback([options, &task] { task = [options] { return run_check(*options); }; });
}

} // namespace chasles::cli
