// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Assembly.h"

#include "Solver/Problem/FlatCells.h"
#include "smg/Error.h"

#include <algorithm>

namespace smg
{
namespace
{

/** Rows are completed in batches of this size, to query edge targets in one call. */
constexpr std::int64_t BatchRows = 256;

} // namespace

Assembly::Assembly(Pool& pool, const StreamInfo& info, Problem& problem, AssembledRows& rows,
  Components& components, ComponentLabels& labels, RowListener* listener)
  : Type(info.cellType)
  , Info(info)
  , Check(info.cellType)
  , Listener(listener)
  , Policy(info.cellType, problem, rows.weightScale)
  , Vertices(pool, problem)
  , Parts(pool, components, labels)
  , Reach(pool)
  , Edges(pool, problem, info.cellType)
  , Loads(pool, info.cellType, problem, this->Vertices)
  , Targets(problem, this->Vertices.points)
  , Rows(info.cellType, this->Vertices, problem, rows, components,
      stiffRows(info.cellType, problem.weights(), rows), listener)
{
}

void Assembly::add(const MeshBlock& block)
{
  this->Check.add(block);
  this->addVertices(block);
  this->addCells(block);
  this->Loads.addFacets(block);
  this->finalize(block.finalized);
}

void Assembly::finish()
{
  this->Check.finish(this->Info);
  this->finalize(this->vertices());
}

void Assembly::addVertices(const MeshBlock& block)
{
  this->Vertices.add(block);
  const std::int64_t end = this->vertices();
  this->Parts.extend(end);
  this->Edges.extend(end);
  this->Loads.extend(end);
}

void Assembly::addCells(const MeshBlock& block)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  const auto cells = block.corners.size() / corners;
  const Column* flags = block.flags();
  for (std::size_t c = 0; c < cells; ++c)
  {
    this->Policy.prepare(block, c, this->Vertices.points);
    this->addCell(
      block.corners.data() + c * corners, flags ? static_cast<unsigned>(flags->value(c)) : 0U);
  }
  this->Cells += static_cast<std::int64_t>(cells);
}

void Assembly::addCell(const std::int64_t* corners, unsigned flags)
{
  const double* points[4] = {};
  for (int k = 0; k < cornersOf(this->Type); ++k)
  {
    points[k] = this->Vertices.points.at(corners[k]);
  }
  const CellWeights cell = this->Policy.weigh(corners, points, flags);
  const bool degenerate = cell.measure == 0.0;
  if (!degenerate || this->Policy.connectsFlat(corners, flags))
  {
    this->connect(corners, points, cell);
  }
  if (!degenerate && this->Policy.own())
  {
    this->Loads.addCell(corners, points, *this->Policy.own());
  }
}

/** Connects the corners, with these weights of the edges, which are 0 if the cell is flat. */
void Assembly::connect(
  const std::int64_t* corners, const double* const* points, const CellWeights& cell)
{
  this->Parts.join(corners, cornersOf(this->Type));
  const double mass = cell.measure / cornersOf(this->Type);
  for (int k = 0; k < cornersOf(this->Type); ++k)
  {
    this->Vertices.mass[corners[k]] += mass;
  }
  this->Edges.add(
    corners, points, cell, this->Policy.scale(), [](std::int64_t, std::int64_t) { return true; });
}

void Assembly::finalize(std::int64_t end)
{
  while (this->Final < end)
  {
    this->closeBatch(std::min(end, this->Final + BatchRows));
  }
  this->release();
}

/** Completes the rows below `end`. */
void Assembly::closeBatch(std::int64_t end)
{
  const std::int64_t begin = this->Final;
  this->Neighbours.clear();
  this->RowEnds.clear();
  for (std::int64_t i = begin; i < end; ++i)
  {
    this->collectRow(i);
  }
  this->Targets.ask(begin, this->Neighbours, this->RowEnds);
  std::size_t first = 0;
  for (std::int64_t i = begin; i < end; ++i)
  {
    const std::size_t last = this->RowEnds[static_cast<std::size_t>(i - begin)];
    const double alpha = this->Loads.close(i);
    const std::int32_t label = this->Parts.close(i, this->Vertices.mass[i]);
    this->Rows.close(i, label, std::span(this->Neighbours).subspan(first, last - first),
      this->Targets.at(first), alpha, this->Loads.load());
    if (this->Listener)
    {
      this->Listener->close(this->Vertices.points.at(i), this->Reach[i]);
    }
    first = last;
  }
  this->Parts.flush();
  this->Final = end;
}

/** Appends the neighbours of vertex i to the batch. */
void Assembly::collectRow(std::int64_t i)
{
  const std::size_t before = this->Neighbours.size();
  this->Edges.take(i, this->Vertices.points, this->Neighbours);
  this->RowEnds.push_back(this->Neighbours.size());
  const bool alone = this->Neighbours.size() == before;
  const std::int64_t last = alone ? i : std::max(i, this->Neighbours.back().to);
  this->Reach.close(i, last);
}

/** Releases the data that no later row needs. */
void Assembly::release()
{
  this->Vertices.release(this->Reach.advance(this->Final), this->Final);
  this->Parts.release(this->Final);
  this->Edges.release(this->Final);
  this->Loads.release(this->Final);
}

} // namespace smg
