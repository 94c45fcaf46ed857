// Google Benchmark with the defaults of this folder; the command line is its own and comes last, so that it decides.
#pragma once

#include <benchmark/benchmark.h>

namespace chasles::bench {

/// Runs what is registered, in repetitions that take turns, and reports mean, median and deviation of each. Results go
/// to `reporter`, or to the console. Answers the exit status.
int run_benchmarks(int argc, char** argv, benchmark::BenchmarkReporter* reporter = nullptr);

} // namespace chasles::bench
