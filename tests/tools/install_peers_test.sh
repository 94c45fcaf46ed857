#!/bin/sh
# bench/registry/install.sh with simulated Python and Rust: if a peer cannot be installed, the script prints the reason in
# one line and succeeds.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
set -- cat cmp cp cut dirname grep mkdir rm tail
. "$here/pretended.sh"

run() {
    run_pretended "$here/../../bench/registry/install.sh" "$folder/peers"
}

reason() {
    cat "$folder/peers/$1-is-absent.txt" 2>/dev/null || echo none
}

pretend python3 'echo "no module named venv"; exit 1'
run
expect "neither Python's environments nor Rust: both say why" \
    '[ $status -eq 0 ] && [ "$(reason python)" = "no module named venv" ] && [ "$(reason parry)" = "no cargo" ]'

# An environment is a folder with an interpreter. Here the interpreter is a command that simulates pip.
pretend python3 "mkdir -p \$3/bin; cp $folder/bin/pip \$3/bin/python"
pretend pip 'echo "collecting"; echo "ERROR: no such version"; exit 1'
pretend cargo ''
run
expect "what pip says last is the reason" \
    '[ $status -eq 0 ] && [ "$(reason python)" = "ERROR: no such version" ] && [ "$(reason parry)" = none ]'

pretend pip ''
run
expect "everything brought: no reasons, no output" \
    '[ $status -eq 0 ] && [ "$(reason python)$(reason parry)" = nonenone ] && [ -z "$output" ]'

run
expect "an environment of these versions is left alone" '! grep -q -e python3 -e pip "$folder/log"'

echo "every case as expected"
