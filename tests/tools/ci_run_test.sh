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

pretend make 'case $1 in
    check) echo "100% tests passed, 0 tests failed out of 20"; echo "=== 7 passed, 2 skipped in 1.50s ==="
           echo "100% tests passed, 0 tests failed out of 4" ;;
    asan-core) echo "100% tests passed, 0 tests failed out of 100" ;;
esac'
run
expect "the summaries of ctest and pytest are added up, and steps without tests" \
    '[ $status -eq 0 ] && [ "$last" = "134 passed, 0 failed" ]'

run 3010
expect "after 50 minutes no step is begun" \
    '[ $status -eq 0 ] && [ "$last" = "31 passed, 0 failed" ] && [ "$(cat "$folder/log")" = "make check" ]'

pretend make 'case $1 in
    check) echo "90% tests passed, 2 tests failed out of 20"; exit 2 ;;
    clang) echo "error: unused variable"; exit 2 ;;
esac'
run
expect "failed tests and failed steps are counted, and the rest is run all the same" \
    '[ $status -ne 0 ] && [ "$last" = "21 passed, 3 failed" ]'

pretend timeout 'exit 124'
pretend make 'echo "100% tests passed, 0 tests failed out of 20"'
run
expect "a step that is stopped is skipped, not failed" \
    '[ $status -eq 0 ] && [ "$last" = "20 passed, 0 failed" ] && case $output in *"asan-core was stopped"*) ;; *) false ;; esac'

echo "every case as expected"
