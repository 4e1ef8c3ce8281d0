# SPDX-License-Identifier: BSD-3-Clause
# IO without VTK: formats, conversion. The vtk* files of this folder belong to the VTK module
# StreamingMultigrid::IO.
file(GLOB_RECURSE smg_iocore_sources CONFIGURE_DEPENDS IO/*.cpp)
set(smg_hdf5_sources ${smg_iocore_sources})
list(FILTER smg_hdf5_sources INCLUDE REGEX "/VtkHdf/Hdf5/")
list(REMOVE_ITEM smg_iocore_sources ${smg_hdf5_sources})

add_library(smgIOCore SHARED ${smg_iocore_sources})
add_library(StreamingMultigrid::IOCore ALIAS smgIOCore)
smg_library(smgIOCore IOCore)
target_compile_definitions(smgIOCore PRIVATE
  SMG_VTKHDF_LIBRARY="libsmgVtkHdf.so.${PROJECT_VERSION_MAJOR}")
target_link_libraries(smgIOCore
  PUBLIC StreamingMultigrid::Solver
  PRIVATE Eigen3::Eigen FastFloat::fast_float ZLIB::ZLIB LibLZMA::LibLZMA Threads::Threads
    ${CMAKE_DL_LIBS})

# Loaded by the other one when it is needed.
add_library(smgVtkHdf SHARED ${smg_hdf5_sources})
set_target_properties(smgVtkHdf PROPERTIES
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
target_link_libraries(smgVtkHdf PUBLIC smgIOCore PRIVATE PkgConfig::SMG_HDF5)
install(TARGETS smgVtkHdf
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT libraries NAMELINK_SKIP)
