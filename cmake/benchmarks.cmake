# For the benchmarks only, built on demand: the core with other integrators; loops around the kernels, which are compiled once more without vectors.

if(EXISTS ${PROJECT_SOURCE_DIR}/benchmarks/solvers.c AND test_files)
    set(benchmarks ${PROJECT_SOURCE_DIR}/benchmarks)
    set(sundials $<TARGET_PROPERTY:core,INTERFACE_LINK_LIBRARIES>)  # not core itself: all its objects would come along

    add_library(bearing_solvers SHARED EXCLUDE_FROM_ALL $<FILTER:${core_objects},EXCLUDE,integrator\\.c> ${test_files} ${benchmarks}/solvers.c)
    target_include_directories(bearing_solvers PRIVATE ${fmu_src})
    target_compile_options(bearing_solvers PRIVATE ${core_flags})
    target_link_libraries(bearing_solvers PRIVATE ${sundials})

    # Adds the timing loops for one instruction set; options as for its kernels.
    function(add_timing isa lane_width)
        add_library(timing_${isa} OBJECT EXCLUDE_FROM_ALL ${benchmarks}/kernels.c)
        target_include_directories(timing_${isa} PRIVATE ${fmu_src})
        target_compile_definitions(timing_${isa} PRIVATE _DEFAULT_SOURCE ISA=${isa} LANE_WIDTH=${lane_width})
        target_compile_options(timing_${isa} PRIVATE ${core_flags} ${ARGN})
        set(timing_objects ${timing_objects} $<TARGET_OBJECTS:timing_${isa}> PARENT_SCOPE)
    endfunction()

    set(scalar -fno-tree-vectorize -fno-tree-slp-vectorize)
    add_kernel(scalar 1 "" ${scalar})
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
    add_library(bearing_kernels SHARED EXCLUDE_FROM_ALL ${core_objects} ${timing_objects} ${test_files} ${benchmarks}/trace.c)
    target_include_directories(bearing_kernels PRIVATE ${fmu_src})
    target_compile_options(bearing_kernels PRIVATE ${core_flags})
    target_compile_definitions(bearing_kernels PRIVATE _DEFAULT_SOURCE)
    target_link_libraries(bearing_kernels PRIVATE ${sundials})
endif()
