# SPDX-License-Identifier: BSD-3-Clause
# Debian packages, made by cpack:
#   streaming-multigrid           the libraries without VTK, and smg
#   streaming-multigrid-dev       headers and the CMake package
#   python3-streaming-multigrid   the Python package, without its part vtk
#   paraview-streaming-multigrid  the ParaView plugin, its VTK libraries and streamingmultigrid.vtk

set(plugin_folder "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}")
set(plugin "${plugin_folder}/StreamingMultigrid/StreamingMultigrid.so")
set(shared_plugins "/usr/share/paraview/plugins")
set(paraview_conf "/usr/${plugin_folder}/../paraview.conf")
set(generated "${CMAKE_CURRENT_BINARY_DIR}/packages")
file(MAKE_DIRECTORY "${generated}")
set(has_shared_plugins)
if (EXISTS "${paraview_conf}")
  file(STRINGS "${paraview_conf}" has_shared_plugins REGEX "^${shared_plugins}$")
endif ()
if (has_shared_plugins)
  # ParaView lists the plugins of this folder by name.
  file(CREATE_LINK "/usr/${plugin}" "${generated}/StreamingMultigrid.so" SYMBOLIC)
  install(FILES "${generated}/StreamingMultigrid.so"
    DESTINATION "${shared_plugins}" COMPONENT paraview_plugins)
else ()
  # ParaView on Debian 12 reads lists of plugins from this file, which its package does not contain.
  file(WRITE "${generated}/paraview.conf"
    "../${plugin_folder}/paraview.plugins.xml\n../${plugin_folder}/streamingmultigrid.plugins.xml\n")
  install(FILES "${generated}/paraview.conf"
    DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT paraview_plugins)
endif ()

foreach (pair libraries:streaming-multigrid development:streaming-multigrid-dev
    python_package:python3-streaming-multigrid paraview_plugins:paraview-streaming-multigrid)
  string(REPLACE ":" ";" pair "${pair}")
  list(GET pair 0 component)
  list(GET pair 1 package)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" RENAME copyright COMPONENT ${component})
endforeach ()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME streaming-multigrid)
set(CPACK_PACKAGE_CONTACT "The Streaming Multigrid developers <streaming-multigrid@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
# The install rules of ParaView assign no component to the plugin.
set(plugin_components runtime paraview_plugins python Unspecified)
set(CPACK_COMPONENTS_ALL libraries development python_package ${plugin_components})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)

set(version "(= ${PROJECT_VERSION})")
math(EXPR next_minor "${ParaView_VERSION_MINOR} + 1")
string(CONCAT paraview
  "paraview (>= ${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}), "
  "paraview (<< ${ParaView_VERSION_MAJOR}.${next_minor}~), python3-paraview")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME streaming-multigrid)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_RECOMMENDS paraview-streaming-multigrid)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME streaming-multigrid-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
string(CONCAT CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "streaming-multigrid ${version}, paraview-streaming-multigrid ${version}, "
  "paraview-dev, libopenmpi-dev, libpython3-dev")
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_NAME python3-streaming-multigrid)
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_DEPENDS
  "streaming-multigrid ${version}, python3 (>= 3.9), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_PACKAGE_SUGGESTS
  "python3-scipy, paraview-streaming-multigrid")
set(CPACK_DEBIAN_PLUGIN_PACKAGE_NAME paraview-streaming-multigrid)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_DEPENDS "streaming-multigrid ${version}, ${paraview}")
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Libraries without VTK, and the program smg")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers and the CMake package")
set(CPACK_COMPONENT_PYTHON_PACKAGE_DESCRIPTION "Python package over NumPy, without VTK")
set(CPACK_COMPONENT_GROUP_PLUGIN_DESCRIPTION "ParaView plugin, VTK libraries, Python package")

include(CPack)
cpack_add_component_group(libraries)
cpack_add_component_group(development)
cpack_add_component_group(python_package)
cpack_add_component_group(plugin)
cpack_add_component(libraries GROUP libraries)
cpack_add_component(development GROUP development)
cpack_add_component(python_package GROUP python_package)
foreach (component IN LISTS plugin_components)
  cpack_add_component(${component} GROUP plugin)
endforeach ()
