# SPDX-License-Identifier: BSD-3-Clause
# The libraries of Solver and IO, and VTK: ParaView's own unless VTK_DIR names another.

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE) # 3.3 or newer; Eigen 5 rejects a request for 3
find_package(CHOLMOD REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(FastFloat REQUIRED CONFIG)
find_package(ZLIB REQUIRED)
find_package(LibLZMA REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(SMG_COMPRESSION REQUIRED IMPORTED_TARGET libzstd liblz4 libxxhash)
pkg_check_modules(SMG_HDF5 REQUIRED IMPORTED_TARGET hdf5-serial) # the version without MPI

# The distributed engine, by default where its libraries are.
if (NOT DEFINED SMG_USE_HYPRE OR SMG_USE_HYPRE)
  find_package(MPI QUIET COMPONENTS C)
  find_package(HYPRE QUIET)
endif ()
set(smg_has_hypre OFF)
if (MPI_C_FOUND AND HYPRE_FOUND)
  set(smg_has_hypre ON)
endif ()
set(smg_use_hypre ${smg_has_hypre})
if (SMG_DEBIAN_PACKAGES)
  set(smg_use_hypre OFF) # the packages depend on no MPI
endif ()
option(SMG_USE_HYPRE "Build the distributed engine (requires MPI and hypre)" ${smg_use_hypre})
if (SMG_USE_HYPRE AND NOT smg_has_hypre)
  message(FATAL_ERROR "SMG_USE_HYPRE: MPI or hypre was not found; install them, or switch it off.")
endif ()

if (NOT SMG_BUILD_VTK)
  set(SMG_BUILD_PARAVIEW_PLUGIN OFF)
  set(SMG_BUILD_PYTHON OFF)
  return()
endif ()

set(smg_vtk_components
  CommonCore CommonDataModel CommonExecutionModel CommonMisc CommonSystem CommonTransforms
  FiltersCore FiltersExtraction FiltersGeneral FiltersGeometry FiltersSources IOCore IOLegacy IOXML ParallelCore)
if (SMG_BUILD_PYTHON)
  list(APPEND smg_vtk_components Python WrappingPythonCore)
endif ()
set(smg_optional_vtk_components)
if (SMG_USE_HYPRE)
  list(APPEND smg_optional_vtk_components ParallelMPI)
endif ()
include(SmgParaViewPrefix)
if (SMG_BUILD_PARAVIEW_PLUGIN)
  find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingCore)
endif ()
file(GLOB smg_paraview_vtk "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*/vtk")
find_package(VTK 9.1 REQUIRED COMPONENTS ${smg_vtk_components}
  OPTIONAL_COMPONENTS ${smg_optional_vtk_components}
  HINTS "${ParaView_DIR}/vtk" ${smg_paraview_vtk})
message(STATUS "StreamingMultigrid: VTK ${VTK_VERSION} in ${VTK_DIR}")
