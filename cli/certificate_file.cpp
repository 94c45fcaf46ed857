#include "cli/certificate_file.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "scenes/triangle_mesh.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

namespace chasles::cli {

namespace {

void write_bodies(const std::string& folder, const std::vector<Polyhedron>& bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        OutputFile file((std::filesystem::path(folder) / fmt::format("body-{}.obj", i)).string());
        file.write(scenes::obj_text(bodies[i]));
        file.close();
    }
}

} // namespace

CLI::Option* add_certificate_options(CLI::App& command, CertificateOptions& options) {
    auto* const certificate =
        command.add_option("--certificate", options.file, "write a proof of the answer, for chasles verify")
            ->type_name("FILE.cert");
    command
        .add_option("--bodies", options.bodies,
                    "write the bodies of the certificate into this folder, as OBJ files, for chasles verify")
        ->needs(certificate)
        ->type_name("FOLDER");
    return certificate;
}

void require_folder(const std::string& name) {
    std::error_code unreadable;
    if (!name.empty() && !std::filesystem::is_directory(name, unreadable))
        throw InvalidInput(name + ": is no folder");
}

CertificateFile::CertificateFile(const CertificateOptions& options) : options_(options) {
    if (options.file.empty())
        return;
    file_.emplace(options.file);
    require_folder(options.bodies);
}

bool CertificateFile::write(const std::function<Certificate()>& prove, view::Json& answer) {
    if (!file_)
        return true;
    const std::string& name = options_.file;
    Certificate certificate;
    try {
        certificate = prove();
    } catch (const Cancelled&) {
        std::fputs(("chasles: " + name + ": not written: the time of --seconds was over\n").c_str(), stderr);
        answer["certificate"] = {{"file", nullptr}, {"missing", "the time of --seconds was over"}};
        return false;
    }
    if (!options_.bodies.empty())
        write_bodies(options_.bodies, certificate.bodies);
    file_->write(certificate.text);
    file_->close();
    if (!certificate.missing.empty())
        std::fputs(("chasles: " + name + ": incomplete: " + certificate.missing + "\n").c_str(), stderr);
    answer["certificate"] = {{"file", name}, {"planes", certificate.planes}, {"missing", certificate.missing}};
    return true;
}

} // namespace chasles::cli
