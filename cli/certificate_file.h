// The files of --certificate and --bodies.
#pragma once

#include "chasles/certificate/certificate.h"
#include "cli/output.h"
#include "view/answer_json.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

namespace chasles::cli {

struct CertificateOptions {
    std::string file;   ///< empty: none
    std::string bodies; ///< folder for the bodies; empty: none
};

/// --certificate and --bodies. Returns the first one.
CLI::Option* add_certificate_options(CLI::App& command, CertificateOptions& options);

/// Throws InvalidInput "NAME: is no folder" unless it is one. An empty name is none that is asked for.
void require_folder(const std::string& name);

/// The proof, if one is asked for. To be made after all reading and before the question is answered.
class CertificateFile {
public:
    /// Throws InvalidInput for a file that cannot be written, and for a folder that is none.
    explicit CertificateFile(const CertificateOptions& options);

    /// What it does not prove goes to standard error, and into the JSON object. Returns whether it was made in time.
    bool write(const std::function<Certificate()>& prove, view::Json& answer);

private:
    const CertificateOptions& options_;
    std::optional<OutputFile> file_;
};

} // namespace chasles::cli
