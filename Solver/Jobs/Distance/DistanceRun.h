// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Core/Progress.h"
#include "Solver/Files/BlockStore.h"
#include "Solver/Jobs/Values/JobRun.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Distance.h"
#include "smg/Report.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace smg
{

/** The use of memory of a distance. */
inline constexpr PoolUse DistanceMemory{ "a distance",
  "raise the memory limit, or convert the mesh with the order bfs if it has another" };

/** What all parts of a distance and its solution share. */
struct DistanceRun : JobRun
{
  explicit DistanceRun(const DistanceOptions& options);

  /** To be called before the first pass: what has been read and written until then belongs to none.
   */
  void beginPasses() { this->Before = this->now(); }
  /** Adds a pass to the report. `unsettled` is the share of the vertices that still have changes to
   * pass on. */
  void endPass(double unsettled);
  /** Adds memory, scratch files and times to the report. */
  void finishReport();

  Progress progress;
  int maxPasses;

private:
  /** Time, traffic and memory from the beginning until now, in the form of one pass. */
  Report::Pass now() const
  {
    return { 0.0, this->Wall.seconds(), this->traffic.bytesRead(), this->traffic.bytesWritten(),
      this->pool.peak() };
  }

  Report::Pass Before;
};

/** A column of results in a scratch file of blocks of consecutive vertices. */
struct StoredColumn
{
  enum class Type
  {
    Float64,
    Float32,
    Int64
  };

  BlockStore* file = nullptr;
  std::int64_t stride = 1; ///< block `chunk * stride + offset` has the values of a chunk
  std::int64_t offset = 0;
  Type type = Type::Float64;
  int components = 1;
  double fallback = 0;                            ///< the values of a block without bytes
  std::int64_t (*decode)(std::int64_t) = nullptr; ///< of Int64: from a label to the value
};

/** A solution on scratch files; it keeps these and everything that they need alive. */
class DistanceSolution final : public Solution
{
public:
  /** `files` keeps the files of the columns. */
  DistanceSolution(std::unique_ptr<DistanceRun> run, std::shared_ptr<void> files,
    std::vector<StoredColumn> columns, std::int64_t vertices, std::int64_t chunkVertices);

  std::int64_t vertices() const override { return this->Vertices; }
  int columns() const override { return this->Components; }
  void read(std::int64_t first, std::int64_t count, std::span<double> values) override;
  const Report& report() const override { return this->Run->report; }

  /** Completes the report of the run, which the solution owns. Throws Cancelled. */
  void finish();

private:
  void summarize();
  void load(std::int64_t chunk);
  void loadColumn(const StoredColumn& column, std::int64_t chunk, std::int64_t count, int first);

  std::unique_ptr<DistanceRun> Run; // outlives the files, whose traffic it counts
  std::shared_ptr<void> Files;
  std::vector<StoredColumn> Columns;
  std::int64_t Vertices, ChunkVertices;
  int Components = 0;
  Buffer Values; ///< of the chunk in memory, in the order of read()
  Buffer Stored; ///< one column of this chunk, as in the file
  std::int64_t Chunk = -1;
};

} // namespace smg
