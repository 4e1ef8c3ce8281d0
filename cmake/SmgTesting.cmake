# SPDX-License-Identifier: BSD-3-Clause
# Functions that add tests. Limits of time are at least ten times the usual time: they end what hangs,
# and no test fails because a machine is slow or busy. Labels:
#   unit, vtk, paraview, install         what the test needs or checks
#   benchmark                            runs a benchmark on a tiny mesh, whatever the time it takes
#   lint                                 judges the source: for developers and continuous integration
#   data                                 needs SMG_TEST_DATA_DIR; skipped if that is empty
#   law                                  scaling of errors, rates or memory with the size of the mesh:
#                                        larger meshes, without additional coverage for sanitizers
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

# smg_add_processes_test(<program> LABELS <label>... PROCESSES <number>...)
# Adds runs of a GoogleTest program on several processes, one for each number of them.
function (smg_add_processes_test program)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LABELS;PROCESSES")
  foreach (processes IN LISTS arg_PROCESSES)
    set(name ${program}.on${processes})
    smg_on_processes(command ${processes} $<TARGET_FILE:${program}>)
    add_test(NAME ${name} COMMAND ${command})
    set_tests_properties(${name} PROPERTIES
      ENVIRONMENT "${smg_mpi_environment}"
      PROCESSORS ${processes}
      LABELS "${arg_LABELS}"
      SKIP_REGULAR_EXPRESSION "SKIPPED:"
      TIMEOUT 9000)
  endforeach ()
endfunction ()

# Alignment is checked in the libraries: in tests it would take a fifth of the time of compilation,
# and optimization half of it.
set(smg_test_options)
set(smg_test_optimization $<$<CONFIG:Release>:-O1>)
if (SMG_SANITIZE MATCHES undefined)
  set(smg_test_options -fno-sanitize=alignment)
  set(smg_test_optimization -O0)
endif ()

# smg_add_gtest(<name> LABELS <label>... SOURCES <file>... LIBRARIES <target>...)
# One GoogleTest program. Suites whose name ends in Data get the label data and more time, those
# whose name ends in Law the label law, and those whose name ends in Long the label long.
function (smg_add_gtest name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LABELS;SOURCES;LIBRARIES")
  add_executable(${name} ${arg_SOURCES} "${PROJECT_SOURCE_DIR}/Testing/Support/TestMain.cpp")
  target_link_libraries(${name} PRIVATE smgTesting ${arg_LIBRARIES} GTest::gtest)
  # Names in more sources than these need not differ.
  set_target_properties(${name} PROPERTIES UNITY_BUILD_BATCH_SIZE 12)
  # Tests are compiled more often than they run; the libraries are optimized as they are used.
  target_compile_options(${name} PRIVATE ${smg_test_optimization} ${smg_test_options})
  if (SMG_SANITIZE)
    smg_add_shards(${name} "${arg_LABELS}")
  else ()
    smg_discover(${name} "-*Data.*:*Law.*:*Long.*" 1200 "${arg_LABELS}")
  endif ()
  smg_discover(${name} "*Law.*" 1200 "${arg_LABELS};law")
  smg_discover(${name} "*Data.*" 3000 "${arg_LABELS};data")
  smg_discover(${name} "*Long.*" 3600 "${arg_LABELS};data;long")
endfunction ()

# The quick tests of a program in eight runs: with sanitizers, the start of a program takes as long
# as many a test.
function (smg_add_shards name labels)
  foreach (shard RANGE 7)
    add_test(NAME ${name}.shard${shard}
      COMMAND ${name} "--gtest_filter=-*Data.*:*Law.*:*Long.*" --gtest_brief=1)
    set_tests_properties(${name}.shard${shard} PROPERTIES
      ENVIRONMENT "GTEST_TOTAL_SHARDS=8;GTEST_SHARD_INDEX=${shard}"
      LABELS "${labels}"
      TIMEOUT 9000)
  endforeach ()
endfunction ()

function (smg_discover name filter timeout labels)
  string(MAKE_C_IDENTIFIER "${name}_${labels}" list)
  gtest_discover_tests(${name}
    TEST_PREFIX "${name}."
    TEST_FILTER "${filter}"
    TEST_LIST ${list}
    DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 600
    PROPERTIES TIMEOUT ${timeout})
  # gtest_discover_tests splits a list of labels: they are set in a file that ctest includes.
  set(file "${CMAKE_CURRENT_BINARY_DIR}/${list}.cmake")
  file(WRITE "${file}" "foreach (test IN LISTS ${list})
  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${labels}\")
endforeach ()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${file}")
endfunction ()

# Finds pvpython, pvbatch and xvfb-run once: ParaView cannot render without an X server.
function (smg_find_paraview_programs)
  find_program(SMG_PVPYTHON pvpython REQUIRED)
  find_program(SMG_PVBATCH pvbatch REQUIRED)
  find_program(SMG_PVSERVER pvserver REQUIRED)
  find_program(SMG_XVFB_RUN xvfb-run REQUIRED)
  # Without -noreset the server resets when the first client disconnects, and may reject a second
  # one.
  set(smg_on_screen ${SMG_XVFB_RUN} -a -s "-screen 0 1280x1024x24 -noreset" PARENT_SCOPE)
endfunction ()

# smg_add_paraview_test(<name> COMMAND <command>... [TIMEOUT <seconds>] [LABELS <label>...])
# A test under its own X server, with the plugin and the wrapped classes on the paths; it also fails
# on a Python traceback or a VTK error.
function (smg_add_paraview_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "COMMAND;LABELS")
  if (NOT arg_TIMEOUT)
    set(arg_TIMEOUT 2400)
  endif ()
  add_test(NAME ${name} COMMAND ${smg_on_screen} ${arg_COMMAND})
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
  set_tests_properties(${name} PROPERTIES PROCESSORS ${arg_RANKS})
endfunction ()
