#!/bin/sh
# Brings the peers that Debian does not have into a folder: a virtual environment with requirements.txt, and the
# program that asks Parry. What cannot be brought is said in FOLDER/<which>-is-absent.txt and is no failure; what is
# there already is left alone.
#
#   install.sh FOLDER
set -eu

here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)

# attempt NAME COMMAND: the command's own output goes to a log, its last line is the reason if it fails.
attempt() {
    log=$folder/$1.log
    reason=$folder/$1-is-absent.txt
    rm -f "$reason"
    if ! "$2" >"$log" 2>&1; then
        grep -v '^ *$' "$log" | tail -n 1 | cut -c 1-100 >"$reason"
        echo "chasles: peers of $1 are absent: $(cat "$reason") (see $log)" >&2
    fi
}

python() {
    cmp -s "$here/requirements.txt" "$folder/venv/requirements.txt" && return 0
    python3 -m venv "$folder/venv" || return 1
    "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check --only-binary :all: \
        -r "$here/requirements.txt" || return 1
    cp "$here/requirements.txt" "$folder/venv/"
}

# --locked: the versions of Cargo.lock and no others.
parry() {
    command -v cargo >/dev/null || { echo "no cargo"; return 1; }
    cargo build --quiet --release --locked --manifest-path "$here/parry/Cargo.toml" --target-dir "$folder/parry"
}

attempt python python
attempt parry parry
