# SPDX-License-Identifier: BSD-3-Clause
# The VTK modules StreamingMultigrid::IO and ::Filters, and their Python package
# streamingmultigrid.vtk.

vtk_module_scan(
  MODULE_FILES
    "${CMAKE_CURRENT_SOURCE_DIR}/IO/Vtk/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Filters/vtk.module"
  REQUEST_MODULES StreamingMultigrid::IO StreamingMultigrid::Filters
  PROVIDES_MODULES smg_vtk_modules
  WANT_BY_DEFAULT ON
  ENABLE_TESTS OFF)

# Like the modules of VTK, these export only symbols marked by their macros.
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

# The modules are a separate package, so that StreamingMultigrid::Solver and ::IOCore can be found
# without VTK. Their headers are installed flat beside the folder smg, like those of VTK.
vtk_module_build(
  MODULES ${smg_vtk_modules}
  PACKAGE StreamingMultigridVTK
  INSTALL_EXPORT StreamingMultigridVTK
  INSTALL_HEADERS ON
  ENABLE_WRAPPING ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/StreamingMultigrid"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/StreamingMultigrid"
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}")
unset(CMAKE_CXX_VISIBILITY_PRESET)
unset(CMAKE_VISIBILITY_INLINES_HIDDEN)

if (SMG_BUILD_PYTHON)
  # From the modules to the libraries beside lib/python3.
  list(APPEND CMAKE_INSTALL_RPATH "$ORIGIN/../../../..")
  vtk_module_wrap_python(
    MODULES ${smg_vtk_modules}
    TARGET StreamingMultigrid::wrapped_python
    PYTHON_PACKAGE streamingmultigrid.vtk
    MODULE_DESTINATION "${SMG_PYTHON_DIR}"
    CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/StreamingMultigrid"
    BUILD_STATIC OFF
    INSTALL_HEADERS OFF)
  set(smg_python_vtk "${SMG_PYTHON_DIR}/streamingmultigrid/vtk")
  configure_file(Python/streamingmultigrid/vtk/__init__.py
    "${CMAKE_BINARY_DIR}/${smg_python_vtk}/__init__.py" COPYONLY)
  install(FILES Python/streamingmultigrid/vtk/__init__.py
    DESTINATION "${smg_python_vtk}" COMPONENT python)
endif ()
