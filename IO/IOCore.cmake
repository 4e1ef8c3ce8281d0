# SPDX-License-Identifier: BSD-3-Clause
# IO without VTK: containers, streaming formats, conversion. The vtk* files of this folder belong to
# the VTK module StreamingMultigrid::IO.
file(GLOB_RECURSE smg_iocore_sources CONFIGURE_DEPENDS IO/*.cpp)

add_library(smgIOCore SHARED ${smg_iocore_sources})
add_library(StreamingMultigrid::IOCore ALIAS smgIOCore)
smg_library(smgIOCore IOCore)

target_link_libraries(smgIOCore
  PUBLIC StreamingMultigrid::Solver
  PRIVATE Eigen3::Eigen FastFloat::fast_float ZLIB::ZLIB LibLZMA::LibLZMA PkgConfig::SMG_HDF5 Threads::Threads ${CMAKE_DL_LIBS})
