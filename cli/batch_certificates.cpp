#include "cli/batch_certificates.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/certificate/certificate.h"
#include "cli/certificate_file.h"
#include "cli/output.h"
#include "cli/report.h"

#include <filesystem>
#include <fmt/format.h>

namespace chasles::cli {

BatchCertificates::BatchCertificates(std::string folder) : folder_(std::move(folder)) {
    require_folder(folder_);
}

bool BatchCertificates::write(const BatchQuery& query, std::span<const std::size_t> rows) {
    if (folder_.empty())
        return true;
    const std::vector<Certificate> proofs = certify_batch(query);
    if (is_cancelled())
        return false;
    for (std::size_t i = 0; i < proofs.size(); ++i) {
        if (!proofs[i].missing.empty() && missing_++ == 0)
            first_missing_ = fmt::format("row {}: {}", rows[i], proofs[i].missing);
        if (!proofs[i].missing.empty())
            continue;
        OutputFile file((std::filesystem::path(folder_) / fmt::format("{}.cert", rows[i])).string());
        file.write(proofs[i].text);
        file.close();
    }
    return true;
}

std::string BatchCertificates::missing() const {
    return missing_ == 0
               ? ""
               : fmt::format("{}: {} without a certificate; {}", folder_, counted(missing_, "row"), first_missing_);
}

} // namespace chasles::cli
