# The toolchain of the preset `wasm`: WebAssembly with WASI, by the compiler that tools/wasm_toolchain.sh installs.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)

file(REAL_PATH ${CMAKE_CURRENT_LIST_DIR}/../.. root)
set(CHASLES_WASM_TOOLCHAIN ${root}/build/wasm-toolchain CACHE PATH "Folder of the WebAssembly compiler")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CHASLES_WASM_TOOLCHAIN)
execute_process(COMMAND ${root}/tools/wasm_toolchain.sh ${CHASLES_WASM_TOOLCHAIN} COMMAND_ERROR_IS_FATAL ANY)

set(CMAKE_C_COMPILER ${CHASLES_WASM_TOOLCHAIN}/cc)
set(CMAKE_CXX_COMPILER ${CHASLES_WASM_TOOLCHAIN}/c++)
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -DBOOST_NO_CXX98_FUNCTION_BASE")
# The exception runtime stands first, before the libraries that abort instead.
file(GLOB exception_objects ${CHASLES_WASM_TOOLCHAIN}/exceptions/*.o)
list(JOIN exception_objects " " exception_objects)
set(CMAKE_EXE_LINKER_FLAGS_INIT "${exception_objects}")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)

# Eigen and Boost are headers of the system. /usr/include itself must not be searched: it holds the headers of another C
# library. The folder below holds a link to those of Boost.
file(MAKE_DIRECTORY ${CHASLES_WASM_TOOLCHAIN}/include)
find_path(CHASLES_BOOST_HEADERS boost/multiprecision/cpp_int.hpp PATHS /usr/include /usr/local/include REQUIRED)
file(CREATE_LINK ${CHASLES_BOOST_HEADERS}/boost ${CHASLES_WASM_TOOLCHAIN}/include/boost SYMBOLIC)
set(Boost_NO_BOOST_CMAKE ON CACHE INTERNAL "The package files of Boost name /usr/include")
set(Boost_NO_SYSTEM_PATHS ON CACHE INTERNAL "")
set(BOOST_INCLUDEDIR ${CHASLES_WASM_TOOLCHAIN}/include CACHE INTERNAL "")
