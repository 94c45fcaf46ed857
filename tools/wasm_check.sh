#!/bin/sh
# Packs the npm package, installs it into an empty project, and runs its tests there.
#
#   wasm_check.sh PACKAGE [NATIVE_ANSWERS]    PACKAGE: the folder that the preset `wasm` assembles; beside it lies page/, which
#                                             holds the packages of the viewer, with esbuild
#
# NATIVE_ANSWERS is the program of that name: without it, the comparison with the native library is skipped. So are the known
# answers without CHASLES_DATA_DIR, which is ../shared/data or shared/data where that is there.
set -eu
package=$(cd "$1" && pwd)
bundler=$package/../page
native=${2:+$(cd "$(dirname "$2")" && pwd)/$(basename "$2")}
cd "$(dirname "$0")/.."
tests=$PWD/tests/javascript

for candidate in shared/data ../shared/data ../../shared/data; do
    [ -n "${CHASLES_DATA_DIR:-}" ] || [ ! -e "$candidate/README.md" ] || CHASLES_DATA_DIR=$(cd "$candidate" && pwd)
done

project=$package/../project
mkdir -p "$project"
find "$project" -mindepth 1 -maxdepth 1 ! -name node_modules -exec rm -rf {} +
cp -R tests/javascript/. docs/guide/javascript.md "$project"
(cd "$package" && npm pack --silent --pack-destination "$project" >/dev/null)
cd "$project"
npm ci --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error
npm install --no-save --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error ./chasles-*.tgz

node node_modules/typescript/bin/tsc
export CHASLES_NATIVE_ANSWERS="${native:-}" CHASLES_DATA_DIR="${CHASLES_DATA_DIR:-}"
node --expose-gc --test --test-reporter=spec \
    package.test.mjs arguments.test.mjs three.test.mjs workers.test.mjs hands.test.mjs scenes.test.mjs inside.test.mjs bodies.test.mjs radius.test.mjs large.test.mjs types.test.mjs native.test.mjs readme.test.mjs

chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
for test in "browser_test.py . $bundler" "vite_test.py ."; do
    status=0
    # shellcheck disable=SC2086  # the arguments are separate words
    python3 "$tests"/$test "$chromium" || status=$?
    [ "$status" -eq 0 ] || [ "$status" -eq 77 ] || exit "$status"
done
