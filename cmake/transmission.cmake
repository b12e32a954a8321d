# The example: a shaft as a second FMU behind the same wrapper, and the system of both (examples/transmission).  The checkout's own bearing only.

set(transmission ${PROJECT_SOURCE_DIR}/examples/transmission)
if(GENERATED_DIR OR NOT EXISTS ${transmission})
    return()
endif()

# The shaft's own variables stand where the bearing's would: the include path decides whose table the wrapper sees.
set(shaft ${PROJECT_BINARY_DIR}/shaft)
file(MAKE_DIRECTORY ${shaft})
set(generated ${shaft}/variables.h ${shaft}/variables.c ${shaft}/modelDescription.xml)
file(GLOB templates CONFIGURE_DEPENDS ${tools}/templates/*)
add_custom_command(OUTPUT ${generated}
    COMMAND ${run}/generate.py --table ${transmission}/shaft.toml --out ${shaft}
    COMMAND ${CMAKE_COMMAND} -E touch ${generated}
    DEPENDS ${transmission}/shaft.toml ${tools}/generate.py ${templates} VERBATIM)
set(shaft_sources ${transmission}/shaft.c ${fmu_src}/fmi2_wrapper.c ${fmu_src}/variable_table.c ${shaft}/variables.c)
add_fmu_binary(Shaft ${shaft_sources} ${shaft}/variables.h)
target_include_directories(Shaft PRIVATE ${fmu_src} ${shaft})
target_link_libraries(Shaft PRIVATE m)
add_dependencies(binaries Shaft)
if(CMAKE_CROSSCOMPILING)
    return()
endif()

# Its binaries lie beside the bearing's.
set(shaft_binaries $<TARGET_FILE:Shaft>)
set(shaft_files Shaft)
if(BINARIES)
    list(TRANSFORM BINARIES REPLACE "RivetedBearing([.][a-z]+)$" "Shaft\\1" OUTPUT_VARIABLE shaft_binaries)
    list(TRANSFORM shaft_binaries REPLACE "^[^=]*=" "" OUTPUT_VARIABLE shaft_files)
endif()
list(TRANSFORM shaft_binaries PREPEND "--binary=")
get_filename_component(fmu_dir ${FMU} DIRECTORY)
list(TRANSFORM shaft_sources PREPEND "--source=" OUTPUT_VARIABLE sources)
add_custom_command(OUTPUT ${fmu_dir}/Shaft.fmu
    COMMAND ${run}/package.py --description ${shaft}/modelDescription.xml ${shaft_binaries} ${sources}
        --include ${fmu_src} --include ${shaft} --out ${fmu_dir}/Shaft.fmu
    DEPENDS ${shaft_files} ${generated} ${tools}/package.py ${tools}/sources.py VERBATIM)
set(system ${fmu_dir}/Transmission.ssp)
add_custom_command(OUTPUT ${system}
    COMMAND ${run}/system.py --description ${transmission}/transmission.ssd --out ${system}
        --resource ${transmission}/shaft.ssv --resource ${transmission}/bearing.ssv --resource ${fmu_dir}/Shaft.fmu --resource ${FMU}
    DEPENDS ${FMU} ${fmu_dir}/Shaft.fmu ${transmission}/transmission.ssd ${transmission}/shaft.ssv ${transmission}/bearing.ssv ${tools}/system.py ${tools}/package.py VERBATIM)
add_custom_target(transmission ALL DEPENDS ${system})
add_dependencies(transmission fmu)
