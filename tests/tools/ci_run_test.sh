#!/bin/sh
# .ci/run where make is pretended: what it adds up, and what it skips when time runs out.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
set -- awk bash cat dirname mktemp rm tee timeout
. "$here/pretended.sh"

# run [SECONDS]: as if it had begun so many seconds ago.
run() {
    : >"$folder/log"
    status=0
    output=$(PATH="$folder/bin" SECONDS=${1:-0} bash "$here/../../.ci/run" 2>&1) || status=$?
    last=$(printf '%s\n' "$output" | tail -n 1)
}

builds='-s) echo wasm-check asan-core tidy-core ;;'
pretend make "case \$1 in
    $builds"'
    check) echo "100% tests passed, 0 tests failed out of 20"; echo "=== 7 passed, 2 skipped in 1.50s ==="
           echo "100% tests passed, 0 tests failed out of 4" ;;
    asan-core) echo "100% tests passed, 0 tests failed out of 100" ;;
esac'
run
expect "the summaries of ctest and pytest are added up, and steps without tests" \
    '[ $status -eq 0 ] && [ "$last" = "133 passed, 0 failed" ]'

run 3010
expect "after 50 minutes no step is begun" \
    '[ $status -eq 0 ] && [ "$last" = "31 passed, 0 failed" ] && ! grep -q "asan-core" "$folder/log"'

pretend make "case \$1 in
    $builds"'
    check) echo "90% tests passed, 2 tests failed out of 20"; exit 2 ;;
    asan-core) echo "error: unused variable"; exit 2 ;;
esac'
run
expect "failed tests and failed steps are counted, and the rest is run all the same" \
    '[ $status -ne 0 ] && [ "$last" = "20 passed, 3 failed" ]'

pretend timeout 'exit 124'
pretend make "case \$1 in
    $builds
    *) echo '100% tests passed, 0 tests failed out of 20' ;;
esac"
run
expect "a step that is stopped is skipped, not failed" \
    '[ $status -eq 0 ] && [ "$last" = "20 passed, 0 failed" ] && case $output in *"asan-core was stopped"*) ;; *) false ;; esac'

echo "every case as expected"
