// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/CellAssembly.h"

#include <algorithm>

namespace smg
{
namespace
{

std::size_t cellsOf(const MeshBlock& block, CellType type)
{
  return block.corners.size() / static_cast<std::size_t>(cornersOf(type));
}

} // namespace

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
  // A few cells at a time: their weights remain in the cache.
  constexpr std::size_t Batch = 256;
  this->addVertices(block);
  this->extend(this->vertices.end());
  const std::size_t cells = cellsOf(block, this->Type);
  for (std::size_t begin = 0; begin < cells; begin += Batch)
  {
    this->Weighed.clear();
    this->weigh(block, begin, std::min(cells, begin + Batch), this->Weighed);
    this->connect(this->Weighed);
  }
  this->loads.addFacets(block);
}

void CellAssembly::reserve(std::int64_t vertices)
{
  this->vertices.reserve(vertices);
  this->loads.reserve(vertices);
}

void CellAssembly::weigh(const MeshBlock& block, ElementMatrices& to)
{
  this->addVertices(block);
  const std::size_t cells = cellsOf(block, this->Type);
  to.cells.reserve(cells);
  this->weigh(block, 0, cells, to.cells);
  to.vertices = this->vertices.end();
  to.finalized = block.finalized;
}

void CellAssembly::connect(const ElementMatrices& cells)
{
  this->extend(cells.vertices);
  this->connect(cells.cells);
}

void CellAssembly::addVertices(const MeshBlock& block)
{
  this->vertices.add(block);
  this->loads.extend(this->vertices.end());
}

void CellAssembly::extend(std::int64_t vertices)
{
  this->parts.extend(vertices);
  this->edges.extend(vertices);
}

/** Weighs these cells of the block. */
void CellAssembly::weigh(
  const MeshBlock& block, std::size_t begin, std::size_t end, std::vector<ElementMatrix>& to)
{
  const auto corners = static_cast<std::size_t>(cornersOf(this->Type));
  const Column* flags = block.flags();
  for (std::size_t c = begin; c < end; ++c)
  {
    this->policy.prepare(block, c, this->vertices.points);
    this->weigh(
      block.corners.data() + c * corners, flags ? static_cast<unsigned>(flags->value(c)) : 0U, to);
  }
}

/** Weighs the prepared cell. */
void CellAssembly::weigh(
  const std::int64_t* corners, unsigned flags, std::vector<ElementMatrix>& to)
{
  const double* points[4] = {};
  const int count = cornersOf(this->Type);
  for (int k = 0; k < count; ++k)
  {
    points[k] = this->vertices.points.at(corners[k]);
  }
  const CellWeights weights = this->policy.weigh(corners, points, flags);
  const bool degenerate = weights.measure == 0.0;
  if (!degenerate || this->policy.connectsFlat(corners, flags))
  {
    ElementMatrix& cell = to.emplace_back();
    std::copy_n(corners, count, cell.corners);
    cell.weights = weights;
    cell.scale = this->policy.scale();
  }
  if (!degenerate && this->policy.own())
  {
    this->loads.addCell(corners, points, *this->policy.own());
  }
}

void CellAssembly::connect(std::span<const ElementMatrix> cells)
{
  for (const ElementMatrix& cell : cells)
  {
    this->connect(cell);
  }
}

void CellAssembly::connect(const ElementMatrix& cell)
{
  const int count = cornersOf(this->Type);
  this->parts.join(cell.corners, count);
  const double mass = cell.weights.measure / count;
  const double* points[4] = {};
  for (int k = 0; k < count; ++k)
  {
    this->vertices.mass[cell.corners[k]] += mass;
    points[k] = this->vertices.points.at(cell.corners[k]);
  }
  for (int k = 0; this->policy.own() && k < count; ++k)
  {
    float& scale = this->vertices.scale[cell.corners[k]];
    scale = std::max(scale, static_cast<float>(cell.scale));
  }
  this->edges.add(cell.corners, points, cell.weights, cell.scale,
    [](std::int64_t, std::int64_t) { return true; });
}

} // namespace smg
