#!/bin/sh
# Runs the tests of the Python package, with bindings and library under the address and undefined-behaviour sanitizers.
# Uses the environment that python_check.sh has made. (The library needs the sanitizers too, because Eigen then allocates
# differently.)
set -eu
cd "$(dirname "$0")/.."

python=$PWD/build/python/venv/bin/python
build=$PWD/build/python/asan
"$python" -m pip install --quiet --disable-pip-version-check nanobind
cmake -G Ninja -S . -B "$build" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
    -DCMAKE_CXX_FLAGS="-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer" \
    -DCHASLES_PYTHON=ON -DCHASLES_PYTHON_STUBS=OFF -DCHASLES_TESTS=OFF -DCHASLES_CLI=OFF -DCHASLES_INSTALL=OFF \
    -DPython_EXECUTABLE="$python" -Dnanobind_DIR="$("$python" -m nanobind --cmake_dir)" >/dev/null
cmake --build "$build" --target chasles_python

rm -rf "$build/package"
mkdir "$build/package"
cp -r python/chasles "$build/package/"
cp "$build"/python/_core* "$build/package/chasles/"
# Python does not free all its memory at exit. This is not a leak of Chasles.
LD_PRELOAD="$(c++ -print-file-name=libasan.so) $(c++ -print-file-name=libubsan.so)" \
    ASAN_OPTIONS=detect_leaks=0 PYTHONPATH="$build/package" \
    "$python" -m pytest -q -p no:cacheprovider tests/python -k "not distributed"
