// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/Assembly.h"

#include "Solver/Problem/FlatCells.h"
#include "smg/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace smg
{
namespace
{

/** Rows are made final in batches of this many, to ask for edge targets in one call. */
constexpr std::int64_t BatchRows = 256;

} // namespace

Assembly::Assembly(Pool& pool, const StreamInfo& info, Problem& problem, AssembledRows& rows,
  Components& components, ComponentLabels& labels, RowListener* listener)
  : Type(info.cellType)
  , Check(info.cellType)
  , Given(problem)
  , Columns(static_cast<std::size_t>(problem.columns()))
  , Kind(problem.weights())
  , ConnectsFlat(problem.connectsFlatCells())
  , Out(rows)
  , Parts(components)
  , PartLabels(labels)
  , Listener(listener)
  , Vertices(pool, problem)
  , Labels(pool)
  , Reach(pool)
  , Edges(pool, problem, info.cellType)
  , Rows(info.cellType, this->Vertices, problem, rows, components,
      stiffRows(info.cellType, problem.weights(), rows), listener)
  , Load(this->Columns)
{
  if (problem.hasCells())
  {
    this->Own.emplace(problem, this->Type);
    this->CellLoads.emplace(pool, this->Type, problem.columns());
  }
  if (problem.hasFacets())
  {
    this->Facets.emplace(pool, problem, this->Type, this->Vertices);
    this->FacetLoads.emplace(pool, this->Type, problem.columns());
  }
}

void Assembly::add(const MeshBlock& block)
{
  this->Check.add(block);
  this->addVertices(block);
  this->addCells(block);
  if (this->Facets)
  {
    this->Facets->add(block);
  }
  this->finalize(block.finalized);
}

void Assembly::finish()
{
  this->finalize(this->vertices());
}

void Assembly::addVertices(const MeshBlock& block)
{
  const std::int64_t begin = this->vertices();
  this->Vertices.add(block);
  const std::int64_t end = this->vertices();
  this->Labels.extendRaw(end);
  std::ranges::fill(this->Labels.range(begin, end), -1);
  this->Edges.extend(end);
  const auto extend = [end](auto& optional)
  {
    if (optional)
    {
      optional->extend(end);
    }
  };
  extend(this->Facets);
  extend(this->CellLoads);
  extend(this->FacetLoads);
}

void Assembly::addCells(const MeshBlock& block)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  const auto cells = block.corners.size() / corners;
  const Column* flags = block.flags();
  for (std::size_t c = 0; c < cells; ++c)
  {
    const std::int64_t* cell = block.corners.data() + c * corners;
    if (this->Own)
    {
      this->Own->prepare(block, c, this->Vertices.points);
    }
    this->addCell(cell, flags ? static_cast<unsigned>(flags->value(c)) : 0U);
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
  const bool repeated = hasRepeatedCorner(corners, cornersOf(this->Type));
  const CellWeights cell = repeated || flags != 0 ? CellWeights{} : this->weightsOf(points);
  const bool degenerate = cell.measure == 0.0;
  this->Degenerate += degenerate ? 1 : 0;
  if (!degenerate || (this->ConnectsFlat && !repeated && (flags & DuplicateCell) == 0))
  {
    this->connect(corners, points, cell);
  }
  if (!degenerate && this->CellLoads)
  {
    this->CellLoads->add(corners, points, *this->Own);
  }
}

CellWeights Assembly::weightsOf(const double* const* points)
{
  CellWeights cell = this->Own ? this->Own->weights() : cellWeights(this->Type, points);
  if (this->Kind != Weights::Cotangent || cell.measure == 0.0)
  {
    return cell;
  }
  if (this->Own && !this->Scaled)
  {
    this->Out.weightScale = this->Own->scale();
    this->Scaled = true;
  }
  const double flatness =
    this->Own ? this->Own->flatness() : flatnessFactor(this->Type, points, cell);
  if (flatness < 1.0)
  {
    ++this->Limited;
    this->LeastFlatness = std::min(this->LeastFlatness, flatness);
    for (double& weight : cell.weight)
    {
      weight *= flatness;
    }
  }
  return cell;
}

/** The corners belong together, with these weights of the edges, which are 0 if the cell is flat.
 */
void Assembly::connect(
  const std::int64_t* corners, const double* const* points, const CellWeights& cell)
{
  std::int32_t label = -1;
  for (int k = 0; k < cornersOf(this->Type); ++k)
  {
    const std::int32_t other = this->Labels[corners[k]];
    label = label < 0                     ? other
            : other < 0 || other == label ? label
                                          : this->Parts.join(label, other);
  }
  label = label < 0 ? this->Parts.add() : label;
  const double mass = cell.measure / cornersOf(this->Type);
  for (int k = 0; k < cornersOf(this->Type); ++k)
  {
    this->Labels[corners[k]] = label;
    this->Vertices.mass[corners[k]] += mass;
  }

  this->Edges.add(corners, points, cell, this->Own ? this->Own->scale() : 1.0,
    [](std::int64_t, std::int64_t) { return true; });
}

void Assembly::finalize(std::int64_t end)
{
  const bool targets = this->Given.hasEdgeTargets();
  while (this->Final < end)
  {
    const std::int64_t begin = this->Final;
    const std::int64_t stop = std::min(end, begin + BatchRows);
    this->Neighbours.clear();
    this->RowEnds.clear();
    for (std::int64_t i = begin; i < stop; ++i)
    {
      this->collectRow(i);
    }
    if (targets)
    {
      this->applyEdgeTargets(begin);
    }
    this->LabelBatch.clear();
    this->MassBatch.clear();
    std::size_t first = 0;
    for (std::int64_t i = begin; i < stop; ++i)
    {
      const std::size_t last = this->RowEnds[static_cast<std::size_t>(i - begin)];
      this->closeRow(i, std::span(this->Neighbours).subspan(first, last - first),
        targets ? this->Targets.data() + first * this->Columns : nullptr);
      if (this->Listener)
      {
        this->Listener->close(this->Vertices.points.at(i), this->Reach[i]);
      }
      first = last;
    }
    this->PartLabels.append(this->LabelBatch, this->MassBatch);
    this->Final = stop;
  }
  this->release();
}

/** Lets go of what no row to come needs. */
void Assembly::release()
{
  this->Vertices.release(this->Reach.advance(this->Final), this->Final);
  this->Labels.release(this->Final);
  this->Edges.release(this->Final);
  const auto release = [this](auto& optional)
  {
    if (optional)
    {
      optional->release(this->Final);
    }
  };
  release(this->Facets);
  release(this->CellLoads);
  release(this->FacetLoads);
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

void Assembly::applyEdgeTargets(std::int64_t begin)
{
  const Ring<double>& points = this->Vertices.points;
  const std::size_t edges = this->Neighbours.size();
  this->From.resize(edges);
  this->To.resize(edges);
  this->FromPoints.resize(3 * edges);
  this->ToPoints.resize(3 * edges);
  this->Targets.assign(edges * this->Columns, 0.0);
  std::int64_t i = begin;
  for (std::size_t e = 0; e < edges; ++e)
  {
    while (e >= this->RowEnds[static_cast<std::size_t>(i - begin)])
    {
      ++i;
    }
    this->From[e] = i;
    this->To[e] = this->Neighbours[e].to;
    std::copy_n(points.at(i), 3, this->FromPoints.data() + 3 * e);
    std::copy_n(points.at(this->To[e]), 3, this->ToPoints.data() + 3 * e);
  }
  EdgeBatch batch{ this->From, this->To, this->FromPoints, this->ToPoints, this->Targets };
  this->Given.edgeTargets(batch);
  if (!std::ranges::all_of(this->Targets, [](double v) { return std::isfinite(v); }))
  {
    throw Error("an edge target near vertex " + std::to_string(begin) + " is not a finite number");
  }
}

/** `target`: `columns` values a neighbour. */
void Assembly::closeRow(
  std::int64_t i, std::span<const RowNeighbour> neighbours, const double* target)
{
  if (this->Facets)
  {
    this->addBoundary(i);
  }
  const double mass = this->Vertices.mass[i];
  double alpha = this->Vertices.screening[i] * mass;
  for (std::size_t k = 0; k < this->Columns; ++k)
  {
    this->Load[k] = mass * this->Vertices.sources.at(i)[k];
  }
  for (const auto* loads : { &this->CellLoads, &this->FacetLoads })
  {
    if (*loads)
    {
      alpha += (*loads)->alpha(i);
      for (std::size_t k = 0; k < this->Columns; ++k)
      {
        this->Load[k] += (*loads)->load(i)[k];
      }
    }
  }
  const std::int32_t label = this->Labels[i] < 0 ? -1 : this->Parts.root(this->Labels[i]);
  this->LabelBatch.push_back(label);
  this->MassBatch.push_back(mass);
  this->Rows.close(i, label, neighbours, target, alpha, this->Load.data());
}

/** The boundary facets with the lowest corner i bring their share to all of their corners. */
void Assembly::addBoundary(std::int64_t i)
{
  this->Facets->take(i,
    [this](const BoundaryFacet& facet)
    {
      const double* points[3] = {};
      for (int k = 0; k < BoundaryFacet::cornersOf(this->Type); ++k)
      {
        points[k] = this->Vertices.points.at(facet.corners[k]);
      }
      this->FacetLoads->add(facet, facetArea(this->Type, points));
    });
}

} // namespace smg
