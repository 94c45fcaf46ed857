#!/bin/sh
# Installs the peers that have no Debian package into a folder: a virtual environment with requirements.txt, and the
# program that runs Parry. If a peer cannot be installed, FOLDER/<which>-is-absent.txt has the reason, and the script goes
# on. Peers that are installed already stay unchanged.
#
#   install.sh FOLDER
set -eu

here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)

# attempt NAME COMMAND: writes the command's output to a log. If the command fails, the log's last line is the reason.
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

# --locked: uses exactly the versions of Cargo.lock.
parry() {
    command -v cargo >/dev/null || { echo "no cargo"; return 1; }
    cargo build --quiet --release --locked --manifest-path "$here/parry/Cargo.toml" --target-dir "$folder/parry"
}

attempt python python
attempt parry parry
