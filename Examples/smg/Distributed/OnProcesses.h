// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../DistributedEngine.h"
#include "PieceFiles.h"
#include "ReadPart.h"

#include "Solver/Distributed/Team.h"
#include "smg/DistributedSolver.h"
#include "smg/VsmReader.h"

#include <memory>
#include <utility>

// Called on all processes; they throw smg::Error on all of them.

void solveOn(smg::Team& team, const DistributedJob& job, const DistributedSolve& task);
void deformOn(smg::Team& team, const DistributedJob& job, const DistributedDeformation& task);

/** The mesh of a job, the part of this process, and what is described on it: a problem or handles.
 */
template <class Described>
struct DescribedPart
{
  std::unique_ptr<smg::VsmReader> mesh;
  smg::MeshPart part;
  std::unique_ptr<Described> described;
};

/** Checks the job and reads it; read() returns the description. */
template <class Described, class Read>
DescribedPart<Described> readDescribed(smg::Team& team, const DistributedJob& job, Read&& read)
{
  DescribedPart<Described> result;
  team.run(
    [&]
    {
      if (team.rank() == 0)
      {
        job.check();
      }
      team.agree();
      result.mesh = std::make_unique<smg::VsmReader>(job.in);
      if (team.rank() == 0 && isInPieces(job.out))
      {
        checkPieceFiles(result.mesh->info(), job.out);
      }
      team.agree();
      result.part.info = infoOfPart(result.mesh->info());
      const auto description = read();
      team.requireSame("mesh " + job.in.string(), result.mesh->fingerprint());
      team.requireSame("text in " + job.task, *job.text);
      result.described = std::make_unique<Described>(description, result.part.info, job.task);
      readPart(*result.mesh, result.described->vertexColumns(), result.described->cellColumns(),
        team, result.part);
    });
  return result;
}

inline smg::DistributedOptions optionsOf(const DistributedJob& job, double tolerance)
{
  return { tolerance, job.maxIterations, job.memoryLimit, job.progress };
}

/** Reports on the first process. */
inline void reportOn(smg::Team& team, const DistributedJob& job, smg::Report& report)
{
  team.run(
    [&]
    {
      if (team.rank() == 0)
      {
        job.report(report);
      }
    });
}
