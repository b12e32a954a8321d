# SUNDIALS 7.1.1, static and hidden, only what is used.  A source build: an FMU with a distribution's library would need it on every machine.
# Sought in this order: FETCHCONTENT_SOURCE_DIR_SUNDIALS, the user's cache, upstream's release, Debian's source package.

set(sundials_version 7.1.1)
set(sundials_url https://github.com/LLNL/sundials/releases/download/v7.1.1/sundials-7.1.1.tar.gz)
set(sundials_sha256 ea7d6edfb52448ddfdc1ec48f89a721fe6c0a259c10f8ef56f60fcded87a94bb)
set(debian_suite trixie)
set(debian_archive sundials_7.1.1+dfsg1.orig.tar.xz)  # upstream's archive without some figures of its manual
set(debian_sha256 8ed409272af77e958d0ac02fd72199d8643063faf2aa61811e5c615d7db5cf8e)
set(SUNDIALS_DEBIAN_MIRROR "" CACHE STRING "Debian mirror for SUNDIALS' source package; empty: the one that this system's apt uses")
set(FETCHCONTENT_SOURCE_DIR_SUNDIALS "" CACHE PATH "Unpacked SUNDIALS source to use instead of a download")

# Sets `result` to the user's cache folder, or to one in the build tree where there is no writable home.
function(find_cache result)
    if(DEFINED ENV{XDG_CACHE_HOME})
        set(base $ENV{XDG_CACHE_HOME})
    else()
        set(base $ENV{HOME}/.cache)
    endif()
    set(folder ${base}/riveted-bearing)
    execute_process(COMMAND ${CMAKE_COMMAND} -E make_directory ${folder} RESULT_VARIABLE status ERROR_QUIET)
    if(status)
        set(folder ${PROJECT_BINARY_DIR}/_deps)
        file(MAKE_DIRECTORY ${folder})
    endif()
    set(${result} ${folder} PARENT_SCOPE)
endfunction()

# Sets `result` to `file` if it exists and has the checksum, else to nothing.
function(check_archive file sha256 result)
    set(${result} "" PARENT_SCOPE)
    if(EXISTS ${file})
        file(SHA256 ${file} actual)
        if(actual STREQUAL "${sha256}")
            set(${result} ${file} PARENT_SCOPE)
        else()
            message(WARNING "${file} has SHA256 ${actual}, expected ${sha256}: not used")
        endif()
    endif()
endfunction()

# Downloads upstream's release to `file`; one byte first, so that a closed network costs seconds.
function(download_upstream file)
    message(STATUS "SUNDIALS: trying ${sundials_url}")
    file(DOWNLOAD ${sundials_url} STATUS status TIMEOUT 10 RANGE_START 0 RANGE_END 0)
    if(status MATCHES "^0;")
        file(DOWNLOAD ${sundials_url} ${file} STATUS status INACTIVITY_TIMEOUT 20)
    endif()
    if(NOT status MATCHES "^0;")
        message(STATUS "SUNDIALS: ${status}")
        file(REMOVE ${file})
    endif()
endfunction()

# Sets `result` to the Debian mirror that apt is configured for, or to nothing.
function(find_mirror result)
    execute_process(COMMAND ${APT_GET} --print-uris update OUTPUT_VARIABLE uris ERROR_QUIET)
    string(REGEX MATCH "'(https?://[^']*/debian)/dists/" found "${uris}")
    set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

# Downloads the archive of Debian's source package to `file` by apt-get with lists and state of its own: needs no root, leaves the system's state alone.
function(download_debian file)
    find_program(APT_GET apt-get)
    if(NOT APT_GET)
        return()
    endif()
    set(mirror ${SUNDIALS_DEBIAN_MIRROR})
    if(NOT mirror)
        find_mirror(mirror)
    endif()
    if(NOT mirror)
        message(STATUS "SUNDIALS: apt knows no Debian mirror; -DSUNDIALS_DEBIAN_MIRROR=URL names one")
        return()
    endif()
    message(STATUS "SUNDIALS: trying Debian ${debian_suite}'s source package")
    set(apt ${PROJECT_BINARY_DIR}/_deps/apt)
    file(MAKE_DIRECTORY ${apt}/lists/partial ${apt}/cache/archives/partial)
    file(WRITE ${apt}/status "")
    file(WRITE ${apt}/sources.list "deb-src [trusted=yes] ${mirror} ${debian_suite} main\n")  # the archive's checksum is pinned
    set(command ${APT_GET} -qq -o Dir::Etc::sourcelist=${apt}/sources.list -o Dir::Etc::sourceparts=/dev/null -o Dir::Etc::preferencesparts=/dev/null
        -o Dir::State=${apt} -o Dir::State::status=${apt}/status -o Dir::Cache=${apt}/cache -o APT::Sandbox::User=
        -o Acquire::Languages=none -o Acquire::http::Timeout=20 -o Acquire::Retries=1)
    execute_process(COMMAND ${command} update WORKING_DIRECTORY ${apt} RESULT_VARIABLE status ERROR_VARIABLE error)
    if(NOT status)
        execute_process(COMMAND ${command} source --download-only --tar-only sundials/${debian_suite}
            WORKING_DIRECTORY ${apt} RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE error)
    endif()
    if(EXISTS ${apt}/${debian_archive})
        file(RENAME ${apt}/${debian_archive} ${file})
    else()
        message(STATUS "SUNDIALS: ${error}")
    endif()
    file(REMOVE_RECURSE ${apt})
endfunction()

# Sets `result` to an archive with the right checksum, downloading it into the cache if it is not there, or to nothing.
function(find_archive result)
    find_cache(cache)
    set(upstream ${cache}/sundials-${sundials_version}.tar.gz)
    set(debian ${cache}/${debian_archive})
    string(RANDOM LENGTH 8 random)
    set(partial ${cache}/partial-${random})
    foreach(source IN ITEMS cached upstream debian)
        if("${source}" STREQUAL "upstream")
            download_upstream(${partial})
        elseif("${source}" STREQUAL "debian")
            download_debian(${partial})
        endif()
        if(EXISTS ${partial})
            file(RENAME ${partial} ${${source}})
        endif()
        check_archive(${upstream} ${sundials_sha256} archive)
        if(NOT archive)
            check_archive(${debian} ${debian_sha256} archive)
        endif()
        if(archive)
            break()
        endif()
    endforeach()
    set(${result} ${archive} PARENT_SCOPE)
endfunction()

# Sets `result` to the folder of the unpacked source, or to nothing.
function(find_sundials_source result)
    set(folder ${PROJECT_BINARY_DIR}/_deps/sundials-${sundials_version})
    if(FETCHCONTENT_SOURCE_DIR_SUNDIALS)
        set(folder ${FETCHCONTENT_SOURCE_DIR_SUNDIALS})
    elseif(NOT EXISTS ${folder}/LICENSE)
        find_archive(archive)
        if(archive)
            message(STATUS "SUNDIALS: ${archive}")
            file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${PROJECT_BINARY_DIR}/_deps
                PATTERNS */include/* */src/* */LICENSE)
        else()
            set(folder "")
        endif()
    endif()
    set(${result} ${folder} PARENT_SCOPE)
