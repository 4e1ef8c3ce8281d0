// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/Problem.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace smg::testing
{

/**
 * -div(K grad u - q) + s u = f with any data, from functions of the position, evaluated at the
 * centroids of cells, at the vertices, and at the corners of facets. A missing function means zero,
 * for K 1.
 */
class ElementProblem : public Problem
{
public:
  using Point = Eigen::Vector3d;
  template <class T>
  using Field = std::function<T(const Point&)>;
  using Values = Field<Eigen::VectorXd>; ///< `Columns` numbers
  using Where = Field<bool>;

  /** A condition on facets, selected by their corners. */
  struct Flux
  {
    Where where;
    Values value;
  };
  struct Robin
  {
    Where where;
    Field<double> coefficient;
    Values ambient;
  };
  struct Dirichlet
  {
    Where where;
    Values value;
  };

  /** `mesh` must outlive the problem. */
  explicit ElementProblem(const StreamMesh& mesh)
    : Mesh(mesh)
  {
  }

  int Columns = 1;
  Weights EdgeWeights = Weights::Cotangent;
  Field<Eigen::Matrix3d> Conductivity;
  Field<int> Part; ///< below `Parts`
  int Parts = 0;
  Field<double> VertexScreening, CellScreening;
  Values VertexSource, CellSource, Initial;
  Field<Eigen::MatrixXd> CellField; ///< 3 x `Columns`
  /** The first condition that selects a vertex or all corners of a facet applies. */
  std::vector<Dirichlet> DirichletConditions;
  std::vector<Flux> FluxConditions;
  std::vector<Robin> RobinConditions;
  bool KeepsUndetermined = true;

  const StreamMesh& mesh() const { return this->Mesh; }
  Point vertex(std::int64_t v) const { return Point::Map(&this->Mesh.positions[3 * v]); }
  Point centroid(std::int64_t cell) const;
  /** The condition of a vertex or of a facet with these corners; -1: none. */
  int dirichletOf(std::int64_t v) const;
  template <class Condition>
  int conditionOf(
    const std::vector<Condition>& conditions, const std::vector<std::int64_t>& corners) const;

  int columns() const override { return this->Columns; }
  Weights weights() const override { return this->EdgeWeights; }
  bool keepsUndetermined() const override { return this->KeepsUndetermined; }
  bool hasCells() const override;
  void cells(CellBatch& batch) override;
  bool hasFacets() const override
  {
    return !this->FluxConditions.empty() || !this->RobinConditions.empty();
  }
  void facets(FacetBatch& batch) override;
  ConditionCounts conditionCounts() const override;
  void conditions(const MeshBlock& block, VertexConditions& conditions) override;

private:
  const StreamMesh& Mesh;
};

template <class Condition>
int ElementProblem::conditionOf(
  const std::vector<Condition>& conditions, const std::vector<std::int64_t>& corners) const
{
  for (std::size_t k = 0; k < conditions.size(); ++k)
  {
    if (std::ranges::all_of(
          corners, [&](std::int64_t v) { return conditions[k].where(this->vertex(v)); }))
    {
      return static_cast<int>(k);
    }
  }
  return -1;
}

} // namespace smg::testing
