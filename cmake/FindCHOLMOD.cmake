# SPDX-License-Identifier: BSD-3-Clause
# Finds CHOLMOD of SuiteSparse and defines the target CHOLMOD::CHOLMOD.

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)

if (CHOLMOD_INCLUDE_DIR)
  # cholmod_core.h defines the version; from SuiteSparse 7 on, cholmod.h.
  file(GLOB cholmod_headers
    "${CHOLMOD_INCLUDE_DIR}/cholmod.h" "${CHOLMOD_INCLUDE_DIR}/cholmod_core.h")
  set(CHOLMOD_VERSION "")
  foreach (header IN LISTS cholmod_headers)
    file(STRINGS "${header}" numbers REGEX "^#define CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION[ \t]+[0-9]+")
    list(APPEND CHOLMOD_VERSION ${numbers})
  endforeach ()
  list(TRANSFORM CHOLMOD_VERSION REPLACE "^.*[ \t]([0-9]+).*$" "\\1")
  list(JOIN CHOLMOD_VERSION "." CHOLMOD_VERSION)
endif ()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD
  REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR
  VERSION_VAR CHOLMOD_VERSION)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)

if (CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(CHOLMOD::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
endif ()
