// Medians of interleaved repetitions, and their ratios to one form. Ratios of one run are more reliable than single
// times on a shared machine.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace chasles::bench {

/// Collects the median nanoseconds per item of benchmarks with names "<family>/<form>".
class RatioReporter : public benchmark::ConsoleReporter {
public:
    explicit RatioReporter(std::string reference) : ConsoleReporter(OO_None), reference_(std::move(reference)) {}

    void ReportRuns(const std::vector<Run>& runs) override;
    void Finalize() override;

private:
    std::string reference_;
    std::vector<std::string> families_;                                     ///< in the order of the benchmarks
    std::map<std::string, std::vector<std::pair<std::string, double>>> of_; ///< family -> form, nanoseconds
};

} // namespace chasles::bench
