#!/bin/sh
# bench/registry/install.sh where Python and Rust are pretended: what cannot be brought is a line of reason, no failure.
set -eu

script=$(cd "$(dirname "$0")/../.." && pwd)/bench/registry/install.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
for tool in cat cmp cp cut dirname grep mkdir rm tail; do
    ln -s "$(command -v "$tool")" "$folder/bin/$tool"
done

# pretend NAME BODY: a command that writes its call to the log and then does BODY.
pretend() {
    printf '#!/bin/sh\necho "%s $*" >>"%s/log"\n%s\n' "$1" "$folder" "$2" >"$folder/bin/$1"
    chmod +x "$folder/bin/$1"
}

run() {
    : >"$folder/log"
    status=0
    PATH="$folder/bin" /bin/sh "$script" "$folder/peers" >"$folder/output" 2>&1 || status=$?
}

reason() {
    cat "$folder/peers/$1-is-absent.txt" 2>/dev/null || echo none
}

expect() {
    if ! eval "$2"; then
        printf '%s\n' "FAILED: $1" "status: $status" "output: $(cat "$folder/output")" "log: $(cat "$folder/log")"
        exit 1
    fi
}

pretend python3 'echo "no module named venv"; exit 1'
run
expect "neither Python's environments nor Rust: both say why" \
    '[ $status -eq 0 ] && [ "$(reason python)" = "no module named venv" ] && [ "$(reason parry)" = "no cargo" ]'

# An environment is a folder with an interpreter, which here is a command that answers for pip.
pretend python3 "mkdir -p \$3/bin; cp $folder/bin/pip \$3/bin/python"
pretend pip 'echo "collecting"; echo "ERROR: no such version"; exit 1'
pretend cargo ''
run
expect "what pip says last is the reason" \
    '[ $status -eq 0 ] && [ "$(reason python)" = "ERROR: no such version" ] && [ "$(reason parry)" = none ]'

pretend pip ''
run
expect "everything brought: no reasons, no output" \
    '[ $status -eq 0 ] && [ "$(reason python)$(reason parry)" = nonenone ] && [ ! -s "$folder/output" ]'

run
expect "an environment of these versions is left alone" '! grep -q -e python3 -e pip "$folder/log"'

echo "every case as expected"
