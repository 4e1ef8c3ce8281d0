// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/DirectSystem.h"

#include "Solver/Core/DisjointSets.h"
#include "Testing/Support/AllIndices.h"
#include "Testing/Support/EdgeWeights.h"

#include <algorithm>
#include <utility>

namespace smg::testing
{
namespace
{

/** Reads the stream: conditions of the vertices, weights of the cells. */
class Assembly
{
public:
  Assembly(MeshSource& mesh, Problem& problem)
    : Mesh(mesh)
    , Asked(problem)
    , Columns(problem.columns())
    , Vertices(mesh.info().vertices)
    , Edges(mesh.info(), problem.weights(), problem.connectsFlatCells())
  {
    this->System.values = Eigen::MatrixXd::Zero(this->Vertices, this->Columns);
    this->Source = Eigen::MatrixXd::Zero(this->Vertices, this->Columns);
  }

  DirectSystem run()
  {
    MeshBlock block;
    while (this->Mesh.next(block))
    {
      this->takeVertices(block);
      this->Edges.add(block, this->Positions);
    }
    this->Edges.finish(this->Positions);
    this->System.mass = this->Edges.mass();
    this->System.degenerateCells = this->Edges.degenerateCells();
    this->System.clampedWeights = this->Edges.clampedWeights();
    this->numberUnknowns();
    this->fillMatrix();
    this->fillRightSide();
    this->findComponents();
    return std::move(this->System);
  }

private:
  void takeVertices(const MeshBlock& block);
  void numberUnknowns();
  void fillMatrix();
  void fillRightSide();
  Eigen::VectorXd edgeTarget(const EdgeWeight& edge, bool forward);
  void findComponents();

