#include "cli/certificate_file.h"

#include "chasles/base/limit.h"
#include "chasles/certificate/certificate.h"
#include "cli/output.h"

#include <cstdio>

namespace chasles::cli {

void add_certificate_option(CLI::App& command, std::string& name) {
    command.add_option("--certificate", name, "write a proof of the answer, for chasles verify")
        ->type_name("FILE.cert");
}

bool write_certificate(const PathQuery& question, const std::string& name, view::Json& answer) {
    OutputFile file(name);
    Certificate certificate;
    try {
        certificate = certify(question);
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

} // namespace chasles::cli
