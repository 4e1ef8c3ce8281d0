# SPDX-License-Identifier: BSD-3-Clause
# The target docs: pages of the public headers, by Doxygen where it is found. A warning is an error.
find_package(Doxygen QUIET)
if (NOT DOXYGEN_FOUND)
  return()
endif ()
set(smg_doxyfile "${CMAKE_BINARY_DIR}/docs/Doxyfile")
configure_file(docs/Doxyfile.in "${smg_doxyfile}" @ONLY)
add_custom_target(docs
  COMMAND Doxygen::doxygen "${smg_doxyfile}"
  COMMENT "docs/html/index.html" VERBATIM)
if (SMG_BUILD_TESTING)
  add_test(NAME Tree.docs COMMAND Doxygen::doxygen "${smg_doxyfile}")
  set_tests_properties(Tree.docs PROPERTIES LABELS lint TIMEOUT 1200)
endif ()
