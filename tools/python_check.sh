#!/bin/sh
# Installs the Python package with pip into a new virtual environment, and runs its tests there.
#
#   python_check.sh [BUILD]    with BUILD: links to the library in this build folder instead of building the library again
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
"$environment/bin/python" -m pip install --quiet --disable-pip-version-check "$@" ".[test,oracles]"
cd tests/python # outside python/chasles, so that the tests import the installed package
"$environment/bin/python" -m pytest -q -p no:cacheprovider -n auto --dist loadfile . ../verify
