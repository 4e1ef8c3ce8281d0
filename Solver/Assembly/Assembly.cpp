// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/Assembly.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

// From the mesh stream to the rows of the finest level, in one pass (docs/architecture.md, "A
// pass"). Four stages follow each other: the cells of a block are weighed, for which the problem is
// asked; their corners are connected, which sums their weights over the edges; vertices that become
// final are collected with their edges; and collected vertices become rows, right-hand sides and
// initial values.
//
// On one thread, add() runs all stages on one block. On several threads, weigh(), connect() and
// closeRows() run at the same time, each on what the stage before it made in the step before. Both
// ways, cells are taken in the order of the stream and vertices in ascending order, and every sum
// has its terms in this order. So the rows have the same bits for any size of blocks and any number
// of threads: blocks only determine when a vertex becomes final.
//
// The time is linear in the number of cells. The memory holds the open vertices, whose number is at
// most of the order of the span of the stream, and one block for each stage.

namespace smg
{
namespace
{

/** Rows are completed in batches of this size, to query edge targets in one call. */
constexpr std::int64_t BatchRows = 256;

} // namespace

Assembly::Assembly(Pool& pool, const StreamInfo& info, Problem& problem, AssembledRows& rows,
  Components& components, ComponentLabels& labels, RowListener* listener, Solution* solution)
  : Info(info)
  , Check(info.cellType)
  , Parts(components)
  , Listener(listener)
  , Out(rows)
  , Cells(pool, info.cellType, problem, this->WeightScale, components, labels, solution)
  , Reach(pool)
  , Targets(problem, this->Cells.vertices.points)
  , IsPipelined(this->Cells.mayPipeline() && !this->Targets.any())
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

void Assembly::beginPipelined(std::int64_t vertices)
{
  std::swap(this->Collected, this->ToClose);
  // Memory beyond what a usual block takes is not kept for the next one.
  if (accountedBytes(this->Collected.bytes()) > 0)
  {
    this->Collected = {};
  }
  // Collection goes on where the vertices end that closeRows() is about to complete.
  this->Collected.clear(this->ToClose.end());
  // weigh() fills what connect() emptied in the last step, and the other way round.
  std::swap(this->Weighed, this->Connected);
  this->Weighed.clear();
  // Between two steps, since the coarse levels read it on other threads.
  this->Out.weightScale = this->WeightScale;
  // Within the step the rings must not move: connect() and closeRows() read earlier vertices while
  // weigh() appends.
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
  if (this->IsPipelined)
  {
    this->Cells.weigh(block, this->Weighed);
    return;
  }
  // With data on facets or edge targets, collecting vertices needs the facets of this block, or
  // asks the problem: so all but closeRows() is done here.
  this->Cells.add(block);
  this->collectBelow(block.finalized, true);
}

void Assembly::weighRest()
{
  this->Check.finish(this->Info);
  if (this->IsPipelined)
  {
    // A step later, connect() finds no cells and collects all vertices that are left.
    this->Weighed.vertices = this->Weighed.finalized = this->vertices();
    return;
  }
  this->collectBelow(this->vertices(), true);
}

void Assembly::connect()
{
  if (this->IsPipelined)
  {
    this->Cells.connect(this->Connected);
    this->collectBelow(this->Connected.finalized, true);
  }
}

/** Collects the vertices below `final` that need not wait for coupled ones, and completes their
 * rows unless another task does (`pipelined`). */
void Assembly::collectBelow(std::int64_t final, bool pipelined)
{
  const std::int64_t end = this->Cells.vertices.ties.closable(final);
  while (this->Collected.end() < end)
  {
    this->collectBatch(std::min(end, this->Collected.end() + BatchRows));
    this->FinalMemory.resize(
      accountedBytes(this->Collected.bytes()) + accountedBytes(this->ToClose.bytes()));
    if (!pipelined)
    {
      // It changes only once, at the first weighted cell. Written only then, since the coarse
      // levels read it on other threads.
      if (this->Out.weightScale != this->WeightScale)
      {
        this->Out.weightScale = this->WeightScale;
      }
      // The rows of a batch are completed at once, while its data are in the cache.
      std::swap(this->Collected, this->ToClose);
      this->Collected.clear(this->ToClose.end());
      this->closeRows();
    }
  }
}

/** Collects the vertices below `end`, at most BatchRows, and asks for the targets of all their
 * edges in one call. */
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
    // `end` counts all collected edges, the query only those of this batch.
    this->RowEnds.push_back(made.vertices[k].end - edge);
  }
  const std::size_t edges = made.neighbours.size() - edge;
  this->Targets.ask(begin, std::span(made.neighbours).subspan(edge), this->RowEnds);
  const double* first = this->Targets.at(0);
  made.targets.insert(made.targets.end(), first,
    first + edges * static_cast<std::size_t>(this->Cells.vertices.values.lanes()));
}

