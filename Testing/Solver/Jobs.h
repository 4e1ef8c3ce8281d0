// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "smg/Solve.h"

#include "Testing/Support/MemoryMesh.h"
#include "Testing/Support/SolveMesh.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

namespace smg::testing
{

/** How a job runs, which changes nothing of its result. */
struct Way
{
  std::int64_t blockCells = 1000; ///< of the blocks in which the mesh comes
  std::int64_t coreNodes = 500;   ///< the finest levels of small meshes are on scratch files, too
  std::int64_t blockNodes = 4096;
  int threads = 0;
  bool inCore = false;
  std::int64_t memoryLimit = std::int64_t(1) << 30;
  std::int64_t scratchLimit = 0;
  std::filesystem::path scratch{};
  std::filesystem::path checkpoint{};
  ProgressFunction progress{};

  /** The options that say what to compute, in this way. */
  template <class Options>
  Options with(Options options) const
  {
    options.threads = this->threads;
    options.memoryLimit = this->memoryLimit;
    options.scratchLimit = this->scratchLimit;
    options.scratch = this->scratch;
    options.progress = this->progress;
    if constexpr (std::is_base_of_v<SolveOptions, Options>)
    {
      options.coreNodes = this->coreNodes;
      options.blockNodes = this->blockNodes;
      options.inCore = this->inCore;
      options.checkpoint.folder = this->checkpoint;
      options.checkpoint.mesh = "mesh";
      options.checkpoint.problem = "problem";
    }
    return options;
  }
};

/** A job on one mesh. */
using JobRun = std::function<std::unique_ptr<Solution>(const StoredMesh&, const Way&)>;

/** A job of the library, which can be done on any mesh of its cells. */
struct Job
{
  const char* name;
  /** The job on this mesh, to which it adds the columns that it needs. */
  JobRun (*on)(StreamMesh& mesh);
  bool ofSurfaces = true, ofSolids = true;
  bool inCore = true;               ///< it can have all in memory
  bool hasScratchFiles = true;      ///< if it does not have all in memory
  bool hasWindow = false;           ///< its memory follows the width of the stream
  bool hasCheckpoints = false;      ///< it continues after it was killed
  bool refusesBeforeItReads = true; ///< it knows from the counts that a memory limit is too low
  double largestStep = 0.3;         ///< of the progress that it reports
  bool isVariant = false; ///< of the job before: takes other paths, and counts for its bits only
};

/** A job and a mesh that has what it needs. */
class JobOnMesh
{
public:
  JobOnMesh(const Job& job, StreamMesh mesh)
    : Mesh(std::move(mesh))
    , Run(job.on(this->Mesh))
  {
  }

  const StreamMesh& mesh() const { return this->Mesh; }
  std::unique_ptr<Solution> solution(const Way& way) const
  {
    return this->Run(MemoryMesh(this->Mesh, way.blockCells), way);
  }
  std::unique_ptr<Solution> solutionOn(const StoredMesh& mesh, const Way& way) const
  {
    return this->Run(mesh, way);
  }
  Solved operator()(const Way& way) const
  {
    const std::unique_ptr<Solution> solution = this->solution(way);
    return { valuesOf(*solution), solution->report() };
  }

private:
  StreamMesh Mesh;
  JobRun Run;
};

/** A mesh in memory that counts the blocks that are read of it, and fails at one of them. */
class WatchedMesh : public MemoryMesh
{
public:
  using MemoryMesh::MemoryMesh;

  /** Which of the blocks, from 1 on, cannot be read; 0: none. */
  std::int64_t damagedBlock = 0;

  std::int64_t blocks() const { return this->Blocks; }
  std::unique_ptr<MeshSource> source(
    std::vector<std::string> vertexColumns, std::vector<std::string> cellColumns) const override
  {
    return std::make_unique<Source>(
      MemoryMesh::source(std::move(vertexColumns), std::move(cellColumns)), *this);
  }

private:
  class Source : public MeshSource
  {
  public:
    Source(std::unique_ptr<MeshSource> source, const WatchedMesh& mesh)
      : Whole(std::move(source))
      , Mesh(mesh)
    {
    }
    const StreamInfo& info() const override { return this->Whole->info(); }
    bool readsOnAnyThread() const override { return true; }
    bool next(MeshBlock& block) override
    {
      if (++this->Mesh.Blocks == this->Mesh.damagedBlock)
      {
        throw Error("the file is truncated");
      }
      return this->Whole->next(block);
    }

  private:
    std::unique_ptr<MeshSource> Whole;
    const WatchedMesh& Mesh;
  };

  mutable std::atomic<std::int64_t> Blocks = 0;
};

} // namespace smg::testing