  MeshSource& Mesh;
  Problem& Asked;
  int Columns;
  std::int64_t Vertices;
  EdgeWeights Edges;
  std::vector<double> Positions;
  std::vector<std::uint8_t> Prescribed;
  std::vector<double> Screening;
  Eigen::MatrixXd Source;
  std::vector<std::int32_t> Unknown; ///< index of the unknown of each vertex, or -1
  DirectSystem System;
};

void Assembly::takeVertices(const MeshBlock& block)
{
  const std::int64_t count = block.vertices();
  VertexConditions conditions;
  conditions.dirichlet.assign(count, -1);
  conditions.value.assign(count * this->Columns, 0.0);
  conditions.source.assign(count * this->Columns, 0.0);
  conditions.screening.assign(count, 0.0);
  if (count > 0)
  {
    this->Asked.conditions(block, conditions);
  }
  this->Positions.insert(this->Positions.end(), block.positions.begin(), block.positions.end());
  this->Screening.insert(
    this->Screening.end(), conditions.screening.begin(), conditions.screening.end());
  for (std::int64_t v = 0; v < count; ++v)
  {
    this->Prescribed.push_back(conditions.dirichlet[v] >= 0);
    for (int k = 0; k < this->Columns; ++k)
    {
      this->System.values(block.firstVertex + v, k) = conditions.value[v * this->Columns + k];
      this->Source(block.firstVertex + v, k) = conditions.source[v * this->Columns + k];
    }
  }
}

void Assembly::numberUnknowns()
{
  std::vector<std::uint8_t> isUsed(this->Vertices, 0);
  for (const EdgeWeight& edge : this->Edges.edges())
  {
    isUsed[edge.from] = 1;
    isUsed[edge.to] = 1;
  }
  this->Unknown.assign(this->Vertices, -1);
  for (std::int64_t v = 0; v < this->Vertices; ++v)
  {
    if (this->Prescribed[v])
    {
      ++this->System.prescribed;
    }
    else if (!isUsed[v])
    {
      ++this->System.held;
    }
    else
    {
      this->Unknown[v] = static_cast<std::int32_t>(this->System.freeVertices.size());
      this->System.freeVertices.push_back(v);
    }
  }
}

void Assembly::fillMatrix()
{
  const auto unknowns = static_cast<Eigen::Index>(this->System.freeVertices.size());
  Eigen::VectorXi rowSizes = Eigen::VectorXi::Ones(unknowns);
  Eigen::VectorXd diagonal(unknowns);
  for (Eigen::Index i = 0; i < unknowns; ++i)
  {
    const std::int64_t v = this->System.freeVertices[i];
    diagonal[i] = this->Screening[v] * this->System.mass[v];
  }
  for (const EdgeWeight& edge : this->Edges.edges())
  {
    const std::int32_t ends[2] = { this->Unknown[edge.from], this->Unknown[edge.to] };
    for (const std::int32_t end : ends)
    {
      if (end >= 0)
      {
        diagonal[end] += edge.weight;
        rowSizes[end] += ends[0] >= 0 && ends[1] >= 0;
      }
    }
  }
  Eigen::SparseMatrix<double>& matrix = this->System.matrix;
  matrix.resize(unknowns, unknowns);
  matrix.reserve(rowSizes);
  for (Eigen::Index i = 0; i < unknowns; ++i)
  {
    matrix.insert(i, i) = diagonal[i];
  }
  for (const EdgeWeight& edge : this->Edges.edges())
  {
    const std::int32_t i = this->Unknown[edge.from];
    const std::int32_t j = this->Unknown[edge.to];
    if (i >= 0 && j >= 0)
    {
      matrix.insert(i, j) = -edge.weight;
      matrix.insert(j, i) = -edge.weight;
    }
  }
  if (matrix.rows() > 0)
  {
    matrix.makeCompressed();
  }
}

Eigen::VectorXd Assembly::edgeTarget(const EdgeWeight& edge, bool forward)
{
  const std::int64_t from = forward ? edge.from : edge.to;
  const std::int64_t to = forward ? edge.to : edge.from;
  Eigen::VectorXd target = Eigen::VectorXd::Zero(this->Columns);
  EdgeBatch batch{ { &from, 1 }, { &to, 1 }, { &this->Positions[3 * from], 3 },
    { &this->Positions[3 * to], 3 }, { target.data(), static_cast<std::size_t>(this->Columns) } };
  this->Asked.edgeTargets(batch);
  return target;
}

void Assembly::fillRightSide()
{
  DirectSystem& system = this->System;
  const auto unknowns = static_cast<Eigen::Index>(system.freeVertices.size());
  system.rightSide.resize(unknowns, this->Columns);
  for (Eigen::Index i = 0; i < unknowns; ++i)
  {
    const std::int64_t v = system.freeVertices[i];
    system.rightSide.row(i) = system.mass[v] * this->Source.row(v);
  }
  const bool hasTargets = this->Asked.hasEdgeTargets();
  for (const EdgeWeight& edge : this->Edges.edges())
  {
    for (const bool forward : { true, false })
    {
      const std::int32_t v = forward ? edge.from : edge.to;
      const std::int32_t neighbour = forward ? edge.to : edge.from;
      const std::int32_t i = this->Unknown[v];
      if (i < 0)
      {
        continue;
      }
      if (this->Unknown[neighbour] < 0)
      {
        system.rightSide.row(i) += edge.weight * system.values.row(neighbour);
      }
      if (hasTargets)
      {
        system.rightSide.row(i) += edge.weight * this->edgeTarget(edge, forward).transpose();
      }
    }
  }
}

void Assembly::findComponents()
{
  DisjointSets<std::int32_t> sets(this->Vertices);
  for (const EdgeWeight& edge : this->Edges.edges())
  {
    sets.join(edge.from, edge.to);
  }
  std::vector<int> number(this->Vertices, -1);
  this->System.component.reserve(this->System.freeVertices.size());
  for (const std::int64_t v : this->System.freeVertices)
  {
    int& component = number[sets.first(static_cast<std::int32_t>(v))];
    if (component < 0)
    {
      component = static_cast<int>(this->System.isFloating.size());
      this->System.isFloating.push_back(1);
    }
    this->System.component.push_back(component);
  }
  for (std::int64_t v = 0; v < this->Vertices; ++v)
  {
    const int component = number[sets.first(static_cast<std::int32_t>(v))];
    if (component >= 0 && (this->Prescribed[v] || this->Screening[v] * this->System.mass[v] > 0))
    {
      this->System.isFloating[component] = 0;
    }
  }
}

} // namespace

Eigen::MatrixXd DirectSystem::initial() const
{
  return this->gather(this->values);
}

Eigen::MatrixXd DirectSystem::gather(const Eigen::MatrixXd& allVertices) const
{
  return allVertices(this->freeVertices, AllIndices);
}

Eigen::MatrixXd DirectSystem::scatter(const Eigen::MatrixXd& unknowns) const
{
  Eigen::MatrixXd all = this->values;
  all(this->freeVertices, AllIndices) = unknowns;
  return all;
}

double DirectSystem::residualOfConstants() const
{
  const Eigen::VectorXd rowSums = this->matrix * Eigen::VectorXd::Ones(this->unknowns());
  const Eigen::RowVectorXd constants =
    rowSums.transpose() * this->rightSide / rowSums.squaredNorm();
  return (this->rightSide - rowSums * constants).norm();
}

double DirectSystem::relativeResidual(const Eigen::MatrixXd& allVertices) const
{
  return (this->rightSide - this->matrix * this->gather(allVertices)).norm() /
         this->residualOfConstants();
}

DirectSystem assembleDirect(MeshSource& mesh, Problem& problem)
{
  return Assembly(mesh, problem).run();
}

} // namespace smg::testing
