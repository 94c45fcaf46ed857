# Sourced by tests of scripts. Makes a temporary folder whose bin/ is the whole PATH of the script under test.
#
# The positional parameters are the tools that are real.

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
for tool in "$@"; do
    ln -s "$(command -v "$tool")" "$folder/bin/$tool"
done

# pretend NAME BODY: makes a command that writes its call to the log and then runs BODY. The name may be one of the real
# tools: removing its link first keeps the system's own file from being overwritten.
pretend() {
    rm -f "$folder/bin/$1"
    printf '#!/bin/sh\necho "%s $*" >>"%s/log"\n%s\n' "$1" "$folder" "$2" >"$folder/bin/$1"
    chmod +x "$folder/bin/$1"
}

# run SCRIPT ARGUMENTS: sets output and status, and writes the log.
run_pretended() {
    : >"$folder/log"
    status=0
    output=$(PATH="$folder/bin" /bin/sh "$@" 2>&1) || status=$?
}

# expect WHAT CONDITION
expect() {
    if ! eval "$2"; then
        printf '%s\n' "FAILED: $1" "status: $status" "output: $output" "log: $(cat "$folder/log")"
        exit 1
    fi
}
