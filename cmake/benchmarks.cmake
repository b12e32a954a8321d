# For the benchmarks only, built on demand: the core with other integrators; loops around the kernels, which are compiled once more without vectors.

if(EXISTS ${PROJECT_SOURCE_DIR}/benchmarks/solvers.c AND TARGET bearing_test AND NOT CORE)
    set(benchmarks ${PROJECT_SOURCE_DIR}/benchmarks)

    # What solvers.c needs of SUNDIALS beyond the FMU's part.
    set(cvode_files cvode/cvode.c cvode/cvode_io.c cvode/cvode_ls.c cvode/cvode_nls.c cvode/cvode_proj.c
        sundials/sundials_dense.c sundials/sundials_linearsolver.c sundials/sundials_matrix.c sundials/sundials_nonlinearsolver.c
        sundials/sundials_nvector_senswrapper.c sunlinsol/dense/sunlinsol_dense.c sunmatrix/band/sunmatrix_band.c sunmatrix/dense/sunmatrix_dense.c
        sunnonlinsol/fixedpoint/sunnonlinsol_fixedpoint.c sunnonlinsol/newton/sunnonlinsol_newton.c)
    list(TRANSFORM cvode_files PREPEND ${sundials_source}/src/)
    add_library(sundials_cvode OBJECT EXCLUDE_FROM_ALL ${cvode_files})
    target_include_directories(sundials_cvode SYSTEM PRIVATE ${sundials_folders} ${sundials_source}/src/cvode)
    target_compile_options(sundials_cvode PRIVATE -w -ffp-contract=off -fno-math-errno -fvisibility=hidden)

    set(core_objects $<TARGET_OBJECTS:core> $<TARGET_OBJECTS:sundials> $<TARGET_OBJECTS:bearing>)
    add_library(bearing_solvers SHARED EXCLUDE_FROM_ALL
        $<FILTER:${core_objects},EXCLUDE,integrator\\.c> ${kernel_objects} $<TARGET_OBJECTS:sundials_cvode> ${test_files} ${benchmarks}/solvers.c)

    # Adds the timing loops for one instruction set; options as for its kernels.
    function(add_timing isa lane_width)
        add_library(timing_${isa} OBJECT EXCLUDE_FROM_ALL ${benchmarks}/kernel_loops.c)
        target_include_directories(timing_${isa} PRIVATE ${core_includes})
        target_compile_definitions(timing_${isa} PRIVATE _DEFAULT_SOURCE ISA=${isa} LANE_WIDTH=${lane_width})
        target_compile_options(timing_${isa} PRIVATE ${core_flags} ${ARGN})
        set(timing_objects ${timing_objects} $<TARGET_OBJECTS:timing_${isa}> PARENT_SCOPE)
    endfunction()

    set(scalar -fno-tree-vectorize -fno-tree-slp-vectorize)
    add_kernel(scalar 1 ${scalar})
    set_target_properties(kernel_scalar PROPERTIES EXCLUDE_FROM_ALL ON)
    add_timing(scalar 1 ${scalar})
    if(TARGET kernel_avx512)
        add_timing(sse2 2)
        add_timing(avx2 4 -mavx2)
        add_timing(avx512 8 -mavx512f -mavx512dq -mavx512vl -mprefer-vector-width=512)
    elseif(TARGET kernel_neon)
        add_timing(neon 2)
    else()
        add_timing(generic 2)
    endif()
    add_library(bearing_kernels SHARED EXCLUDE_FROM_ALL ${core_objects} ${kernel_objects} ${timing_objects} ${test_files} ${benchmarks}/trace.c)

    foreach(library IN ITEMS bearing_solvers bearing_kernels)
        target_include_directories(${library} PRIVATE ${core_includes})
        target_include_directories(${library} SYSTEM PRIVATE ${sundials_folders})
        target_compile_definitions(${library} PRIVATE _DEFAULT_SOURCE)
        target_compile_options(${library} PRIVATE ${core_flags})
        target_link_libraries(${library} PRIVATE m)  # not core: all its objects would come along
        target_link_options(${library} PRIVATE -Wl,--no-undefined)
    endforeach()
endif()
