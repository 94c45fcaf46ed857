// The files of chasles batch --certificates.
#pragma once

#include "chasles/query/batch.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace chasles::cli {

/// A certificate for each row, as FOLDER/ROW.cert; rows are counted from 1.
class BatchCertificates {
public:
    /// None if the name is empty. Throws InvalidInput if there is no such folder.
    explicit BatchCertificates(std::string folder);

    /// Writes those of some rows. False if the time was over before all were proven: then none is written.
    bool write(const BatchQuery& query, std::span<const std::size_t> rows);
    /// What is missing, in one line; empty if nothing is.
    [[nodiscard]] std::string missing() const;

private:
    std::string folder_;
    std::size_t missing_ = 0;
    std::string first_missing_;
};

} // namespace chasles::cli
