#!/bin/sh
# bench/registry/install.sh with simulated Python and Rust: if a peer cannot be installed, the script prints the reason in
# one line and succeeds.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
set -- cat cmp cp cut dirname grep mkdir rm tail touch
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
expect "no tar: VAMP's source stays packed, and all else is brought" \
    '[ $status -eq 0 ] && [ "$(reason python)$(reason parry)$(reason robots)$(reason chasles)" = nonenonenonenone ] &&
    reason vamp | grep -q "tar: not found"'

pretend tar ''
pretend g++ "touch $folder/peers/libvamp_panda.so"
run
expect "everything brought: no reasons, no output" \
    '[ $status -eq 0 ] && [ "$(reason vamp)" = none ] && [ -z "$output" ]'

run
expect "what is there is left alone, but for the project itself" \
    '! grep -q -e python3 -e "requirements.txt" -e "robots.txt" -e "^tar" -e "^g++" "$folder/log" &&
    [ "$(grep -c "^pip" "$folder/log")" = 1 ]'

echo "every case as expected"