endfunction()

# Writes the headers that SUNDIALS' own build configures into `folder`: double precision, 64-bit indices, nothing optional, the same on every platform.
function(configure_sundials source folder)
    set(PACKAGE_VERSION ${sundials_version})
    string(REPLACE "." ";" numbers ${sundials_version})
    list(GET numbers 0 PACKAGE_VERSION_MAJOR)
    list(GET numbers 1 PACKAGE_VERSION_MINOR)
    list(GET numbers 2 PACKAGE_VERSION_PATCH)
    set(PRECISION_LEVEL "#define SUNDIALS_DOUBLE_PRECISION 1")
    set(INDEX_TYPE "#define SUNDIALS_INT64_T 1")
    set(SUNDIALS_CINDEX_TYPE int64_t)
    set(SUNDIALS_LOGGING_LEVEL 0)
    set(SUNDIALS_DEPRECATED_MSG_MACRO "")
    foreach(stamp IN ITEMS C_COMPILER_ID C_COMPILER_VERSION C_FLAGS BUILD_TYPE)
        set(CMAKE_${stamp} "")
    endforeach()
    configure_file(${source}/include/sundials/sundials_config.in ${folder}/configured.h)
    file(READ ${folder}/configured.h configured)
    file(CONFIGURE OUTPUT ${folder}/sundials/sundials_config.h CONTENT "@configured@\n#include \"@PROJECT_SOURCE_DIR@/fmu_src/numbers/reserved_memory.h\"\n" @ONLY)
    file(CONFIGURE OUTPUT ${folder}/sundials/sundials_export.h CONTENT
        "#define SUNDIALS_EXPORT\n#define SUNDIALS_NO_EXPORT\n#define SUNDIALS_DEPRECATED\n#define SUNDIALS_DEPRECATED_EXPORT\n#define SUNDIALS_DEPRECATED_NO_EXPORT\n")
