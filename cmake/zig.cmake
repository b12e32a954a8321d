# Toolchain: compiles for another platform with zig's C compiler (PyPI: ziglang), which brings every platform's C library along.
#
#   cmake -S . -B build/win64 -DCMAKE_TOOLCHAIN_FILE=cmake/zig.cmake -DPLATFORM=win64 [-DZIG=path/of/zig]
#
#   PLATFORM   as FMI names its folder of binaries: linux64 (glibc 2.17 or later), win64, darwin64, aarch64-darwin, aarch64-linux; wasm32 for a browser

set(platform_linux64 Linux x86_64 x86_64-linux-gnu.2.17)
set(platform_aarch64-linux Linux aarch64 aarch64-linux-gnu.2.17)
set(platform_win64 Windows AMD64 x86_64-windows-gnu)
set(platform_darwin64 Darwin x86_64 x86_64-macos.11.0)
set(platform_aarch64-darwin Darwin arm64 aarch64-macos.11.0)
set(platform_wasm32 Generic wasm32 wasm32-wasi-musl)
if(NOT DEFINED platform_${PLATFORM})
    message(FATAL_ERROR "PLATFORM=${PLATFORM}: allowed are linux64, aarch64-linux, win64, darwin64, aarch64-darwin, wasm32")
endif()
list(GET platform_${PLATFORM} 0 CMAKE_SYSTEM_NAME)
list(GET platform_${PLATFORM} 1 CMAKE_SYSTEM_PROCESSOR)
list(GET platform_${PLATFORM} 2 target)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PLATFORM ZIG)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

find_program(ZIG zig REQUIRED)
set(CMAKE_C_COMPILER ${ZIG} cc -target ${target})
# A machine without a compiler has no ar either: zig brings that along too.
set(CMAKE_AR ${ZIG} CACHE FILEPATH "Archiver")
set(CMAKE_USER_MAKE_RULES_OVERRIDE ${CMAKE_CURRENT_LIST_DIR}/zig_archive.cmake)  # after CMake's own rules for the platform
