#!/bin/sh
# Formats every source file by .clang-format. With --check, only lists the files that would change.
# Exit status 77 means that the pinned clang-format is not installed (ctest reports the test as skipped).
set -eu
cd "$(dirname "$0")/.."

clang_format=clang-format-$(cat tools/clang-tools-version)
if ! command -v "$clang_format" >/dev/null; then
    echo "skipped: $clang_format is not installed (tools/install_dependencies.sh check installs it)"
    exit 77
fi

if [ "${1:-}" = --check ]; then
    set -- --dry-run -Werror
else
    set -- -i
fi
find chasles cli scenes view python examples tests bench \( -name '*.h' -o -name '*.inl' -o -name '*.cpp' \) -print0 |
    xargs -0 -r "$clang_format" "$@"
