// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IO/Files/FileNames.h"
#include "smg/DeformationDescription.h"
#include "smg/Error.h"
#include "smg/Export.h"
#include "smg/MovedMesh.h"
#include "smg/ProblemDescription.h"
#include "smg/Solve.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

/** A computation on the processes that mpiexec has started, the same on all of them. The functions
 * are called on the first process alone. */
struct DistributedJob
{
  std::filesystem::path in;  ///< a .vsm file that all processes can read
  std::filesystem::path out; ///< .pvtu or .pvtp: every process writes its piece
  std::filesystem::path scratch;
  std::string task;                  ///< the name in errors of what is to be done
  const std::string* text = nullptr; ///< that of `task`, when the description has been read
  int maxIterations = 1;
  std::int64_t memoryLimit = 0; ///< of a process, bytes
  smg::ProgressFunction progress;
  std::function<void()> check;              ///< reports foreseeable failures, before the work
  std::function<void(smg::Solution&)> use;  ///< writes the result, unless it is in pieces
  std::function<void(smg::Report&)> report; ///< of a result in pieces
};

/** A problem to solve. */
struct DistributedSolve
{
  std::function<smg::ProblemDescription()> read; ///< called on every process
  double tolerance = 0.0;
};

/** Handles to deform by. */
struct DistributedDeformation
{
  /** With weights and tolerance; called on every process. */
  std::function<smg::DeformationDescription()> read;
  smg::MovedNormals normals = smg::MovedNormals::Recompute; ///< of pieces
};

/** The library with MPI and hypre, which is loaded when it is needed. Its functions throw
 * smg::Error on the first process, and return on any other one. */
struct DistributedEngine
{
  void (*solve)(const DistributedJob& job, const DistributedSolve& solve);
  void (*deform)(const DistributedJob& job, const DistributedDeformation& deformation);
};

/** Whether the name of a result asks for a piece of each process. */
inline bool isInPieces(const std::filesystem::path& out)
{
  const std::string suffix = smg::lowerSuffix(out);
  return suffix == ".pvtu" || suffix == ".pvtp";
}

/** The only symbol of the library that is looked up. */
extern "C" SMG_EXPORT const DistributedEngine* smgDistributedEngine();
