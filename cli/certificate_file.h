// The files of --certificate and --bodies.
#pragma once

#include "chasles/certificate/certificate.h"
#include "view/answer_json.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace chasles::cli {

struct CertificateOptions {
    std::string file;   ///< empty: none
    std::string bodies; ///< folder for the bodies; empty: none
};

CLI::Option* add_certificate_option(CLI::App& command, CertificateOptions& options);
/// --bodies, for questions whose bodies need not be mesh files.
void add_bodies_option(CLI::App& command, CertificateOptions& options, CLI::Option* certificate);

/// Writes the proof, if one is asked for. What it does not prove goes to standard error, and into the JSON object.
/// Returns whether it was made in time.
bool write_certificate(const CertificateOptions& options, const std::function<Certificate()>& prove,
                       view::Json& answer);

} // namespace chasles::cli
