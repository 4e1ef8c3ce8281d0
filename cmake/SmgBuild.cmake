# SPDX-License-Identifier: BSD-3-Clause
# Build types, languages, warnings, sanitizers, output folders.

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug or RelWithDebInfo" FORCE)
endif ()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_SCAN_FOR_MODULES OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(BUILD_SHARED_LIBS ON)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
# The folder below /usr that Python on Debian searches, independent of the library folder.
set(SMG_PYTHON_DIR "lib/python3/dist-packages")

# What was compiled before, in this folder or in another clone, is taken from the cache of ccache: paths
# inside the tree are made relative, also those of __FILE__ and of the debug information.
find_program(SMG_CCACHE ccache DOC "ccache; empty: every source is compiled")
if (SMG_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros "${SMG_CCACHE}")
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif ()
add_compile_options("-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=")

# Programs of tests link the libraries statically: LLD takes a fraction of the time.
find_program(SMG_LLD ld.lld DOC "LLD; empty: the linker of the compiler")
if (SMG_LLD AND SMG_BUILD_TESTING)
  add_link_options(-fuse-ld=lld)
  if (CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # Of two functions at one address, one of them the empty rarely executed part of a function, LLD 14
    # lists the wrong one for exceptions: those that pass through the other one abort the program.
    add_compile_options(-fno-reorder-blocks-and-partition)
  endif ()
endif ()

add_compile_options(-Wall -Wextra)
if (CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 reports false overlaps and uninitialised parts inside std::string (GCC bugs 105329, 105593).
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>
    $<$<COMPILE_LANGUAGE:CXX>:-Wno-maybe-uninitialized>)
endif ()
if (CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Unity builds include sources in others, where types in unnamed namespaces cause this warning.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif ()
if (SMG_SANITIZE)
  add_compile_options(-fsanitize=${SMG_SANITIZE} -fno-omit-frame-pointer)
  # Under sanitizers Eigen allocates vectors in a way of its own: a program must not mix both.
  add_compile_definitions(EIGEN_DONT_VECTORIZE)
  add_link_options(-fsanitize=${SMG_SANITIZE})
  if (SMG_SANITIZE MATCHES undefined)
    # Without what AddressSanitizer finds as well: access through null pointers and beyond objects, use
    # of objects that are gone, pointers far outside. The tree casts no base class to a derived one,
    # which is the rest of vptr.
    add_compile_options(
      -fno-sanitize-recover=undefined -fno-sanitize=null,object-size,pointer-overflow,vptr)
  endif ()
endif ()

# -ffp-contract=off: kernels round identically on all machines, so that results are bit-identical.
# -Wno-psabi: vectors are passed between inline functions only.
set(smg_kernel_options -ffp-contract=off -Wno-psabi)

# Inside the tree, headers are included by their path from the top.
include_directories("${PROJECT_SOURCE_DIR}")

# Exports only symbols marked SMG_EXPORT.
function (smg_hide_symbols target)
  set_target_properties(${target} PROPERTIES
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    POSITION_INDEPENDENT_CODE ON)
endfunction ()

# smg_library(<target> <name> <public headers> OBJECTS <target> [STATIC_OBJECTS <target>]
#   DEPENDENCIES <target>... [PUBLIC <target>...] [EXPORT <set>])
# The shared library StreamingMultigrid::<name>, and <target>Static of the same objects, or of
# STATIC_OBJECTS, for tests and benchmarks, which use hidden symbols.
function (smg_library target name headers)
  cmake_parse_arguments(PARSE_ARGV 3 arg "" "OBJECTS;STATIC_OBJECTS;EXPORT" "DEPENDENCIES;PUBLIC")
  if (NOT arg_STATIC_OBJECTS)
    set(arg_STATIC_OBJECTS ${arg_OBJECTS})
  endif ()
  if (NOT arg_EXPORT)
    set(arg_EXPORT StreamingMultigrid)
  endif ()
  add_library(${target} SHARED $<TARGET_OBJECTS:${arg_OBJECTS}>)
  add_library(StreamingMultigrid::${name} ALIAS ${target})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${headers}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/StreamingMultigrid>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_DEPENDENCIES})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR})
  install(TARGETS ${target} EXPORT ${arg_EXPORT}
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
      COMPONENT libraries NAMELINK_COMPONENT development
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT libraries)

  add_library(${target}Static STATIC EXCLUDE_FROM_ALL $<TARGET_OBJECTS:${arg_STATIC_OBJECTS}>)
  set_target_properties(${target}Static PROPERTIES LINKER_LANGUAGE CXX)
  target_include_directories(${target}Static INTERFACE "${headers}")
  target_link_libraries(${target}Static INTERFACE ${arg_DEPENDENCIES})
  # Templates of the library, Eigen's included, are compiled in its way, whichever copy is linked.
  target_compile_definitions(${target}Static INTERFACE EIGEN_DONT_VECTORIZE)
  target_compile_options(${target}Static INTERFACE ${smg_kernel_options})
  # A library that is loaded when it is needed is looked for on the path of the program.
  target_link_options(${target}Static INTERFACE "-Wl,-rpath,${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
endfunction ()
