// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/DirectElements.h"
#include "Testing/Support/StreamMesh.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace smg::testing
{

/** The minimum itself, with the blended values as the unknowns, by finite elements in memory. */
class DirectBlend
{
public:
  explicit DirectBlend(const StreamMesh& mesh)
    : Mesh(mesh)
    , System(mesh)
  {
    this->System.Columns = mesh.vertexColumns[1].spec.components;
    for (std::int64_t v = 0; v < mesh.vertices(); ++v)
    {
      this->VertexAt[key(this->System.vertex(v))] = v;
    }
    for (std::int64_t c = 0; c < mesh.cells(); ++c)
    {
      this->CellAt[key(this->System.centroid(c))] = c;
    }
  }

  /** Aims at averaged gradients in cells between patches. */
  DirectBlend& averaged()
  {
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(3, this->System.Columns);
    this->Around.assign(static_cast<std::size_t>(this->Mesh.vertices()), { 0.0, none });
    for (std::int64_t c = 0; c < this->Mesh.cells(); ++c)
    {
      const Eigen::MatrixXd edges = this->edges(c);
      const double measure = std::sqrt((edges * edges.transpose()).determinant());
      for (int k = 0; k < cornersOf(this->Mesh.cellType) && this->isInside(c); ++k)
      {
        Inside& around = this->Around[this->corners(c)[k]];
        around.measure += measure;
        around.sum += measure * this->gradient(c);
      }
    }
    return *this;
  }

  Eigen::MatrixXd solve(double anchor, const ElementProblem::Where& held = {})
  {
    const auto points =
      Eigen::Map<const Eigen::Matrix3Xd>(this->Mesh.positions.data(), 3, this->Mesh.vertices());
    const double screening =
      anchor / (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).squaredNorm();
    const auto value = [this](const Point& p) { return this->values(this->VertexAt.at(key(p))); };
    this->System.VertexScreening = [=](const Point&) { return screening; };
    this->System.VertexSource = [=](const Point& p) -> Eigen::VectorXd
    { return screening * value(p); };
    this->System.Initial = value;
    this->System.CellField = [this](const Point& p)
    { return this->field(this->CellAt.at(key(p))); };
    if (held)
    {
      this->System.DirichletConditions = { { held, value } };
    }
    return DirectElements(this->System).solve();
  }

private:
  using Point = ElementProblem::Point;
  using Key = std::array<double, 3>;
  static Key key(const Point& p) { return { p[0], p[1], p[2] }; }

  Eigen::VectorXd values(std::int64_t v) const
  {
    Eigen::VectorXd values(this->System.Columns);
    for (int k = 0; k < this->System.Columns; ++k)
    {
      values[k] = this->Mesh.vertexColumns[1].value(v, k);
    }
    return values;
  }

  const std::int64_t* corners(std::int64_t cell) const
  {
    return &this->Mesh.corners[cornersOf(this->Mesh.cellType) * cell];
  }

  /** Whether a cell lies in one patch. */
  bool isInside(std::int64_t cell) const
  {
    const auto patch = [&](int k)
    { return this->Mesh.vertexColumns[0].value(this->corners(cell)[k]); };
    bool inside = true;
    for (int k = 1; k < cornersOf(this->Mesh.cellType); ++k)
    {
      inside = inside && patch(k) == patch(0);
    }
    return inside;
  }

  /** The edges from the first corner of a cell, one a row. */
  Eigen::MatrixXd edges(std::int64_t cell) const
  {
    const int size = cornersOf(this->Mesh.cellType);
    Eigen::MatrixXd edges(size - 1, 3);
    for (int j = 1; j < size; ++j)
    {
      edges.row(j - 1) =
        this->System.vertex(this->corners(cell)[j]) - this->System.vertex(this->corners(cell)[0]);
    }
    return edges;
  }

  /** The gradient of each column in a cell, by least squares. */
  Eigen::MatrixXd gradient(std::int64_t cell) const
  {
    const std::int64_t* corner = this->corners(cell);
    const Eigen::MatrixXd edges = this->edges(cell);
    Eigen::MatrixXd steps(edges.rows(), this->System.Columns);
    for (Eigen::Index j = 0; j < steps.rows(); ++j)
    {
      steps.row(j) = this->values(corner[j + 1]) - this->values(corner[0]);
    }
    // The smallest solution is that in the plane of a triangle.
    return edges.completeOrthogonalDecomposition().solve(steps);
  }

  /** The gradient that is aimed at in a cell. */
  Eigen::MatrixXd field(std::int64_t cell) const
  {
    if (this->isInside(cell))
    {
      return this->gradient(cell);
    }
    Inside around{ 0.0, Eigen::MatrixXd::Zero(3, this->System.Columns) };
    for (int k = 0; k < cornersOf(this->Mesh.cellType) && !this->Around.empty(); ++k)
    {
      around.measure += this->Around[this->corners(cell)[k]].measure;
      around.sum += this->Around[this->corners(cell)[k]].sum;
    }
    return around.measure > 0.0 ? Eigen::MatrixXd(around.sum / around.measure) : around.sum;
  }

  /** Of the cells around a vertex that lie in one patch, without common factors. */
  struct Inside
  {
    double measure = 0.0;
    Eigen::MatrixXd sum; ///< of the gradients times the measures
  };

  const StreamMesh& Mesh;
  ElementProblem System;
  std::map<Key, std::int64_t> VertexAt, CellAt;
  std::vector<Inside> Around; ///< of each vertex, if gradients between patches are averaged
};

} // namespace smg::testing
