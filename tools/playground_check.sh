#!/bin/sh
# Tests the playground: its types, and the page in a headless Chromium.
#
#   playground_check.sh WORK PAGE [CHASLES]    WORK: where the page was bundled, with its npm packages
#
# CHASLES is the native program, which replays and proves what was recorded: without it, this is skipped. Without a browser, only
# the types are checked.
set -eu
work=$1 page=$2 chasles=${3:-}
here=$(cd "$(dirname "$0")/.." && pwd)
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)

node "$work/node_modules/typescript/bin/tsc" -p "$work/playground"
for test in drag arm files radius frames; do
    status=0
    python3 "$here/tests/playground/${test}_test.py" "$page" "$chromium" "$chasles" || status=$?
    [ "$status" -eq 0 ] || [ "$status" -eq 77 ] || exit "$status"
done
