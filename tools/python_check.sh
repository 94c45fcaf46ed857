#!/bin/sh
# Installs the Python package with pip into a virtual environment made anew, and runs its tests there.
#
#   python_check.sh [BUILD]    with BUILD, links to the library that is built there instead of building another one
set -eu
cd "$(dirname "$0")/.."

environment=$PWD/build/python/venv
rm -rf "$environment"
python3 -m venv "$environment"

set -- ${1:+"$1"}
if [ $# -eq 1 ]; then
    prefix=$PWD/build/python/prefix
    cmake --install "$1" --prefix "$prefix" >/dev/null
    set -- --config-settings=cmake.define.CHASLES_PYTHON_OF_INSTALLED=ON --config-settings=cmake.define.chasles_ROOT="$prefix" \
        --config-settings=build-dir=build/python/check
fi
"$environment/bin/python" -m pip install --quiet --disable-pip-version-check "$@" ".[test]"
cd tests/python # away from python/chasles, so that what is tested is what was installed
"$environment/bin/python" -m pytest -q -p no:cacheprovider
