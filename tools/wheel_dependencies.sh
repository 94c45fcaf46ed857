#!/bin/sh
# Builds the dependencies of the library with vcpkg, for wheels that run on machines without them.
#
#   wheel_dependencies.sh FOLDER    the folder for vcpkg; an existing checkout is used
set -eu

[ -d "$1" ] || git clone --depth 1 https://github.com/microsoft/vcpkg "$1"
"$1/bootstrap-vcpkg.sh" -disableMetrics
"$1/vcpkg" install ${VCPKG_TARGET_TRIPLET:+--triplet "$VCPKG_TARGET_TRIPLET"} \
    eigen3 boost-multiprecision tbb tinyxml2 zlib fmt nlohmann-json
