# The core as WebAssembly for the browser's page (docs/site/browser): `make browser`, with zig (cmake/zig.cmake, PLATFORM=wasm32).

add_executable(browser ${PROJECT_SOURCE_DIR}/docs/site/browser/core.c $<TARGET_OBJECTS:bearing>)
target_compile_options(browser PRIVATE ${core_flags})
target_link_libraries(browser PRIVATE core)
# A library that the page calls, not a program; a megabyte of stack, of which a step needs some kilobytes.
target_link_options(browser PRIVATE -mexec-model=reactor -Wl,-s -Wl,--gc-sections -Wl,-z,stack-size=1048576)
set_target_properties(browser PROPERTIES OUTPUT_NAME RivetedBearing SUFFIX .wasm)
