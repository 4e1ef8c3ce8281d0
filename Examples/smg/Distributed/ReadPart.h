// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Distributed/Team.h"
#include "smg/DistributedSolver.h"
#include "smg/VsmReader.h"

#include <string>
#include <vector>

/** The mesh of a .vsm file as a part of it has it: with the column OriginalId, of stream indices if
 * the file has none. */
smg::StreamInfo infoOfPart(const smg::StreamInfo& mesh);

/** The first cell of piece `rank` of `pieces`. */
inline std::int64_t firstCellOf(const smg::StreamInfo& mesh, int rank, int pieces)
{
  return static_cast<std::int64_t>(static_cast<__int128>(mesh.cells) * rank / pieces);
}

/** Reads the cells of this process, with the columns of these names; `part.info` is that of
 * infoOfPart(). Called on all processes, within Team::run(). Throws smg::Error. */
void readPart(smg::VsmReader& mesh, std::vector<std::string> vertexColumns,
  std::vector<std::string> cellColumns, smg::Team& team, smg::MeshPart& part);
