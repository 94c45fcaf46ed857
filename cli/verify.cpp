// chasles verify: does a certificate prove what it claims?
#include "tools/verify.h"
#include "chasles/base/invalid_input.h"
#include "cli/commands.h"
#include "cli/output.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

namespace chasles::cli {
namespace {

struct VerifyOptions {
    std::vector<std::string> files; ///< meshes, then the certificate
};

::certificate::Mesh mesh_of(const std::string& file) {
    try {
        return ::certificate::read_mesh(file);
    } catch (const std::runtime_error& error) {
        throw InvalidInput(error.what());
    }
}

int run_verify(const VerifyOptions& options) {
    const std::string end = std::filesystem::path(options.files.back()).extension().string();
    if (end == ".obj" || end == ".stl")
        throw InvalidInput(options.files.back() + ": is a mesh; the certificate comes last");
    std::vector<::certificate::Mesh> meshes;
    for (std::size_t i = 0; i + 1 < options.files.size(); ++i)
        meshes.push_back(mesh_of(options.files[i]));
    std::ifstream stream(options.files.back(), std::ios::binary);
    if (!stream)
        throw InvalidInput(options.files.back() + ": cannot be read");
    const ::certificate::Verified verified = ::certificate::verify(meshes, stream);
    print(verified.message + "\n");
    return verified.holds ? is_clear : is_contact;
}

} // namespace

void add_verify(CLI::App& app, Task& task) {
    const auto options = std::make_shared<VerifyOptions>();
    CLI::App& command = *app.add_subcommand("verify", "Does a certificate prove what it claims?");
    command.footer(
        "Exit status: 0 verified, 1 not verified, 2 usage or a file that cannot be read. Meshes are OBJ or STL files.");
    command
        .add_option("FILES", options->files,
                    "meshes of the moving and of the fixed body (of a scene or robot each different one once), then "
                    "what --certificate wrote")
        ->required()
        ->expected(2, -1)
        ->type_name("MESH.. CERTIFICATE");
    command.callback([options, &task] { task = [options] { return run_verify(*options); }; });
}

} // namespace chasles::cli
