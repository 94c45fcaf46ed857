#include "cli/certificate_file.h"

#include "chasles/base/limit.h"
#include "cli/output.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

namespace chasles::cli {

namespace {

/// Numbers are written so that they are read as the same ones.
std::string obj_text(const Polyhedron& body) {
    std::string text;
    for (const Eigen::Vector3d& vertex : body.vertices())
        text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", vertex.x(), vertex.y(), vertex.z());
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        text += "f";
        for (const std::uint32_t vertex : body.face(face))
            text += fmt::format(" {}", vertex + 1);
        text += "\n";
    }
    return text;
}

void write_bodies(const std::string& folder, const std::vector<Polyhedron>& bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        OutputFile file((std::filesystem::path(folder) / fmt::format("body-{}.obj", i)).string());
        file.write(obj_text(bodies[i]));
        file.close();
    }
}

} // namespace

CLI::Option* add_certificate_option(CLI::App& command, CertificateOptions& options) {
    return command.add_option("--certificate", options.file, "write a proof of the answer, for chasles verify")
        ->type_name("FILE.cert");
}

void add_bodies_option(CLI::App& command, CertificateOptions& options, CLI::Option* certificate) {
    command
        .add_option("--bodies", options.bodies,
                    "write the bodies of the certificate into this folder, each different one as an OBJ file, for "
                    "chasles verify")
        ->needs(certificate)
        ->type_name("FOLDER");
}

bool write_certificate(const CertificateOptions& options, const std::function<Certificate()>& prove,
                       view::Json& answer) {
    if (options.file.empty())
        return true;
    OutputFile file(options.file);
    Certificate certificate;
    try {
        certificate = prove();
    } catch (const Cancelled&) {
        std::fputs(("chasles: " + options.file + ": not written: the time of --seconds was over\n").c_str(), stderr);
        answer["certificate"] = {{"file", nullptr}, {"missing", "the time of --seconds was over"}};
        return false;
    }
    file.write(certificate.text);
    file.close();
    if (!options.bodies.empty())
        write_bodies(options.bodies, certificate.bodies);
    if (!certificate.missing.empty())
        std::fputs(("chasles: " + options.file + ": incomplete: " + certificate.missing + "\n").c_str(), stderr);
    answer["certificate"] = {{"file", options.file}, {"planes", certificate.planes}, {"missing", certificate.missing}};
    return true;
}

} // namespace chasles::cli
