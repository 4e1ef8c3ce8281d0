// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Assembly.h"

#include <algorithm>
#include <span>
#include <utility>

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
  , Parts(components)
  , Listener(listener)
  , Out(rows)
  , Cells(pool, info.cellType, problem, this->WeightScale, components, labels)
  , Reach(pool)
  , Targets(problem, this->Cells.vertices.points)
  , ConnectsApart(this->Cells.mayConnectApart() && !this->Targets.any())
  , FinalMemory(pool)
  , Rows(info.cellType, this->Cells.vertices, problem, rows, components,
      stiffRows(info.cellType, problem.weights(), rows), listener)
{
}

void Assembly::add(const MeshBlock& block)
{
  this->Check.add(block);
  this->Cells.add(block);
  this->beginRows();
  this->collectBelow(block.finalized, false);
  this->release();
}

void Assembly::finish()
{
  this->Check.finish(this->Info);
  this->collectBelow(this->vertices(), false);
  this->release();
}

void Assembly::beginApart(std::int64_t vertices)
{
  std::swap(this->Collected, this->Arrived);
  if (accountedBytes(this->Collected.bytes()) > 0)
  {
    this->Collected = {};
  }
  this->Collected.clear(this->Arrived.end());
  std::swap(this->Weighed, this->Connected);
  this->Weighed.clear();
  this->Out.weightScale = this->WeightScale;
  this->Cells.reserve(vertices);
  this->beginRows();
}

void Assembly::beginRows()
{
  if (this->Listener)
  {
    this->Listener->begin();
  }
}

void Assembly::weigh(const MeshBlock& block)
{
  this->Check.add(block);
  if (this->ConnectsApart)
  {
    this->Cells.weigh(block, this->Weighed);
    return;
  }
  this->Cells.add(block);
  this->collectBelow(block.finalized, true);
}

void Assembly::weighRest()
{
  this->Check.finish(this->Info);
  if (this->ConnectsApart)
  {
    this->Weighed.vertices = this->Weighed.finalized = this->vertices();
    return;
  }
  this->collectBelow(this->vertices(), true);
}

void Assembly::connect()
{
  if (this->ConnectsApart)
  {
    this->Cells.connect(this->Connected);
    this->collectBelow(this->Connected.finalized, true);
  }
}

/** Collects the vertices below `end`, and completes their rows unless another thread does. */
void Assembly::collectBelow(std::int64_t end, bool apart)
{
  while (this->Collected.end() < end)
  {
    this->collectBatch(std::min(end, this->Collected.end() + BatchRows));
    this->FinalMemory.resize(
      accountedBytes(this->Collected.bytes()) + accountedBytes(this->Arrived.bytes()));
    if (!apart)
    {
      // Changes once, at the first weighted cell: the coarse levels, on other threads, read it.
      if (this->Out.weightScale != this->WeightScale)
      {
        this->Out.weightScale = this->WeightScale;
      }
      std::swap(this->Collected, this->Arrived);
      this->Collected.clear(this->Arrived.end());
      this->closeRows();
    }
  }
}

void Assembly::collectBatch(std::int64_t end)
{
  FinalVertices& made = this->Collected;
  const std::int64_t begin = made.end();
  const std::size_t before = made.neighbours.size();
  for (std::int64_t i = begin; i < end; ++i)
  {
    this->collectVertex(i);
  }
  this->Cells.parts.flush();
  if (this->Targets.any())
  {
    this->askTargets(begin, before);
  }
}

/** Queries the targets of the collected vertices from `begin` on, whose edges begin at number
 * `edge`. */
void Assembly::askTargets(std::int64_t begin, std::size_t edge)
{
  FinalVertices& made = this->Collected;
  this->RowEnds.clear();
  for (auto k = static_cast<std::size_t>(begin - made.first); k < made.vertices.size(); ++k)
  {
    this->RowEnds.push_back(made.vertices[k].end - edge);
  }
  const std::size_t edges = made.neighbours.size() - edge;
  this->Targets.ask(begin, std::span(made.neighbours).subspan(edge), this->RowEnds);
  const double* first = this->Targets.at(0);
  made.targets.insert(made.targets.end(), first,
    first + edges * static_cast<std::size_t>(this->Cells.vertices.values.lanes()));
}

/** Collects the next vertex. */
void Assembly::collectVertex(std::int64_t i)
{
  FinalVertices& made = this->Collected;
  const OpenVertices& open = this->Cells.vertices;
  const std::size_t before = made.neighbours.size();
  this->Cells.edges.take(i, open.points, made.neighbours);
  const std::size_t end = made.neighbours.size();
  this->Reach.close(i, end == before ? i : std::max(i, made.neighbours.back().to));
  const double rowSum = this->Cells.loads.close(i);
  const double* load = this->Cells.loads.load();
  made.loads.insert(made.loads.end(), load, load + open.values.lanes());
  const double mass = open.mass[i];
  const bool isKnown = RowAssembly::isKnown(open.dirichlet[i], end - before, rowSum);
  const bool isUndetermined = isKnown && open.dirichlet[i] < 0;
  // A vertex with only flat cells has no component, but may have a facet.
  const std::int32_t root =
    isUndetermined ? this->Cells.parts.closeUndetermined(i) : this->Cells.parts.close(i, mass);
  if (root >= 0 && (rowSum > 0.0 || isKnown))
  {
    this->Parts.anchor(root);
  }
  // The root depends on which later cells are in the block, the label does not.
  const bool counts = root >= 0 && this->Parts.isFree(root);
  made.vertices.push_back({ end, rowSum, mass, this->Reach[i],
    this->Cells.policy.own() ? open.scale[i] : 1.0F, counts ? this->Cells.parts.label(i) : -1 });
}

void Assembly::closeRows()
{
  const FinalVertices& made = this->Arrived;
  for (std::size_t k = 0; k < made.vertices.size(); ++k)
  {
    this->Rows.close(made, k);
    if (this->Listener)
    {
      const std::int64_t i = made.first + static_cast<std::int64_t>(k);
      this->Listener->close(this->Cells.vertices.points.at(i), made.vertices[k].reach);
    }
  }
  this->Closed = made.end();
  this->Arrived.clear(this->Closed);
}

void Assembly::release()
{
  const std::int64_t collected = this->Collected.end();
  this->Cells.vertices.release(this->Reach.advance(this->Closed), collected);
  this->Cells.parts.release(collected);
  this->Cells.edges.release(collected);
  this->Cells.loads.release(collected);
}

} // namespace smg
