# SPDX-License-Identifier: BSD-3-Clause
# IO without VTK: formats, conversion. The folder Vtk is the VTK module StreamingMultigrid::IO.
file(GLOB_RECURSE smg_iocore_sources CONFIGURE_DEPENDS IO/*.cpp)
set(smg_hdf5_sources ${smg_iocore_sources})
list(FILTER smg_hdf5_sources INCLUDE REGEX "/VtkHdf/Hdf5/")
list(REMOVE_ITEM smg_iocore_sources ${smg_hdf5_sources})

add_library(smgIOCoreObjects OBJECT ${smg_iocore_sources})
set(smg_iocore_dependencies nlohmann_json::nlohmann_json
  Eigen3::Eigen FastFloat::fast_float PkgConfig::SMG_COMPRESSION ZLIB::ZLIB LibLZMA::LibLZMA Threads::Threads ${CMAKE_DL_LIBS})
target_compile_definitions(smgIOCoreObjects PRIVATE
  SMG_VTKHDF_LIBRARY="libsmgVtkHdf.so.${PROJECT_VERSION_MAJOR}")
target_include_directories(smgIOCoreObjects PUBLIC
  "${PROJECT_SOURCE_DIR}/Solver/include" "${PROJECT_SOURCE_DIR}/IO/include")
target_link_libraries(smgIOCoreObjects PRIVATE ${smg_iocore_dependencies})
smg_hide_symbols(smgIOCoreObjects)
smg_library(smgIOCore IOCore "${PROJECT_SOURCE_DIR}/IO/include"
  OBJECTS smgIOCoreObjects DEPENDENCIES ${smg_iocore_dependencies} PUBLIC StreamingMultigrid::Solver)
target_link_libraries(smgIOCoreStatic INTERFACE smgSolverStatic)

# Loaded by the other one when it is needed.
# The sanitizers' dlopen() does not look where that one says: their presets name the folder.
add_library(smgVtkHdfObjects OBJECT ${smg_hdf5_sources})
target_include_directories(smgVtkHdfObjects PUBLIC
  "${PROJECT_SOURCE_DIR}/Solver/include" "${PROJECT_SOURCE_DIR}/IO/include")
target_link_libraries(smgVtkHdfObjects PUBLIC PkgConfig::SMG_HDF5)
smg_hide_symbols(smgVtkHdfObjects)
add_library(smgVtkHdf SHARED $<TARGET_OBJECTS:smgVtkHdfObjects>)
set_target_properties(smgVtkHdf PROPERTIES
  LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
target_link_libraries(smgVtkHdf PUBLIC smgIOCore PRIVATE PkgConfig::SMG_HDF5)
install(TARGETS smgVtkHdf
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT libraries NAMELINK_SKIP)
