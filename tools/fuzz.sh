#!/bin/sh
# fuzz.sh [SECONDS [JOBS]]: builds the fuzzers and runs each one for SECONDS (default 60; 0: until stopped), JOBS at a
# time (default: one per core). Inputs that break a promise are kept in build/fuzz/tests/fuzz/<name>/.
set -eu
cd "$(dirname "$0")/.."

compiler=clang++-$(cat tools/clang-tools-version)
target='extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }'
if ! echo "$target" | "$compiler" -x c++ -fsanitize=fuzzer,address,undefined -o /dev/null - 2>/dev/null; then
    echo "skipped: no $compiler with libFuzzer (tools/install_dependencies.sh fuzz installs it); nothing was fuzzed"
    exit 0
fi
jobs=${2:-$(nproc)}
cmake --preset fuzz -DCHASLES_FUZZ_SECONDS="${1:-60}"
cmake --build --preset fuzz -j "$jobs"
ctest --preset fuzz -j "$jobs"
