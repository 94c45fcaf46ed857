// chasles verify: does a certificate prove what it claims?
#include "tools/verify.h"
#include "chasles/base/invalid_input.h"
#include "cli/commands.h"
#include "cli/output.h"

#include <fstream>
#include <memory>
#include <stdexcept>

namespace chasles::cli {
namespace {

struct VerifyOptions {
    std::string moving, fixed, certificate;
};

::certificate::Mesh mesh_of(const std::string& file) {
    try {
        return ::certificate::read_mesh(file);
    } catch (const std::runtime_error& error) {
        throw InvalidInput(error.what());
    }
}

int run_verify(const VerifyOptions& options) {
    const ::certificate::Mesh moving = mesh_of(options.moving), fixed = mesh_of(options.fixed);
    std::ifstream stream(options.certificate, std::ios::binary);
    if (!stream)
        throw InvalidInput(options.certificate + ": cannot be read");
    const ::certificate::Verified verified = ::certificate::verify(moving, fixed, stream);
    print(verified.message + "\n");
    return verified.holds ? is_clear : is_contact;
}

} // namespace

void add_verify(CLI::App& app, Task& task) {
    const auto options = std::make_shared<VerifyOptions>();
    CLI::App& command = *app.add_subcommand("verify", "Does a certificate prove what it claims?");
    command.footer(
        "Exit status: 0 verified, 1 not verified, 2 usage or a file that cannot be read. Meshes are OBJ or STL files.");
    command.add_option("MOVING", options->moving, "mesh of the moving body")->required();
    command.add_option("FIXED", options->fixed, "mesh of the fixed body")->required();
    command.add_option("CERTIFICATE", options->certificate, "what --certificate wrote")->required();
    command.callback([options, &task] { task = [options] { return run_verify(*options); }; });
}

} // namespace chasles::cli
