// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Problem/CellAssembly.h"

namespace smg
{

CellAssembly::CellAssembly(Pool& pool, CellType type, Problem& problem, double& scale,
  Components& components, ComponentLabels& labels)
  : policy(type, problem, scale)
  , vertices(pool, problem)
  , parts(pool, components, labels)
  , edges(pool, problem, type)
  , loads(pool, type, problem, this->vertices)
  , Type(type)
{
}

void CellAssembly::add(const MeshBlock& block)
{
  this->addVertices(block);
  this->addCells(block);
  this->loads.addFacets(block);
}

void CellAssembly::addVertices(const MeshBlock& block)
{
  this->vertices.add(block);
  const std::int64_t end = this->vertices.end();
  this->parts.extend(end);
  this->edges.extend(end);
  this->loads.extend(end);
}

void CellAssembly::addCells(const MeshBlock& block)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  const auto cells = block.corners.size() / corners;
  const Column* flags = block.flags();
  for (std::size_t c = 0; c < cells; ++c)
  {
    this->policy.prepare(block, c, this->vertices.points);
    this->addCell(
      block.corners.data() + c * corners, flags ? static_cast<unsigned>(flags->value(c)) : 0U);
  }
}

void CellAssembly::addCell(const std::int64_t* corners, unsigned flags)
{
  const double* points[4] = {};
  const int count = cornersOf(this->Type);
  for (int k = 0; k < count; ++k)
  {
    points[k] = this->vertices.points.at(corners[k]);
  }
  const CellWeights cell = this->policy.weigh(corners, points, flags);
  const bool degenerate = cell.measure == 0.0;
  if (!degenerate || this->policy.connectsFlat(corners, flags))
  {
    this->connect(corners, points, cell);
  }
  if (!degenerate && this->policy.own())
  {
    this->loads.addCell(corners, points, *this->policy.own());
  }
}

/** Connects the corners, with these weights of the edges, which are 0 if the cell is flat. */
void CellAssembly::connect(
  const std::int64_t* corners, const double* const* points, const CellWeights& cell)
{
  const int count = cornersOf(this->Type);
  this->parts.join(corners, count);
  const double mass = cell.measure / count;
  for (int k = 0; k < count; ++k)
  {
    this->vertices.mass[corners[k]] += mass;
  }
  this->edges.add(
    corners, points, cell, this->policy.scale(), [](std::int64_t, std::int64_t) { return true; });
}

} // namespace smg
