# The FMU: its binary, which exports fmi2* only and needs libc and libm only, and the archive around it.

# A binary of FMI functions from the wrapper and the part behind it.
function(add_fmu_binary name)
    add_library(${name} SHARED ${ARGN})  # ARGN may begin with EXCLUDE_FROM_ALL
    set_target_properties(${name} PROPERTIES PREFIX "" NO_SONAME ON)
    target_include_directories(${name} SYSTEM PRIVATE ${fmpy_dir}/c-code)
    target_compile_options(${name} PRIVATE ${core_flags})
    target_compile_definitions(${name} PRIVATE FMI2_OVERRIDE_FUNCTION_PREFIX)  # a binary's functions have no prefix
    if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
        target_link_options(${name} PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map -Wl,--gc-sections)
        set_target_properties(${name} PROPERTIES LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/exports.map)
        if(NOT SANITIZE)
            target_link_options(${name} PRIVATE -Wl,--no-undefined)
        endif()
    elseif(APPLE AND NOT CMAKE_CROSSCOMPILING)
        target_link_options(${name} PRIVATE -Wl,-exported_symbol,_fmi2* -Wl,-S -Wl,-x)  # cross-compiled, all others are hidden
    endif()
    if(WIN32 AND CMAKE_C_COMPILER_ID STREQUAL "GNU")
        target_link_options(${name} PRIVATE -Wl,--no-insert-timestamp)
    endif()
    if(NOT SANITIZE AND (CMAKE_CROSSCOMPILING OR NOT APPLE))
        target_link_options(${name} PRIVATE -Wl,-s)  # symbols name files and folders
    endif()
    if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
        target_link_options(${name} PRIVATE -static-libgcc)
    endif()
endfunction()

set(source_files ${core_files} ${kernel_files} ${bearing_files} ${wrapper_files} ${sundials_files})
set(source_folders ${core_includes} ${sundials_folders})
set(build_info ${PROJECT_BINARY_DIR}/build_info.c)
add_build_info(${build_info} "${source_files}" "${source_folders}")
add_fmu_binary(RivetedBearing $<TARGET_OBJECTS:bearing> ${wrapper_files} ${build_info})
target_link_libraries(RivetedBearing PRIVATE core)
if(TARGET kernel_by_fours)
    # For the tests only: its kernel avx512 is computed by AVX2.
    add_fmu_binary(RivetedBearing_by_fours EXCLUDE_FROM_ALL $<TARGET_OBJECTS:kernel_by_fours> $<TARGET_OBJECTS:dispatch_by_fours> $<TARGET_OBJECTS:bearing>
        ${wrapper_files} ${build_info})
    target_link_libraries(RivetedBearing_by_fours PRIVATE core)  # without what these objects define
endif()
add_custom_target(binaries DEPENDS RivetedBearing)  # all there are for this platform

# The archive: each part made only when what it follows from has changed.
#
#   FMU        file to write (default: RivetedBearing.fmu in the build folder)
#   READY_FMU  FMU to put into the wheel in place of a compiled one (make dist)
#   BINARIES   binaries to pack as PLATFORM=FILE, separated by semicolons, instead of this build's (cmake/zig.cmake makes them)
#   COMPILER   what compiled them, for the bill of materials
set(FMU ${PROJECT_BINARY_DIR}/RivetedBearing.fmu CACHE FILEPATH "The FMU to write")
set(BINARIES "" CACHE STRING "Binaries to pack: PLATFORM=FILE;...")
set(COMPILER "" CACHE STRING "What compiled BINARIES: name and version")
set(compiler ${COMPILER})
if(NOT BINARIES)
    set(compiler "${CMAKE_C_COMPILER_ID} ${CMAKE_C_COMPILER_VERSION}")
endif()
set(description ${PROJECT_SOURCE_DIR}/fmus/modelDescription.xml)
set(parameters ${PROJECT_SOURCE_DIR}/docs/parameters.md)
if(GENERATED_DIR)
    set(description ${GENERATED_DIR}/modelDescription.xml)
    set(parameters ${GENERATED_DIR}/parameters.md)
