// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/Team.h"
#include "smg/DistributedSolver.h"
#include "smg/VsmReader.h"

#include <filesystem>

/** Writes the mesh with its solution and the requested cell results as a .pvtp or .pvtu file, each
 * process the piece of its cells, in the folder of that name. Pieces have GlobalIds, vtkGhostType
 * and StreamFinalized as those of vtkStreamingMeshReader. Called on all processes; throws
 * smg::Error. */
void writePieceFiles(smg::Team& team, smg::VsmReader& mesh,
  const smg::DistributedSolution& solution, const smg::ResultOptions& results,
  const std::filesystem::path& out);
