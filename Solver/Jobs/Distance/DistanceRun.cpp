// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Jobs/Distance/DistanceRun.h"

#include "Solver/Multigrid/Engine/CheckOptions.h"

#include <algorithm>
#include <cmath>
#include <utility>

// What the two kinds of distances share: the figures of the report, and a solution that is read
// chunk by chunk from scratch files.

namespace smg
{

namespace
{

SolveOptions jobOptions(const DistanceOptions& options)
{
  SolveOptions job;
  job.memoryLimit = options.memoryLimit;
  job.threads = options.threads;
  job.scratch = options.scratch;
  job.scratchLimit = options.scratchLimit;
  return job;
}

} // namespace

DistanceRun::DistanceRun(const DistanceOptions& options)
  : JobRun(jobOptions(options), DistanceMemory)
  , progress(options.progress)
  , maxPasses(options.maxPasses)
{
}

/** Reports a pass by the differences to the state at the end of the one before. */
void DistanceRun::endPass(double unsettled)
{
  const Report::Pass now = this->now();
  this->report.by_pass.push_back({ unsettled, now.seconds - this->Before.seconds,
    now.read - this->Before.read, now.written - this->Before.written, now.pool_bytes });
  this->Before = now;
}

/** The time of the solve is what building does not take. */
void DistanceRun::finishReport()
{
  this->JobRun::finishReport();
  this->report.seconds.solve = this->report.seconds.total - this->report.seconds.build;
}

/** In memory is one chunk: as it is stored, and as read() delivers it. */
DistanceSolution::DistanceSolution(std::unique_ptr<DistanceRun> run, std::shared_ptr<void> files,
  std::vector<StoredColumn> columns, std::int64_t vertices, std::int64_t chunkVertices)
  : Run(std::move(run))
  , Files(std::move(files))
  , Columns(std::move(columns))
  , Vertices(vertices)
  , ChunkVertices(std::min(chunkVertices, vertices))
{
  int widest = 0;
  for (const StoredColumn& column : this->Columns)
  {
    this->Components += column.components;
    widest = std::max(widest, column.components);
  }
  const auto bytes = [this](int components)
  {
    return static_cast<std::size_t>(this->ChunkVertices) * static_cast<std::size_t>(components) *
           sizeof(double);
  };
  this->Values = Buffer(this->Run->pool, bytes(this->Components));
  this->Stored = Buffer(this->Run->pool, bytes(widest));
}

void DistanceSolution::read(std::int64_t first, std::int64_t count, std::span<double> values)
{
  const auto components = static_cast<std::size_t>(this->Components);
  checkVertexRange(first, count, values.size() / components, this->Vertices);
  const std::int64_t end = first + count;
  while (first < end)
  {
    // A range may extend over several chunks.
    this->load(first / this->ChunkVertices);
    const std::int64_t begin = this->Chunk * this->ChunkVertices;
    const std::int64_t part = std::min(end, begin + this->ChunkVertices) - first;
    const auto* from = reinterpret_cast<const double*>(this->Values.data()) +
                       static_cast<std::size_t>(first - begin) * components;
    const std::size_t numbers = static_cast<std::size_t>(part) * components;
    std::copy_n(from, numbers, values.begin());
    values = values.subspan(numbers);
    first += part;
  }
}

/** Loads all columns of a chunk, unless they are in memory. */
void DistanceSolution::load(std::int64_t chunk)
{
  if (chunk == this->Chunk)
  {
    return;
  }
  // No chunk is in memory if reading throws.
  this->Chunk = -1;
  const std::int64_t count =
    std::min(this->ChunkVertices, this->Vertices - chunk * this->ChunkVertices);
  int first = 0;
  for (const StoredColumn& column : this->Columns)
  {
    this->loadColumn(column, chunk, count, first);
    first += column.components;
  }
  this->Chunk = chunk;
}

/** Reads a column of a chunk, and spreads it to the places of its components, from number `first`
 * on, as doubles. Numbers of sources are exact up to 2^53. */
void DistanceSolution::loadColumn(
  const StoredColumn& column, std::int64_t chunk, std::int64_t count, int first)
{
  const std::int64_t index = chunk * column.stride + column.offset;
  const std::int64_t all = count * column.components;
  const bool isStored = column.file->bytes(index) > 0;
  const auto copy = [&]<class T>(const T* stored)
  {
    if (isStored)
    {
      column.file->read(
        index, this->Stored.bytes().first(static_cast<std::size_t>(all) * sizeof(T)));
    }
    auto* to = reinterpret_cast<double*>(this->Values.data()) + first;
    for (std::int64_t i = 0; i < all; ++i)
    {
      to[i / column.components * this->Components + i % column.components] =
        isStored
          ? static_cast<double>(
              column.decode ? column.decode(static_cast<std::int64_t>(stored[i])) : stored[i])
          : column.fallback;
    }
  };
  const std::byte* stored = this->Stored.data();
  column.type == StoredColumn::Type::Float64 ? copy(reinterpret_cast<const double*>(stored))
  : column.type == StoredColumn::Type::Int64 ? copy(reinterpret_cast<const std::int64_t*>(stored))
                                             : copy(reinterpret_cast<const float*>(stored));
}

void DistanceSolution::finish()
{
  this->summarize();
  this->Run->progress.update(1.0);
  this->Run->finishReport();
}

/** Adds maximum, mean and the number of unreached vertices to Report::distance. One reading of the
 * distances, chunk by chunk in the order of the stream, which also fixes the order of the sum. */
void DistanceSolution::summarize()
{
  Report::Distance& summary = *this->Run->report.distance;
  double sum = 0;
  std::int64_t finite = 0;
  for (std::int64_t v = 0; v < this->Vertices; ++v)
  {
    this->load(v / this->ChunkVertices);
    const double distance = reinterpret_cast<const double*>(
      this->Values.data())[v % this->ChunkVertices * this->Components];
    if (std::isfinite(distance))
    {
      ++finite;
      sum += distance;
      summary.maximum = std::max(summary.maximum, distance);
    }
  }
  summary.mean = finite > 0 ? sum / static_cast<double>(finite) : 0;
  summary.unreached = this->Vertices - finite;
}

} // namespace smg