endif()
set(tools ${PROJECT_SOURCE_DIR}/fmus)
cmake_path(GET bearing_model_dir PARENT_PATH packages)  # in the environment that pip builds in, the checkout's packages are not installed
set(run ${CMAKE_COMMAND} -E env --modify PYTHONPATH=path_list_prepend:${packages} ${Python_EXECUTABLE} ${tools})
set(parts ${PROJECT_BINARY_DIR}/fmu)
file(MAKE_DIRECTORY ${parts})

add_custom_command(OUTPUT ${parts}/icons/icon.png ${parts}/bearing.svg
    COMMAND ${run}/picture.py --description ${description} --icons ${parts}/icons --drawing ${parts}/bearing.svg
    DEPENDS ${description} ${tools}/picture.py VERBATIM)
file(GLOB texts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md)
if(sundials_files)
    set(with_sources --sources)
endif()
add_custom_command(OUTPUT ${parts}/index.html
    COMMAND ${run}/documentation_page.py --description ${description} --parameters ${parameters} --drawing ${parts}/bearing.svg --out ${parts}/index.html ${with_sources}
    DEPENDS ${description} ${parameters} ${parts}/bearing.svg ${tools}/documentation_page.py ${tools}/templates/page.html ${tools}/templates/bearing.html ${PROJECT_SOURCE_DIR}/README.md ${texts} VERBATIM)

set(binaries ${BINARIES})
set(binary_files RivetedBearing)
if(NOT BINARIES)
    set(binaries $<TARGET_FILE:RivetedBearing>)
else()
    list(TRANSFORM BINARIES REPLACE "^[^=]*=" "" OUTPUT_VARIABLE binary_files)
endif()
foreach(binary IN LISTS binaries)
    list(APPEND binary_arguments --binary ${binary})
endforeach()
set(origin --version ${package_version} --author ${package_author} --compiler ${compiler} --build-info)  # then the file
set(arguments ${binary_arguments} ${origin} ${build_info} --description ${description} --page ${parts}/index.html --pictures ${parts}/icons
    --terminals ${tools}/terminalsAndIcons.xml --material "data rivet_table ${RIVET_TABLE}" --rivet-table ${RIVET_TABLE} --out ${FMU})
if(sundials_files)
    list(APPEND arguments --material "library sundials ${sundials_version}")
    list(TRANSFORM source_files PREPEND "--source\n" OUTPUT_VARIABLE sources)
    list(TRANSFORM source_folders PREPEND "--include\n" OUTPUT_VARIABLE folders)
    list(APPEND arguments ${sources} --source ${build_info} ${folders})
endif()
if(NOT SANITIZE)  # runs the binary in a Python without the sanitizers' library
    add_custom_command(OUTPUT ${parts}/reference.csv
        COMMAND ${run}/reference.py --description ${description} --out ${parts}/reference.csv ${binary_arguments}
        DEPENDS ${description} ${binary_files} ${tools}/reference.py ${tools}/package.py VERBATIM)
    set(reference ${parts}/reference.csv)
    list(APPEND arguments --reference ${reference})
endif()
list(JOIN arguments "\n" arguments)
file(GENERATE OUTPUT ${parts}/arguments.txt CONTENT "${arguments}\n")
add_custom_command(OUTPUT ${FMU}
    COMMAND ${run}/package.py @${parts}/arguments.txt
    DEPENDS ${parts}/arguments.txt ${binary_files} ${source_files} ${description} ${parts}/index.html ${parts}/icons/icon.png ${reference}
        ${build_info} ${tools}/package.py ${tools}/materials.py ${tools}/sources.py ${tools}/terminalsAndIcons.xml ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY_NOTICES.md VERBATIM)
set(installed_fmu ${FMU})
if(READY_FMU)
    set(installed_fmu ${READY_FMU})
endif()
add_custom_target(fmu ALL DEPENDS ${installed_fmu})

# In the wheel: the FMU, and what `riveted-bearing build` compiles, laid out as in the checkout.
install(FILES ${installed_fmu} DESTINATION riveted_bearing RENAME RivetedBearing.fmu COMPONENT python)
set(source_dir riveted_bearing/_source)
install(FILES CMakeLists.txt pyproject.toml LICENSE THIRD_PARTY_NOTICES.md README.md DESTINATION ${source_dir} COMPONENT python)
install(DIRECTORY cmake fmu_src fmus docs DESTINATION ${source_dir} COMPONENT python PATTERN __pycache__ EXCLUDE PATTERN *.fmu EXCLUDE)
