# SPDX-License-Identifier: BSD-3-Clause
# Functions that add tests. Limits of time are about ten times the usual time, and far below that of continuous
# integration: what hangs is ended and named, and no test fails because a machine is slow or busy. Labels:
#   unit, vtk, paraview, install         what the test needs or checks
#   benchmark                            runs a benchmark on a tiny mesh, whatever the time it takes
#   lint                                 judges the source: for developers and continuous integration
#   data                                 needs SMG_TEST_DATA_DIR; skipped if that is empty
#   law                                  scaling of errors, rates or memory with the size of the mesh:
#                                        larger meshes, without additional coverage for sanitizers
#   nightly                              takes long and seldom fails: not in the configuration main
#   long                                 takes minutes: excluded by `ctest -LE long`

# The folder with the meshes of the archive, for either level of SMG_TEST_DATA_DIR.
set(smg_test_data "${SMG_TEST_DATA_DIR}")
if (smg_test_data AND EXISTS "${smg_test_data}/meshes")
  set(smg_test_data "${smg_test_data}/meshes")
endif ()

# Programs of several processes. OpenMPI refuses root, and more processes than cores, unless it is told
# otherwise; processes that wait give way to others.
find_program(SMG_MPIEXEC NAMES mpiexec mpirun)
set(smg_mpi_environment
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1)

# smg_on_processes(<variable> <processes> <command>...)
# The command on several processes; without mpiexec one that says that the test is skipped.
function (smg_on_processes variable processes)
  set(command ${CMAKE_COMMAND} -E echo "SKIPPED: mpiexec is not installed")
  if (SMG_MPIEXEC)
    set(command ${SMG_MPIEXEC} -n ${processes} ${ARGN})
  endif ()
  set(${variable} ${command} PARENT_SCOPE)
endfunction ()

# smg_share_of_processors(<variable> <processes>)
# Processes of one program wait for each other for most of their time: two of them leave room for another test.
function (smg_share_of_processors variable processes)
  set(share 1)
  if (processes GREATER 1)
    set(share 2)
  endif ()
  set(${variable} ${share} PARENT_SCOPE)
endfunction ()

# smg_add_processes_test(<program> LABELS <label>... PROCESSES <number>...)
# Adds runs of a GoogleTest program on several processes, one for each number of them.
function (smg_add_processes_test program)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LABELS;PROCESSES")
  foreach (processes IN LISTS arg_PROCESSES)
    set(name ${program}.on${processes})
    smg_share_of_processors(share ${processes})
    smg_on_processes(command ${processes} $<TARGET_FILE:${program}>)
    add_test(NAME ${name} COMMAND ${command})
    set_tests_properties(${name} PROPERTIES
      ENVIRONMENT "${smg_mpi_environment}"
      PROCESSORS ${share}
      LABELS "${arg_LABELS}"
      SKIP_REGULAR_EXPRESSION "SKIPPED:"
      TIMEOUT 900)
  endforeach ()
endfunction ()

# Alignment is checked in the libraries: in tests it would take a fifth of the time of compilation,
# and optimization half of it.
set(smg_test_options)
set(smg_test_optimization $<$<CONFIG:Release>:-O1>)
set(smg_suite_timeout 600)
if (SMG_SANITIZE)
  set(smg_suite_timeout 1800)
endif ()
if (SMG_SANITIZE MATCHES undefined)
  set(smg_test_options -fno-sanitize=alignment)
  set(smg_test_optimization -O0)
endif ()