endfunction()

# What the integrator uses of it, and what these files need: an undefined symbol at the link names the file to add.
set(sundials_files
    arkode/arkode.c arkode/arkode_adapt.c arkode/arkode_butcher.c arkode/arkode_butcher_erk.c arkode/arkode_erkstep.c arkode/arkode_erkstep_io.c
    arkode/arkode_interp.c arkode/arkode_io.c arkode/arkode_relaxation.c arkode/arkode_root.c arkode/arkode_user_controller.c nvector/serial/nvector_serial.c
    sunadaptcontroller/imexgus/sunadaptcontroller_imexgus.c sunadaptcontroller/soderlind/sunadaptcontroller_soderlind.c
    sundials/sundials_adaptcontroller.c sundials/sundials_context.c sundials/sundials_errors.c sundials/sundials_hashmap.c sundials/sundials_logger.c
    sundials/sundials_math.c sundials/sundials_nvector.c)

# Target sundials: its objects.
find_sundials_source(sundials_source)
if(NOT sundials_source)
    message(FATAL_ERROR "The source of SUNDIALS ${sundials_version} cannot be reached.  Give -DFETCHCONTENT_SOURCE_DIR_SUNDIALS=<folder>.  "
        "An installed SUNDIALS is not enough: the default step is a time-stepping module of ARKODE, whose header arkode_impl.h is not installed.")
endif()
if(EXISTS ${sundials_source}/CMakeLists.txt)  # a folder that was given; of an archive the checksum is known
    file(STRINGS ${sundials_source}/CMakeLists.txt given REGEX "set\\(PACKAGE_VERSION_(MAJOR|MINOR|PATCH)")
    string(REGEX REPLACE "[^0-9;]" "" given "${given}")
    string(REPLACE ";" "." given "${given}")
    if(NOT given STREQUAL sundials_version)
        message(FATAL_ERROR "${sundials_source} is SUNDIALS ${given}, wanted is ${sundials_version}: the default step is a time-stepping module of ARKODE, "
            "whose private header arkode_impl.h changes between versions.  Read its changes, then change fmu_src/solver/bearing_step.c and cmake/sundials.cmake.")
    endif()
endif()
set(sundials_headers ${PROJECT_BINARY_DIR}/_deps/sundials-include)
configure_sundials(${sundials_source} ${sundials_headers})
list(TRANSFORM sundials_files PREPEND ${sundials_source}/src/)
add_compile_options(-ffile-prefix-map=${sundials_source}=sundials)
set(sundials_folders ${sundials_headers} ${sundials_source}/include ${sundials_source}/src/sundials ${sundials_source}/src/arkode)
add_library(sundials OBJECT ${sundials_files})
target_include_directories(sundials SYSTEM PUBLIC ${sundials_folders})
set_source_files_properties(${sundials_source}/src/arkode/arkode_butcher.c PROPERTIES COMPILE_OPTIONS -O1)  # set-up only; -O3 takes 2 s
target_compile_options(sundials PRIVATE -w -ffp-contract=off -fno-math-errno -fvisibility=hidden ${old_glibc})
