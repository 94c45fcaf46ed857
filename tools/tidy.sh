#!/bin/sh
# Runs clang-tidy with the settings of .clang-tidy on the sources of the build in BUILD (default build/dev).
# Further arguments are patterns of file names: tools/tidy.sh build/dev chasles/mesh
set -eu
cd "$(dirname "$0")/.."

version=$(cat tools/clang-tools-version)
build=${1:-build/dev}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- "$PWD/(chasles|cli|scenes|view)/"
"run-clang-tidy-$version" -clang-tidy-binary "clang-tidy-$version" -quiet -p "$build" "$@"
