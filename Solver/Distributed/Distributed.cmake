# SPDX-License-Identifier: BSD-3-Clause
# The distributed engine, the only library that needs MPI: StreamingMultigrid::Distributed.
file(GLOB smg_distributed_sources CONFIGURE_DEPENDS Solver/Distributed/*.cpp)
add_library(smgDistributedObjects OBJECT ${smg_distributed_sources})
target_include_directories(smgDistributedObjects PUBLIC
  "${PROJECT_SOURCE_DIR}/Solver/include" "${PROJECT_SOURCE_DIR}/Solver/Distributed/include")
# Not the C++ interface that MPI 3 has removed, which needs a library of its own.
target_compile_definitions(smgDistributedObjects PUBLIC OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX
  PRIVATE EIGEN_DONT_VECTORIZE)
target_compile_options(smgDistributedObjects PRIVATE ${smg_kernel_options})
target_link_libraries(smgDistributedObjects PUBLIC MPI::MPI_C PRIVATE HYPRE::HYPRE)
smg_hide_symbols(smgDistributedObjects)
smg_library(smgDistributed Distributed "${PROJECT_SOURCE_DIR}/Solver/Distributed/include"
  OBJECTS smgDistributedObjects EXPORT StreamingMultigridDistributed
  DEPENDENCIES HYPRE::HYPRE PUBLIC StreamingMultigrid::Solver MPI::MPI_C)
target_compile_definitions(smgDistributed PUBLIC OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
target_link_libraries(smgDistributedStatic INTERFACE smgSolverStatic MPI::MPI_C)
target_compile_definitions(smgDistributedStatic INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
