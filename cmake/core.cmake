# The core: physics and integrator.  The archive goes into the FMU and, the same one, into the tests' library; it depends on the number of balls and the room
# for modes, not on anything else of a bearing.  Target bearing has the rest: variables.c with the start values, and the rivet table.
#
#   CORE         archive of the compiled core to link (core.a of another build folder with as many balls and modes), empty: compile it here
#   PRECOMPILE   the header of the vector instructions is read once for each set, not for each file; ccache would not keep these files

include(CheckCCompilerFlag)

# Files that work on packets of balls: compiled once for each instruction set, chosen at run time.
set(kernel_files
    physics/rhs.c physics/ball.c physics/race_contact.c physics/drag.c physics/land_film.c physics/land_bent.c physics/ring.c
    cage/cage.c cage/common/halves.c cage/common/halves_step.c cage/common/pocket.c cage/common/pocket_spheres.c cage/common/cage_joint.c cage/common/joint_slip.c
    cage/common/rigid_approach.c cage/common/pocket_films.c
    cage/two_half/two_half.c cage/two_half/half_path.c cage/two_half/joint_open.c
    cage/elastic/cage_elastic.c cage/elastic/cage_substeps.c cage/elastic/wall_loads.c cage/elastic/elastic_wall.c cage/elastic/elastic_lands.c
    cage/elastic/elastic_step.c cage/elastic/rim_films.c
    rivet/rivet_rom.c
    solver/implicit.c solver/verlet.c solver/kernels.c)

set(warnings -Wall -Wextra -Wpedantic)
set(arithmetic -ffp-contract=off -fno-math-errno -fno-trapping-math)  # IEEE results, the same ones on every instruction set
set(core_flags ${warnings} ${arithmetic})
if(CMAKE_CROSSCOMPILING)
    list(APPEND core_flags -fvisibility=hidden)
else()
    # Default visibility lets the tests call each element; without interposition calls are as direct as among hidden symbols, and the FMU exports fmi2* only.
    list(APPEND core_flags -Werror)
    check_c_compiler_flag("-Werror -fno-semantic-interposition" no_interposition)
    if(no_interposition)
        list(APPEND core_flags -fno-semantic-interposition)
    endif()
endif()
if(ANALYZE)
    # Two of its checks misread this code: a lane is taken for one bit, and a loop of three may end after one turn (valgrind sees what is not set).
    list(APPEND core_flags -fanalyzer -Wno-analyzer-shift-count-overflow -Wno-analyzer-use-of-uninitialized-value)
endif()
if(NOT SANITIZE)
    # Without superword vectorisation: GCC 12's fuses a b - c d and a b + c d into one vfmaddsub in spite of -ffp-contract=off.
    list(APPEND core_flags -O3 -fno-tree-slp-vectorize)
endif()

set(kernel_flags ${core_flags})
list(APPEND core_flags ${old_glibc})  # the kernels call no function of these, and their precompiled header must be the first

set(fmu_src ${PROJECT_SOURCE_DIR}/fmu_src)
set(generated ${fmu_src}/generated)  # folder of variables.h, variables.c and limits.c
if(GENERATED_DIR)
    set(generated ${GENERATED_DIR})
endif()
set(core_includes ${fmu_src} ${generated})

set(rivet_table ${PROJECT_BINARY_DIR}/rivet_table.c)
if(GENERATED_DIR AND EXISTS ${GENERATED_DIR}/rivet_table.c)
    set(rivet_table ${GENERATED_DIR}/rivet_table.c)
