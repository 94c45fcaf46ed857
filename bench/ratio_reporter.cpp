#include "bench/ratio_reporter.h"

#include <algorithm>
#include <cstdio>

namespace chasles::bench {

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
    for (const Run& run : runs) {
        const auto rate = run.counters.find("items_per_second");
        const std::string name = run.run_name.function_name;
        const std::size_t slash = name.rfind('/');
        if (run.aggregate_name != "median" || rate == run.counters.end() || slash == std::string::npos)
            continue;
        const std::string family = name.substr(0, slash);
        if (of_[family].empty())
            families_.push_back(family);
        of_[family].emplace_back(name.substr(slash + 1), 1e9 / rate->second);
    }
}

void RatioReporter::Finalize() {
    std::printf("%-18s %-10s %9s %9s\n", "kernel", "form", "ns a pair", "ratio");
    for (const std::string& family : families_) {
        const auto& forms = of_[family];
        const auto reference =
            std::find_if(forms.begin(), forms.end(), [&](const auto& form) { return form.first == reference_; });
        for (const auto& [form, nanoseconds] : forms) {
            const double ratio = reference == forms.end() ? 0 : nanoseconds / reference->second;
            std::printf("%-18s %-10s %9.2f %9.2f\n", family.c_str(), form.c_str(), nanoseconds, ratio);
        }
    }
}

} // namespace chasles::bench
