# Folders of Python packages: FMI headers come with fmpy, the rivet tables with rivet_model, their reader with bearing_model.

function(find_python_package name result)
    execute_process(
        COMMAND ${Python_EXECUTABLE} -c "import importlib.util; print(importlib.util.find_spec('${name}').submodule_search_locations[0])"
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
        OUTPUT_VARIABLE folder ERROR_VARIABLE error RESULT_VARIABLE status OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(status)
        message(FATAL_ERROR "${Python_EXECUTABLE} has no package ${name}: `make build` or `pip install .` install it\n${error}")
    endif()
    set(${result} ${folder} PARENT_SCOPE)
endfunction()

find_python_package(fmpy fmpy_dir)
find_python_package(bearing_model bearing_model_dir)
find_python_package(rivet_model rivet_model_dir)
if(NOT RIVET_TABLE)
    set(RIVET_TABLE ${rivet_model_dir}/tables/6207.json)
endif()
