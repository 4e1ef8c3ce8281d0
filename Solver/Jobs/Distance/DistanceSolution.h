// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Solver/Files/ScratchBlocks.h"
#include "Solver/Jobs/Distance/DistanceRun.h"
#include "Solver/Memory/Buffer.h"
#include "smg/Solve.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace smg
{

/** A column of results in a scratch file of blocks of consecutive vertices. */
struct StoredColumn
{
  enum class Type
  {
    Float64,
    Float32,
    Int64
  };

  ScratchBlocks* file = nullptr;
  std::int64_t stride = 1; ///< block `chunk * stride + offset` has the values of a chunk
  std::int64_t offset = 0;
  Type type = Type::Float64;
  int components = 1;
  double fallback = 0; ///< the values of a block without bytes
};

/** Distances on scratch files, with what they need kept alive. */
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

  /** Adds maximum, mean and the number of unreached vertices to Report::distance. */
  void summarize();

private:
  void load(std::int64_t chunk);
  void loadColumn(const StoredColumn& column, std::int64_t chunk, std::int64_t count, int first);

  std::unique_ptr<DistanceRun> Run; // outlives the files, whose traffic it counts
  std::shared_ptr<void> Files;
  std::vector<StoredColumn> Columns;
  std::int64_t Vertices, ChunkVertices;
  int Components = 0;
  Buffer Values; ///< of the chunk in memory, in the order of read()
  Buffer Stored; ///< of a column of it
  std::int64_t Chunk = -1;
};

} // namespace smg
