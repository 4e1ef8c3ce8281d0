// SPDX-License-Identifier: BSD-3-Clause
#include "Solver/Assembly/CellAssembly.h"

#include <algorithm>

// What cells contribute to their vertices and edges: stiffness weights, lumped masses, loads, and
// the connected components.
//
// The work on a cell has two halves. weigh() asks the problem and computes the weights and loads;
// connect() adds the weights to the edges, the masses to the vertices, and joins the components.
// Both take the cells in the order of the stream, so that every sum has the same bits whether the
// halves alternate on one thread or run at the same time on two. The time per cell is constant.

namespace smg
{

CellAssembly::CellAssembly(Pool& pool, CellType type, Problem& problem, double& scale,
  Components& components, ComponentLabels& labels, Solution* solution)
  : cells(type, problem)
  , vertices(pool, problem, solution)
  , parts(pool, components, labels)
  , edges(pool, problem, type)
  , loads(pool, type, problem, this->vertices)
  , Scale(scale)
{
  this->counts.measures.areWeights =
    !this->cells.hasData() && this->cells.kind() != Weights::Uniform;
}

void CellAssembly::add(const MeshBlock& block)
{
  // A few cells at a time, whose weights remain in the cache between the two halves.
  constexpr std::size_t Batch = 256;
  this->addVertices(block);
  this->extend(this->vertices.end());
  const std::size_t count = cellsOf(this->cells.type(), block);
  for (std::size_t begin = 0; begin < count; begin += Batch)
  {
    this->Weighed.clear();
    this->weigh(block, begin, std::min(count, begin + Batch), this->Weighed);
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
  const std::size_t count = cellsOf(this->cells.type(), block);
  to.cells.reserve(count);
  this->weigh(block, 0, count, to.cells);
  to.vertices = this->vertices.end();
  to.finalized = block.finalized;
}

void CellAssembly::connect(const ElementMatrices& cells)
{
  this->extend(cells.vertices);
  this->connect(cells.cells);
}

/** Adds what the weighing half uses; extend() adds what only connect() uses, on its own thread. */
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
  this->cells.forRange(
    block, begin, end, this->vertices, [&](const WeightedCell& cell) { this->weigh(cell, to); });
}

void CellAssembly::weigh(const WeightedCell& cell, std::vector<ElementMatrix>& to)
{
  const CellType type = this->cells.type();
  this->counts.add(type, cell);
  const bool isWeighted = cell.weights.measure != 0.0;
  if (isWeighted && cell.data && !this->Scaled && this->cells.kind() == Weights::Cotangent)
  {
    // Of the first weighted cell of the stream, whatever the size of blocks.
    this->Scale = cell.scale;
    this->Scaled = true;
  }
  // A flat cell that connects its corners is kept with weights of 0: its edges get the smallest
  // weight.
  if (cell.connects)
  {
    ElementMatrix& matrix = to.emplace_back();
    std::copy_n(cell.corners, cornersOf(type), matrix.corners);
    matrix.weights = cell.stiffness();
    matrix.scale = cell.scale;
  }
  // A cell without measure has no share of sources, screening, fields or jumps.
  if (isWeighted && (cell.data || this->vertices.ties.anyJump()))
  {
    this->loads.addCell(cell);
  }
}

void CellAssembly::connect(std::span<const ElementMatrix> cells)
{
  for (const ElementMatrix& cell : cells)
  {
    this->connect(cell);
  }
}

/** Adds the weights and the mass of a cell to its edges and corners, which become one component. */
void CellAssembly::connect(const ElementMatrix& cell)
{
  const int count = cornersOf(this->cells.type());
  std::int64_t nodes[4] = {};
  std::transform(cell.corners, cell.corners + count, nodes,
    [this](std::int64_t corner) { return this->vertices.ties.node(corner); });
  this->parts.join(nodes, count);
  // Lumping: each corner has the same share of the area or volume. The masses are written here
  // though weigh() extends their ring: reserve() has made room, so that it does not move meanwhile.
  const double mass = cell.weights.measure / count;
  const double* points[4] = {};
  for (int k = 0; k < count; ++k)
  {
    this->vertices.mass[cell.corners[k]] += mass;
    points[k] = this->vertices.points.at(cell.corners[k]);
  }
  if (this->cells.hasData() && cell.weights.measure > 0.0)
  {
    this->LeastScale = this->LeastScale > 0.0 ? std::min(this->LeastScale, cell.scale) : cell.scale;
    this->MostScale = std::max(this->MostScale, cell.scale);
  }
  for (int k = 0; this->cells.hasData() && k < count; ++k)
  {
    // The largest scale at a vertex decides which weights of its row are usual; see
    // RowAssembly::addEdge().
    float& scale = this->vertices.scale[nodes[k]];
    scale = std::max(scale, static_cast<float>(cell.scale));
  }
  // Corners that are one unknown have no edge.
  this->edges.add(
    nodes, points, cell.weights, cell.scale, [](std::int64_t a, std::int64_t b) { return a != b; });
}

double CellAssembly::couple(std::int64_t i)
{
  if (this->vertices.ties.isTied(i))
  {
    return 0.0;
  }
  this->vertices.ties.forLinks(i,
    [&](const VertexCouplings::Link& link)
    {
      const std::int64_t ends[] = { i, link.to };
      this->parts.join(ends, 2);
      this->edges.addLink(i, link.to, link.conductance);
    });
  double mass = 0.0;
  this->vertices.ties.forVerticesOf(
    i, [&](std::int64_t vertex) { mass += this->vertices.mass[vertex]; });
  return mass;
}

} // namespace smg
