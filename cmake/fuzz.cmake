# Programs that call the FMU's functions with random arguments, for the tests.
#
#   fuzz_api    deterministic pseudo-random calls; with SANITIZE=fuzzer,... (clang) a coverage-guided fuzzer instead

file(GLOB fuzz_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/fuzz_api.c)
if(fuzz_files)
    find_package(Threads REQUIRED)
    add_executable(fuzz_api ${core_objects} ${fmu_src}/fmi2_wrapper.c ${fuzz_files})
    target_include_directories(fuzz_api SYSTEM PRIVATE ${fmpy_dir}/c-code)
    target_compile_options(fuzz_api PRIVATE ${core_flags} -frounding-math)
    target_link_libraries(fuzz_api PRIVATE core Threads::Threads)
    if(SANITIZE MATCHES "fuzzer")
        target_link_options(fuzz_api PRIVATE -fsanitize=fuzzer)
    else()
        target_compile_definitions(fuzz_api PRIVATE STANDALONE)
    endif()
endif()
