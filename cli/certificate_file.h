// The file of --certificate.
#pragma once

#include "chasles/query/path.h"
#include "view/answer_json.h"

#include <CLI/CLI.hpp>
#include <string>

namespace chasles::cli {

void add_certificate_option(CLI::App& command, std::string& name);

/// Proves the answer to the question. What the file does not prove goes to standard error, and into the JSON object.
/// Returns whether it was made in time.
bool write_certificate(const PathQuery& question, const std::string& name, view::Json& answer);

} // namespace chasles::cli