else()
    file(GLOB embed_sources CONFIGURE_DEPENDS ${rivet_model_dir}/*.py ${bearing_model_dir}/rivet/*.py
        ${bearing_model_dir}/cage/*/joint_law.py ${bearing_model_dir}/cage/*/half_*.py)
    add_custom_command(OUTPUT ${rivet_table}
        COMMAND ${Python_EXECUTABLE} -m rivet_model.embed ${RIVET_TABLE} ${rivet_table}
        DEPENDS ${RIVET_TABLE} ${embed_sources} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()

list(TRANSFORM kernel_files PREPEND ${fmu_src}/)
file(GLOB_RECURSE core_files CONFIGURE_DEPENDS ${fmu_src}/*.c)
list(FILTER core_files EXCLUDE REGEX /generated/)
file(GLOB wrapper_files CONFIGURE_DEPENDS ${fmu_src}/host/fmi2_*.c)
list(REMOVE_ITEM core_files ${kernel_files} ${wrapper_files})
list(APPEND core_files ${generated}/limits.c)
set(bearing_files ${generated}/variables.c ${rivet_table})

add_library(bearing OBJECT ${bearing_files})
target_include_directories(bearing PRIVATE ${core_includes})
target_compile_options(bearing PRIVATE ${core_flags})

set(CORE "" CACHE FILEPATH "Archive of the compiled core")
option(PRECOMPILE "Precompile the header of the vector instructions" OFF)
if(CORE)
    add_library(core STATIC IMPORTED)
    set_target_properties(core PROPERTIES IMPORTED_LOCATION ${CORE})
else()
    add_library(core STATIC ${core_files} $<TARGET_OBJECTS:sundials>)
    set_target_properties(core PROPERTIES PREFIX "" SUFFIX .a)
    target_include_directories(core SYSTEM PRIVATE ${sundials_folders})
    target_include_directories(core PRIVATE ${core_includes})
    target_compile_options(core PRIVATE ${core_flags})
endif()
target_include_directories(core INTERFACE ${core_includes})
target_link_libraries(core INTERFACE m)

file(GLOB test_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/test_library.c ${PROJECT_SOURCE_DIR}/tests/jacobian_products.c)
file(GLOB elementary_test CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/test_elementary.c)

# An object library of these files, compiled for one instruction set.
function(compile_for target isa lane_width files)
    add_library(${target} OBJECT EXCLUDE_FROM_ALL ${files})
    target_include_directories(${target} SYSTEM PRIVATE ${sundials_folders})
    target_include_directories(${target} PRIVATE ${core_includes})
    target_compile_definitions(${target} PRIVATE ISA=${isa} LANE_WIDTH=${lane_width})
    target_compile_options(${target} PRIVATE ${kernel_flags} ${ARGN})
endfunction()

# Adds the kernel files, compiled for one instruction set, and their elementary functions for the tests.
function(add_kernel isa lane_width)
    if(NOT CORE)
        compile_for(kernel_${isa} ${isa} ${lane_width} "${kernel_files}" ${ARGN})
        if(PRECOMPILE AND lane_width GREATER 2 AND CMAKE_C_COMPILER_ID STREQUAL "GNU")
            target_precompile_headers(kernel_${isa} PRIVATE <immintrin.h>)
        endif()
        set(kernel_objects ${kernel_objects} $<TARGET_OBJECTS:kernel_${isa}> PARENT_SCOPE)
    endif()
    if(elementary_test AND NOT CMAKE_CROSSCOMPILING)
        compile_for(elementary_${isa} ${isa} ${lane_width} ${elementary_test} ${ARGN})
        set(test_objects ${test_objects} $<TARGET_OBJECTS:elementary_${isa}> PARENT_SCOPE)
    endif()
endfunction()

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    add_kernel(sse2 2)
    add_kernel(avx2 4 -mavx2 -mfma -mtune=znver3 -DFUSED)  # what dispatch.c asks the processor for, no more
    if(NOT CMAKE_CROSSCOMPILING AND NOT CORE)
        # AVX-512's packets of eight, computed by AVX2: for the tests (cmake/fmu.cmake), where no processor has AVX-512.
        set(by_fours -mavx2 -mfma -DFUSED -DEIGHT_BY_FOURS -Wno-psabi -O1)  # -O3 takes minutes
        compile_for(kernel_by_fours avx512 8 "${kernel_files}" ${by_fours})
        compile_for(dispatch_by_fours generic 2 ${fmu_src}/solver/dispatch.c -DKERNELS_X86 -DEIGHT_BY_FOURS)
    endif()
    add_kernel(avx512 8 -mavx512f -mavx512dq -mavx512vl -mfma -mprefer-vector-width=512 -mtune=znver3 -DFUSED)
    set(kernels KERNELS_X86)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
    add_kernel(neon 2 -DFUSED)
    set(kernels KERNELS_NEON)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "wasm32")
    add_kernel(generic 2 -msimd128)
else()
    add_kernel(generic 2)
endif()
if(NOT CORE)
    target_sources(core PRIVATE ${kernel_objects})
    target_compile_definitions(core PRIVATE ${kernels})
endif()

# And once in dual numbers: derivatives.  Complex products need no care for infinities here.  At -O3 the file takes 13 s instead of 4, for a directional
# derivative in 35 us instead of 40.
set(dual_flags -O1)
check_c_compiler_flag("-Werror -fcx-limited-range" limited_range)
if(limited_range)
    list(APPEND dual_flags -fcx-limited-range)
endif()
set_source_files_properties(${fmu_src}/instance/jacobian.c PROPERTIES COMPILE_OPTIONS "${dual_flags}")

# For the tests only: each element's functions, callable from Python.
if(test_files AND NOT CMAKE_CROSSCOMPILING)
    if(NOT TARGET elementary_generic)  # those of the core
        compile_for(elementary_generic generic 2 ${elementary_test})
        list(APPEND test_objects $<TARGET_OBJECTS:elementary_generic>)
    endif()
    add_library(bearing_test SHARED $<TARGET_OBJECTS:bearing> ${test_files} ${test_objects})
    target_compile_options(bearing_test PRIVATE ${core_flags})
    target_link_libraries(bearing_test PRIVATE $<LINK_LIBRARY:WHOLE_ARCHIVE,core>)
endif()
