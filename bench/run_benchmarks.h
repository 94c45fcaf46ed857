// Google Benchmark with the defaults of this folder. Options of the command line come last and override the defaults.
#pragma once

#include <benchmark/benchmark.h>

namespace chasles::bench {

/// Runs the registered benchmarks in interleaved repetitions, and reports mean, median and deviation of each. Results
/// go to `reporter`, or to the console. Returns the exit status.
int run_benchmarks(int argc, char** argv, benchmark::BenchmarkReporter* reporter = nullptr);

} // namespace chasles::bench
