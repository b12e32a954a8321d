# Version and author from pyproject.toml, and the digest of a binary's sources.

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/pyproject.toml)
file(READ ${PROJECT_SOURCE_DIR}/pyproject.toml pyproject)
string(REGEX MATCH "\nversion = \"([^\"]+)\"" found "${pyproject}")
set(package_version ${CMAKE_MATCH_1})
string(REGEX MATCH "\nauthors = \\[{ name = \"([^\"]+)\"" found "${pyproject}")
set(package_author ${CMAKE_MATCH_1})
if(NOT package_version OR NOT package_author)
    message(FATAL_ERROR "pyproject.toml: no version or no author found")
endif()

# Adds the command that writes `file` (build_info.c) with the digest of all these sources and of the headers that they include from these folders.
function(add_build_info file sources folders)
    set(headers "")
    foreach(folder IN LISTS folders)
        file(GLOB_RECURSE found CONFIGURE_DEPENDS ${folder}/*.h)
        list(APPEND headers ${found})
    endforeach()
    list(TRANSFORM sources PREPEND "--source\n" OUTPUT_VARIABLE source_arguments)
    list(TRANSFORM folders PREPEND "--include\n" OUTPUT_VARIABLE folder_arguments)
    list(JOIN source_arguments "\n" source_arguments)
    list(JOIN folder_arguments "\n" folder_arguments)
    file(GENERATE OUTPUT ${file}.arguments CONTENT "${source_arguments}\n${folder_arguments}\n")
    add_custom_command(OUTPUT ${file}
        COMMAND ${Python_EXECUTABLE} ${PROJECT_SOURCE_DIR}/fmus/build_info.py @${file}.arguments --out ${file}
        COMMAND ${CMAKE_COMMAND} -E touch ${file}
        DEPENDS ${sources} ${headers} ${file}.arguments ${PROJECT_SOURCE_DIR}/fmus/build_info.py ${PROJECT_SOURCE_DIR}/fmus/sources.py VERBATIM)
endfunction()
