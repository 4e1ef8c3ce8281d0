// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/DescribedProblem.h"
#include "smg/DistributedSolver.h"
#include "smg/VsmReader.h"

/** The mesh of a .vsm file as a part of it has it: with the column OriginalId, of stream indices if
 * the file has none. */
smg::StreamInfo infoOfPart(const smg::StreamInfo& mesh);

/** The first cell of piece `rank` of `pieces`. */
inline std::int64_t firstCellOf(const smg::StreamInfo& mesh, int rank, int pieces)
{
  return static_cast<std::int64_t>(static_cast<__int128>(mesh.cells) * rank / pieces);
}

/** Reads the cells of a process, with the columns that the problem needs; `part.info` is that of
 * infoOfPart(). The vertices that the process owns are counted from 0. Throws smg::Error. */
void readPart(smg::VsmReader& mesh, const smg::DescribedProblem& problem, int rank, int processes,
  smg::MeshPart& part);
