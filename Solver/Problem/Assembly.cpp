// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Assembly.h"

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
  : Info(info)
  , Check(info.cellType)
  , Listener(listener)
  , Cells(pool, info.cellType, problem, rows.weightScale, components, labels)
  , Reach(pool)
  , Targets(problem, this->Cells.vertices.points)
  , Rows(info.cellType, this->Cells.vertices, problem, rows, components,
      stiffRows(info.cellType, problem.weights(), rows), listener)
{
}

void Assembly::add(const MeshBlock& block)
{
  this->Check.add(block);
  this->Cells.add(block);
  this->finalize(block.finalized);
}

void Assembly::finish()
{
  this->Check.finish(this->Info);
  this->finalize(this->vertices());
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
    const double alpha = this->Cells.loads.close(i);
    const std::int32_t label = this->Cells.parts.close(i, this->Cells.vertices.mass[i]);
    this->Rows.close(i, label, std::span(this->Neighbours).subspan(first, last - first),
      this->Targets.at(first), alpha, this->Cells.loads.load());
    if (this->Listener)
    {
      this->Listener->close(this->Cells.vertices.points.at(i), this->Reach[i]);
    }
    first = last;
  }
  this->Cells.parts.flush();
  this->Final = end;
}

/** Appends the neighbours of vertex i to the batch. */
void Assembly::collectRow(std::int64_t i)
{
  const std::size_t before = this->Neighbours.size();
  this->Cells.edges.take(i, this->Cells.vertices.points, this->Neighbours);
  this->RowEnds.push_back(this->Neighbours.size());
  const bool alone = this->Neighbours.size() == before;
  const std::int64_t last = alone ? i : std::max(i, this->Neighbours.back().to);
  this->Reach.close(i, last);
}

/** Releases the data that no later row needs. */
void Assembly::release()
{
  this->Cells.vertices.release(this->Reach.advance(this->Final), this->Final);
  this->Cells.parts.release(this->Final);
  this->Cells.edges.release(this->Final);
  this->Cells.loads.release(this->Final);
}

} // namespace smg
