#!/bin/sh
# Prints the path of the type stubs of the compiled Python module, which have all signatures and docstrings.
#
#   python_stubs.sh BUILD    BUILD: a build folder with the library, which the module is linked to
#
# `make check` and `make python-check` leave stubs behind. Where there are none, or sources are newer, the module is built.
set -eu
cd "$(dirname "$0")/.."
built=$PWD/build/python/stubs

for stubs in build/python/venv/lib/python3*/site-packages/chasles/_core.pyi "$built/chasles/_core.pyi"; do
    [ -f "$stubs" ] || continue
    newer=$(find python/src python/CMakeLists.txt chasles tools/docstrings.py -newer "$stubs" -type f | head -n 1)
    if [ -z "$newer" ]; then
        echo "$stubs"
        exit 0
    fi
done

echo "chasles: building the Python module, for its docstrings" >&2
prefix=$PWD/build/python/prefix
cmake --install "$1" --prefix "$prefix" >/dev/null
rm -rf "$built"
python3 -m venv build/python/stubs-environment
build/python/stubs-environment/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --target "$built" \
    --config-settings=cmake.define.CHASLES_PYTHON_OF_INSTALLED=ON --config-settings=cmake.define.chasles_ROOT="$prefix" \
    --config-settings=build-dir=build/python/check . >&2
echo "$built/chasles/_core.pyi"
