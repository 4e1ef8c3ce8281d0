// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/PartialProgress.h"
#include "IO/Jobs/MeshJob.h"
#include "IO/Mesh/Columns.h"
#include "smg/MovedMesh.h"

namespace smg
{

// What jobs that move vertices have in common.

/** The share of computing normals in the progress of passing the result. */
inline constexpr double NormalsShare = 0.3;

/** How the normals of the moved mesh are computed. */
inline NormalsOptions normalsOptions(const SolvingJob& job, const ProgressFunction& progress)
{
  return { job.options().scratch, job.writerMemory(), progress };
}

/** Whether a moved mesh has a column of the mesh at rest, if necessary with other values. */
inline bool keepsMoved(const ColumnSpec& column, MovedNormals normals, CellType cells)
{
  return !isNormals(column) || (normals == MovedNormals::Recompute && cells == CellType::Triangle);
}

} // namespace smg