/** Collects the next vertex, all of whose cells have been added: its edges, loads, mass and
 * component. */
void Assembly::collectVertex(std::int64_t i)
{
  FinalVertices& made = this->Collected;
  const OpenVertices& open = this->Cells.vertices;
  const std::size_t before = made.neighbours.size();
  const double mass = this->Cells.couple(i);
  this->Cells.edges.take(i, open.points, made.neighbours);
  const std::size_t end = made.neighbours.size();
  // The edges are in ascending order of the neighbour.
  this->Reach.close(i, end == before ? i : std::max(i, made.neighbours.back().to));
  const double rowSum = this->Cells.loads.close(i);
  const double* load = this->Cells.loads.load();
  made.loads.insert(made.loads.end(), load, load + open.values.lanes());
  this->addJumps(i, mass);
  const bool isKnown = RowAssembly::isKnown(open.dirichlet[i], end - before, rowSum);
  const bool isUndetermined = isKnown && open.dirichlet[i] < 0;
  // Without a prescribed value, edges or a rowSum, nothing determines the vertex.
  double weights = 0.0;
  for (std::size_t e = before; rowSum > 0.0 && e < end; ++e)
  {
    weights += std::fabs(made.neighbours[e].weight);
  }
  const bool isLoose = !isKnown && rowSum > 0.0 && Components::isLoose(rowSum, weights);
  // In means a vertex counts by its row sum where that holds the component.
  const double weight = isLoose ? -rowSum : mass;
  const std::int32_t root =
    isUndetermined ? this->Cells.parts.closeUndetermined(i) : this->Cells.parts.close(i, weight);
  if (root >= 0)
  {
    this->Coincident.add(open.points.at(i), this->Cells.parts.label(i));
  }
  // A vertex of flat cells only has no component (-1), but its boundary facets may give it a
  // rowSum.
  if (root >= 0 && isLoose)
  {
    this->Parts.hold(this->Cells.parts.label(i), rowSum, weights);
  }
  else if (root >= 0 && (rowSum > 0.0 || isKnown))
  {
    this->Parts.anchor(root);
  }
  // Sums of components are kept by label: the root depends on which later cells are in the block,
  // the label does not. Whether the component still is free may depend on it, too, but then it gets
  // a constraint later, and its sums are not used.
  const bool counts = root >= 0 && this->Parts.isFloating(root);
  made.vertices.push_back(
    { end, rowSum, weight, this->Reach[i], this->Cells.cells.hasData() ? open.scale[i] : 1.0F,
      root < 0 ? -1 : this->Cells.parts.label(i), counts });
}

/** Collects the mean of the jumps of the vertices that have the unknown i, of this mass. */
void Assembly::addJumps(std::int64_t i, double mass)
{
  const VertexTies& ties = this->Cells.vertices.ties;
  if (!ties.anyJump())
  {
    return;
  }
  std::vector<double>& made = this->Collected.jumps;
  const std::size_t first = made.size();
  made.resize(first + static_cast<std::size_t>(this->Cells.vertices.values.lanes()));
  ties.forVerticesOf(i,
    [&](std::int64_t vertex)
    {
      const double* jump = ties.jump(vertex);
      for (std::size_t k = first; jump && mass > 0.0 && k < made.size(); ++k)
      {
        made[k] += this->Cells.vertices.mass[vertex] / mass * jump[k - first];
      }
    });
}

/** Completes the rows of the arrived vertices. A row reads values and positions of all its
 * neighbours, some of which are still open. */
void Assembly::closeRows()
{
  const FinalVertices& made = this->ToClose;
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
  this->ToClose.clear(this->Closed);
}

void Assembly::release()
{
  // Values and positions are needed until the rows of all neighbours are closed; masses, loads,
  // edges and labels have been copied when their vertex was collected.
  const std::int64_t collected = this->Collected.end();
  this->Cells.vertices.release(this->Reach.advance(this->Closed), collected);
  this->Cells.parts.release(collected);
  this->Cells.edges.release(collected);
  this->Cells.loads.release(collected);
}

} // namespace smg
