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
set(shaft_core ${transmission}/shaft.c ${fmu_src}/numbers/variable_table.c ${shaft}/variables.c)
set(shaft_sources ${shaft_core} ${wrapper_files})
add_build_info(${shaft}/build_info.c "${shaft_sources}" "${fmu_src};${shaft}")
add_fmu_binary(Shaft ${shaft_sources} ${shaft}/build_info.c ${shaft}/variables.h)
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
add_custom_command(OUTPUT ${shaft}/shaft.svg ${shaft}/icons/icon.png
    COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${tools} ${Python_EXECUTABLE} ${transmission}/shaft_picture.py
        --description ${shaft}/modelDescription.xml --drawing ${shaft}/shaft.svg --icons ${shaft}/icons
    DEPENDS ${generated} ${transmission}/shaft_picture.py ${tools}/picture.py VERBATIM)
add_custom_command(OUTPUT ${shaft}/index.html
    COMMAND ${run}/documentation_page.py --description ${shaft}/modelDescription.xml --parameters ${shaft}/parameters.md --drawing ${shaft}/shaft.svg
        --text ${transmission}/shaft.md --sources --out ${shaft}/index.html
    DEPENDS ${generated} ${shaft}/shaft.svg ${transmission}/shaft.md ${tools}/documentation_page.py ${tools}/templates/page.html VERBATIM)
list(TRANSFORM shaft_sources PREPEND "--source=" OUTPUT_VARIABLE sources)
add_custom_command(OUTPUT ${fmu_dir}/Shaft.fmu
    COMMAND ${run}/package.py ${origin} ${shaft}/build_info.c --description ${shaft}/modelDescription.xml ${shaft_binaries} ${sources}
        --source ${shaft}/build_info.c --include ${fmu_src} --include ${shaft} --page ${shaft}/index.html --pictures ${shaft}/icons --out ${fmu_dir}/Shaft.fmu
    DEPENDS ${shaft_files} ${generated} ${shaft}/build_info.c ${shaft}/index.html ${shaft}/icons/icon.png ${tools}/package.py ${tools}/materials.py
        ${tools}/sources.py VERBATIM)
set(system_parts ${transmission}/shaft.ssv ${transmission}/bearing.ssv ${fmu_dir}/Shaft.fmu ${FMU})
list(TRANSFORM system_parts PREPEND "--resource=" OUTPUT_VARIABLE resources)
foreach(version 1.0 2.0)
    set(system ${fmu_dir}/Transmission.ssp)
    if(version STREQUAL "2.0")
        set(system ${fmu_dir}/Transmission-2.0.ssp)
    endif()
    add_custom_command(OUTPUT ${system}
        COMMAND ${run}/system.py --version ${version} --description ${transmission}/transmission.ssd --out ${system} ${resources}
        DEPENDS ${system_parts} ${transmission}/transmission.ssd ${tools}/system.py ${tools}/package.py VERBATIM)
    list(APPEND systems ${system})
endforeach()
add_custom_target(transmission ALL DEPENDS ${systems})
add_dependencies(transmission fmu)
