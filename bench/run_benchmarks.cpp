#include "bench/run_benchmarks.h"

#include <filesystem>
#include <string>
#include <vector>

namespace chasles::bench {

int run_benchmarks(int argc, char** argv, benchmark::BenchmarkReporter* reporter) {
    const std::filesystem::path results = CHASLES_BENCH_RESULTS;
    std::error_code ignored; // without the folder, Google Benchmark prints the error
    std::filesystem::create_directories(results, ignored);
    const std::string name = std::filesystem::path(argv[0]).filename().string();
    std::vector<std::string> defaults{"--benchmark_out=" + (results / (name + ".json")).string(),
                                      "--benchmark_out_format=json",
                                      "--benchmark_repetitions=15",
                                      "--benchmark_min_time=0.02",
                                      "--benchmark_enable_random_interleaving=true",
                                      "--benchmark_display_aggregates_only=true"};
    std::vector<char*> arguments{argv[0]};
    for (std::string& text : defaults)
        arguments.push_back(text.data());
    arguments.insert(arguments.end(), argv + 1, argv + argc);
    int count = static_cast<int>(arguments.size());
    arguments.push_back(nullptr);
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data()))
        return 1;
    benchmark::RunSpecifiedBenchmarks(reporter);
    return 0;
}

} // namespace chasles::bench
