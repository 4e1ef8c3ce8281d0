# SPDX-License-Identifier: BSD-3-Clause
# Headers and the CMake package StreamingMultigrid, for the installed and for the build tree.
include(CMakePackageConfigHelpers)

set(smg_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/StreamingMultigrid")
install(DIRECTORY Solver/include/smg IO/include/smg
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/StreamingMultigrid" COMPONENT development)
if (TARGET smgDistributed)
  install(DIRECTORY Solver/Distributed/include/smg
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/StreamingMultigrid" COMPONENT development)
endif ()
# What smg/SolveWith.h includes besides: what operators work on, and how they are compiled. On the
# path of StreamingMultigrid::Engine alone.
foreach (header
    Core/CancelCheck.h Core/SimdPack.h Core/SystemCalls.h
    Memory/Buffer.h Memory/Pool.h Memory/RaggedRing.h Memory/Ring.h
    Multigrid/Extended.h Multigrid/OperatorSet.h Multigrid/RowOperators.h
    Multigrid/Cycle/GaussSeidel.h Multigrid/Cycle/RowBlock.h Multigrid/Cycle/Sweep.h
    Multigrid/Engine/Coarsening.h Multigrid/Engine/CompiledOperators.h
    Multigrid/Engine/InterpolationSweeps.h Multigrid/Engine/LevelCoarsening.h
    Multigrid/Schedule/Cursor.h
    Multigrid/Setup/CoarsePoints.h Multigrid/Setup/CoarseningData.h
    Multigrid/Setup/GalerkinProduct.h Multigrid/Setup/GatheredRows.h
    Multigrid/Setup/Interpolation.h Multigrid/Setup/InterpolationRow.h
    Multigrid/Setup/LevelRows.h Multigrid/Setup/OverlappingPatches.h
    Multigrid/Setup/Patches.h Multigrid/Setup/RowBatch.h
    Multigrid/Setup/SliverRows.h Multigrid/Setup/Sparsification.h)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES "Solver/${header}"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/StreamingMultigrid/engine/Solver/${folder}"
    COMPONENT development)
endforeach ()

install(FILES docs/problem.schema.json
  DESTINATION "${CMAKE_INSTALL_DATADIR}/StreamingMultigrid" COMPONENT libraries)

# The original of the folder that SmgParaViewPrefix creates in the build folder.
string(REPLACE "${CMAKE_BINARY_DIR}/paraview/" "/usr/" smg_vtk_dir "${VTK_DIR}")
configure_package_config_file(cmake/StreamingMultigridConfig.cmake.in
  "${CMAKE_BINARY_DIR}/${smg_package_dir}/StreamingMultigridConfig.cmake"
  INSTALL_DESTINATION "${smg_package_dir}")
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${smg_package_dir}/StreamingMultigridConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
file(COPY cmake/SmgParaViewPrefix.cmake DESTINATION "${CMAKE_BINARY_DIR}/${smg_package_dir}")
install(FILES
  cmake/SmgParaViewPrefix.cmake
  "${CMAKE_BINARY_DIR}/${smg_package_dir}/StreamingMultigridConfig.cmake"
  "${CMAKE_BINARY_DIR}/${smg_package_dir}/StreamingMultigridConfigVersion.cmake"
  DESTINATION "${smg_package_dir}" COMPONENT development)

if (SMG_CORE_BUILD)
  return () # the targets are those of that folder
endif ()
export(EXPORT StreamingMultigrid NAMESPACE StreamingMultigrid::
  FILE "${CMAKE_BINARY_DIR}/${smg_package_dir}/StreamingMultigridTargets.cmake")
install(EXPORT StreamingMultigrid NAMESPACE StreamingMultigrid::
  DESTINATION "${smg_package_dir}" FILE StreamingMultigridTargets.cmake COMPONENT development)
if (TARGET smgDistributed)
  export(EXPORT StreamingMultigridDistributed NAMESPACE StreamingMultigrid::
    FILE "${CMAKE_BINARY_DIR}/${smg_package_dir}/StreamingMultigridDistributedTargets.cmake")
  install(EXPORT StreamingMultigridDistributed NAMESPACE StreamingMultigrid::
    DESTINATION "${smg_package_dir}" FILE StreamingMultigridDistributedTargets.cmake
    COMPONENT development)
endif ()
