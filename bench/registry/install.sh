#!/bin/sh
# Installs the peers that have no Debian package into a folder: a virtual environment with requirements.txt, robots.txt and
# this project's own package, the program that runs Parry, and VAMP's Panda as a library. If a peer cannot be installed,
# FOLDER/<which>-is-absent.txt has the reason, and the script goes on. Peers that are installed already stay unchanged.
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

robots() {
    [ -x "$folder/venv/bin/python" ] || { echo "no virtual environment"; return 1; }
    cmp -s "$here/robots.txt" "$folder/venv/robots.txt" && return 0
    "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check --only-binary :all: \
        -r "$here/requirements.txt" -r "$here/robots.txt" || return 1
    cp "$here/robots.txt" "$folder/venv/"
}

# The project as it is now: the build folder of the package makes a second build short.
chasles() {
    "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check --force-reinstall --no-deps "$here/../.."
}

# The source package's own build downloads nigh, pdqsort and SIMDxorshift, which no registry has. The folder vamp/ has what
# VAMP's headers use of the first two; the third is for a random generator that is not used. Options as in VAMP's build.
vamp() {
    [ -f "$folder/libvamp_panda.so" ] && [ "$folder/libvamp_panda.so" -nt "$here/vamp/vamp_panda.cpp" ] && return 0
    "$folder/venv/bin/python" -m pip download --quiet --disable-pip-version-check --no-deps --no-binary vamp-planner \
        --dest "$folder" vamp-planner==0.6.4 || return 1
    tar -xzf "$folder/vamp_planner-0.6.4.tar.gz" -C "$folder" vamp_planner-0.6.4/src/impl \
        vamp_planner-0.6.4/resources/panda/panda_spherized.urdf || return 1
    g++ -std=c++17 -O3 -march=native -mavx2 -fno-math-errno -fno-signed-zeros -fno-trapping-math -fno-rounding-math \
        -ffp-contract=fast -fassociative-math -w -shared -fPIC -I "$here/vamp" -I "$folder/vamp_planner-0.6.4/src/impl" \
        -isystem /usr/include/eigen3 "$here/vamp/vamp_panda.cpp" -o "$folder/libvamp_panda.so"
}

attempt python python
attempt parry parry
attempt robots robots
attempt chasles chasles
attempt vamp vamp
