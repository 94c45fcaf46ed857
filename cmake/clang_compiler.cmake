# The toolchain of the presets `asan` and `tidy` (libFuzzer comes with Clang), in the version that formatting is pinned to.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../tools/clang-tools-version clang_version LIMIT_COUNT 1)
set(CMAKE_CXX_COMPILER clang++-${clang_version})
