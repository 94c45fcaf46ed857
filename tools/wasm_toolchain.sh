#!/bin/sh
# Installs the compiler for WebAssembly from the Python package index, with the C++ exception runtime that it lacks for
# WASI. Does nothing if the folder holds it already.
#
#   wasm_toolchain.sh [FOLDER]    default: build/wasm-toolchain
#
# FOLDER/c++ and FOLDER/cc compile and link for WebAssembly; FOLDER/exceptions/*.o belong on each link line. The compiler
# is Clang with libc++ and wasi-libc, as the package `ziglang` brings them (docs/decisions/0080-webassembly-toolchain.md).
set -eu

version=0.17.1
folder=${1:-$(dirname "$0")/../build/wasm-toolchain}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
stamp=$folder/installed
script_sum=$(cksum <"$0")
[ "$(cat "$stamp" 2>/dev/null || true)" != "$script_sum" ] || exit 0

echo "chasles: installing the WebAssembly compiler (ziglang $version)"
rm -rf "$folder/packages" "$folder/environment" "$folder/exceptions" "$stamp"
python3 -m venv "$folder/environment"
"$folder/environment/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --no-cache-dir \
    --target "$folder/packages" "ziglang==$version"

for language in c++ cc; do
    cat >"$folder/$language" <<WRAPPER
#!/bin/sh
export ZIG_GLOBAL_CACHE_DIR='$folder/cache' ZIG_LOCAL_CACHE_DIR='$folder/cache'
exec '$folder/packages/ziglang/zig' $language -target wasm32-wasi \
    -mcpu=generic+exception_handling+simd128+bulk_memory+nontrapping_fptoint "\$@"
WRAPPER
    chmod +x "$folder/$language"
done

# The runtime: throwing and catching (libcxxabi), the personality (libunwind), an operator new that throws, and the tag of
# C++ exceptions. Those that the package builds abort instead.
libraries=$folder/packages/ziglang/lib
mkdir -p "$folder/exceptions"
cd "$folder/exceptions"
for source in cxa_exception cxa_personality cxa_aux_runtime; do
    "$folder/c++" -std=c++23 -O2 -fwasm-exceptions -D_LIBCPP_BUILDING_LIBRARY -D_LIBCXXABI_BUILDING_LIBRARY \
        -D_LIBCXXABI_HAS_NO_THREADS -I"$libraries/libcxxabi/include" -I"$libraries/libcxxabi/src" -I"$libraries/libcxx/src" \
        -I"$libraries/libunwind/include" -c "$libraries/libcxxabi/src/$source.cpp" -o $source.o
done
"$folder/cc" -std=c23 -O2 -fwasm-exceptions -D_LIBUNWIND_HIDE_SYMBOLS -D__WASM_EXCEPTIONS__ -I"$libraries/libunwind/include" \
    -c "$libraries/libunwind/src/Unwind-wasm.c" -o unwind.o
cat >new.cpp <<'NEW'
#include <cstdlib>
#include <new>
void* operator new(std::size_t size) {
    if (void* const memory = std::malloc(size == 0 ? 1 : size))
        return memory;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto step = static_cast<std::size_t>(alignment);
    const std::size_t rounded = (size + step - 1) / step * step;
    if (void* const memory = rounded < size ? nullptr : std::aligned_alloc(step, rounded == 0 ? step : rounded))
        return memory;
    throw std::bad_alloc();
}
NEW
"$folder/c++" -std=c++20 -O2 -fwasm-exceptions -c new.cpp -o new.o
cat >tag.s <<'TAG'
	.tagtype	__cpp_exception i32
	.globl	__cpp_exception
__cpp_exception:
TAG
"$folder/cc" -c tag.s -o tag.o
echo "$script_sum" >"$stamp"