# smg_add_gtest(<name> LABELS <label>... SOURCES <file>... LIBRARIES <target>...)
# One GoogleTest program, and a test for each of its suites. Those whose name ends in Data get the label data,
# those whose name ends in Law the label law, and those whose name ends in Long the label long.
function (smg_add_gtest name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LABELS;SOURCES;LIBRARIES")
  add_executable(${name} ${arg_SOURCES} "${PROJECT_SOURCE_DIR}/Testing/Support/TestMain.cpp")
  target_link_libraries(${name} PRIVATE smgTesting ${arg_LIBRARIES} GTest::gtest)
  # Names in more sources than these need not differ.
  set_target_properties(${name} PROPERTIES UNITY_BUILD_BATCH_SIZE 12)
  # Tests are compiled more often than they run; the libraries are optimized as they are used.
  target_compile_options(${name} PRIVATE ${smg_test_optimization} ${smg_test_options})

  list(TRANSFORM arg_SOURCES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/"
    REGEX "^[^/]" OUTPUT_VARIABLE sources)
  set(suites "${CMAKE_CURRENT_BINARY_DIR}/${name}-suites.cmake")
  file(GENERATE OUTPUT "${suites}" CONTENT "set(smg_program \"$<TARGET_FILE:${name}>\")
set(smg_sources \"${sources}\")
set(smg_labels \"${arg_LABELS}\")
set(smg_timeout ${smg_suite_timeout})
set(smg_has_data \"${smg_test_data}\")
include(\"${PROJECT_SOURCE_DIR}/cmake/SmgTestSuites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${suites}")
endfunction ()

# Finds pvpython, pvbatch and xvfb-run once: ParaView cannot render without an X server.
function (smg_find_paraview_programs)
  find_program(SMG_PVPYTHON pvpython REQUIRED)
  find_program(SMG_PVBATCH pvbatch REQUIRED)
  find_program(SMG_PVSERVER pvserver REQUIRED)
  find_program(SMG_XVFB_RUN xvfb-run REQUIRED)
endfunction ()

# smg_choose_display(<variable>)
# The number of a display of its own for each test: two xvfb-run that look for a free one from the same
# number on, at the same time, may choose the same.
function (smg_choose_display variable)
  get_property(display GLOBAL PROPERTY smg_displays)
  if (NOT display)
    set(display 100)
  endif ()
  math(EXPR next "${display} + 1")
  set_property(GLOBAL PROPERTY smg_displays ${next})
  set(${variable} ${display} PARENT_SCOPE)
endfunction ()

# smg_on_screen(<variable> <command>...)
# The command under an X server of its own. Without -noreset the server resets when the first client
# disconnects, and may reject a second one.
function (smg_on_screen variable)
  smg_choose_display(display)
  set(${variable} ${SMG_XVFB_RUN} -a -n ${display} -s "-screen 0 1280x1024x24 -noreset" ${ARGN} PARENT_SCOPE)
endfunction ()

# smg_add_paraview_test(<name> COMMAND <command>... [TIMEOUT <seconds>] [LABELS <label>...])
# A test under its own X server, with the plugin and the wrapped classes on the paths; it also fails
# on a Python traceback or a VTK error.
function (smg_add_paraview_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "COMMAND;LABELS")
  if (NOT arg_TIMEOUT)
    set(arg_TIMEOUT 900)
  endif ()
  smg_on_screen(command ${arg_COMMAND})
  add_test(NAME ${name} COMMAND ${command})
  set_tests_properties(${name} PROPERTIES
    TIMEOUT ${arg_TIMEOUT}
    LABELS "paraview;${arg_LABELS}"
    SKIP_REGULAR_EXPRESSION "SKIPPED:"
    FAIL_REGULAR_EXPRESSION "Traceback;ERR\\|;FATL\\|;Segmentation"
    ENVIRONMENT "SMG_TEST_DATA_DIR=${smg_test_data};SMG_SOURCE_DIR=${PROJECT_SOURCE_DIR};SMG_PROGRAM=$<$<TARGET_EXISTS:smg>:$<TARGET_FILE:smg>>;PYTHONPATH=${CMAKE_BINARY_DIR}/${SMG_PYTHON_DIR};${smg_mpi_environment}")
endfunction ()

# smg_add_pvpython_test(<name> <script> [ARGS <argument>...] [TIMEOUT <seconds>] [LABELS <label>...])
function (smg_add_pvpython_test name script)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "TIMEOUT" "ARGS;LABELS")
  smg_add_paraview_test(${name} TIMEOUT "${arg_TIMEOUT}" LABELS ${arg_LABELS}
    COMMAND ${SMG_PVPYTHON} "${CMAKE_CURRENT_SOURCE_DIR}/${script}" ${arg_ARGS})
endfunction ()

# smg_add_pvbatch_test(<name> <script> RANKS <n> [ARGS ...] [TIMEOUT <seconds>] [LABELS ...])
# The script runs on every rank (--sym).
function (smg_add_pvbatch_test name script)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "TIMEOUT;RANKS" "ARGS;LABELS")
  smg_on_processes(command ${arg_RANKS}
    ${SMG_PVBATCH} --sym "${CMAKE_CURRENT_SOURCE_DIR}/${script}" ${arg_ARGS})
  smg_add_paraview_test(${name} TIMEOUT "${arg_TIMEOUT}" LABELS ${arg_LABELS} COMMAND ${command})
  smg_share_of_processors(share ${arg_RANKS})
  set_tests_properties(${name} PROPERTIES PROCESSORS ${share})
endfunction ()
