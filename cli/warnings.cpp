#include "cli/warnings.h"

#include "chasles/io/text_scan.h"

#include <cstdio>

namespace chasles::cli {

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings)
        std::fputs(("chasles: warning: " + io::one_line(warning) + "\n").c_str(), stderr);
}

void add_warnings(nlohmann::ordered_json& answer, const std::vector<std::string>& warnings) {
    if (!warnings.empty())
        answer["warnings"] = warnings;
}

} // namespace chasles::cli
