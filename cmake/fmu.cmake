# The FMU: its binary, which exports fmi2* only and needs libc and libm only, and the archive around it.

add_library(RivetedBearing SHARED ${core_objects} ${fmu_src}/fmi2_wrapper.c)
set_target_properties(RivetedBearing PROPERTIES PREFIX "" NO_SONAME ON)
target_include_directories(RivetedBearing SYSTEM PRIVATE ${fmpy_dir}/c-code)
target_compile_options(RivetedBearing PRIVATE ${core_flags})
target_link_libraries(RivetedBearing PRIVATE core)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    target_link_options(RivetedBearing PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exports.map -Wl,--gc-sections)
    set_target_properties(RivetedBearing PROPERTIES LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/exports.map)
    if(NOT SANITIZE)
        target_link_options(RivetedBearing PRIVATE -Wl,--no-undefined -Wl,-s)
    endif()
elseif(APPLE AND NOT CMAKE_CROSSCOMPILING)
    target_link_options(RivetedBearing PRIVATE -Wl,-exported_symbol,_fmi2*)  # cross-compiled, all others are hidden
endif()
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
    target_link_options(RivetedBearing PRIVATE -static-libgcc)
endif()

set(FMU ${PROJECT_BINARY_DIR}/RivetedBearing.fmu CACHE FILEPATH "The FMU to write")
set(description ${PROJECT_SOURCE_DIR}/fmus/modelDescription.xml)
if(GENERATED_DIR)
    set(description ${GENERATED_DIR}/modelDescription.xml)
endif()
set(package ${PROJECT_SOURCE_DIR}/bearing_model/app/package.py)
add_custom_command(OUTPUT ${FMU}
    COMMAND ${Python_EXECUTABLE} ${package} --binary $<TARGET_FILE:RivetedBearing> --description ${description} --out ${FMU}
    DEPENDS RivetedBearing ${description} ${package} ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY_NOTICES.md VERBATIM)
add_custom_target(fmu ALL DEPENDS ${FMU})

# In the wheel: the FMU, and what `riveted-bearing build` compiles, laid out as in the checkout.
install(FILES ${FMU} DESTINATION bearing_model COMPONENT python)
set(source_dir bearing_model/_source)
install(FILES CMakeLists.txt LICENSE THIRD_PARTY_NOTICES.md DESTINATION ${source_dir} COMPONENT python)
install(DIRECTORY cmake fmu_src fmus DESTINATION ${source_dir} COMPONENT python PATTERN __pycache__ EXCLUDE PATTERN *.fmu EXCLUDE)
install(FILES ${package} DESTINATION ${source_dir}/bearing_model/app COMPONENT python)
