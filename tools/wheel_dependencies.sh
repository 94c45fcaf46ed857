#!/bin/sh
# Builds what the library links to from vcpkg, for wheels that run on machines without it.
#
#   wheel_dependencies.sh FOLDER    where vcpkg goes; what is there already is used
set -eu

[ -d "$1" ] || git clone --depth 1 https://github.com/microsoft/vcpkg "$1"
"$1/bootstrap-vcpkg.sh" -disableMetrics
"$1/vcpkg" install ${VCPKG_TARGET_TRIPLET:+--triplet "$VCPKG_TARGET_TRIPLET"} \
    eigen3 boost-multiprecision tbb assimp fmt nlohmann-json
