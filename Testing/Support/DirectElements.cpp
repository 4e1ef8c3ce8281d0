// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/DirectElements.h"

#include <Eigen/Dense>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <map>

namespace smg::testing
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

DirectElements::DirectElements(const ElementProblem& problem)
  : Given(problem)
{
  const StreamMesh& mesh = problem.mesh();
  const std::int64_t vertices = mesh.vertices();
  this->rightSide = this->source = MatrixXd::Zero(vertices, problem.Columns);
  this->mass = this->screening = VectorXd::Zero(vertices);
  for (std::int64_t cell = 0; cell < mesh.cells(); ++cell)
  {
    this->addCell(cell);
  }
  for (std::int64_t v = 0; v < vertices; ++v)
  {
    const ElementProblem::Point p = problem.vertex(v);
    if (problem.VertexSource)
    {
      this->source.row(v) += this->mass[v] * problem.VertexSource(p).transpose();
    }
    if (problem.VertexScreening)
    {
      this->screening[v] += this->mass[v] * problem.VertexScreening(p);
    }
  }
  this->rightSide += this->source;
  this->stiffness.resize(vertices, vertices);
  this->stiffness.setFromTriplets(this->StiffnessEntries.begin(), this->StiffnessEntries.end());
  this->matrix = this->stiffness;
  this->matrix.diagonal() += this->screening;
  this->addBoundary();
}

void DirectElements::addCell(std::int64_t cell)
{
  const StreamMesh& mesh = this->Given.mesh();
  const int size = cornersOf(mesh.cellType);
  const std::int64_t* corners = &mesh.corners[size * cell];
  // The columns of the Jacobian are edges; the rows of its pseudo-inverse are the gradients.
  MatrixXd jacobian(3, size - 1);
  for (int k = 1; k < size; ++k)
  {
    jacobian.col(k - 1) = this->Given.vertex(corners[k]) - this->Given.vertex(corners[0]);
  }
  const double measure = size == 3
                           ? jacobian.col(0).head<3>().cross(jacobian.col(1).head<3>()).norm() / 2
                           : std::abs(jacobian.determinant()) / 6;
  MatrixXd gradients(size, 3);
  // Not by the Gram matrix, which loses half of the digits of needles.
  gradients.bottomRows(size - 1) = jacobian.completeOrthogonalDecomposition().pseudoInverse();
  gradients.row(0) = -gradients.bottomRows(size - 1).colwise().sum();

  const ElementProblem::Point center = this->Given.centroid(cell);
  const Eigen::Matrix3d k =
    this->Given.Conductivity ? this->Given.Conductivity(center) : Eigen::Matrix3d::Identity();
  const MatrixXd element = measure * gradients * k * gradients.transpose();
  for (int i = 0; i < size; ++i)
  {
    const auto row = static_cast<Index>(corners[i]);
    this->mass[row] += measure / size;
    if (this->Given.CellScreening)
    {
      this->screening[row] += measure / size * this->Given.CellScreening(center);
    }
    if (this->Given.CellSource)
    {
      this->source.row(row) += measure / size * this->Given.CellSource(center).transpose();
    }
    if (this->Given.CellField)
    {
      this->rightSide.row(row) += measure * gradients.row(i) * this->Given.CellField(center);
    }
    for (int j = 0; j < size; ++j)
    {
      this->StiffnessEntries.emplace_back(
        static_cast<int>(row), static_cast<int>(corners[j]), element(i, j));
    }
  }
}

void DirectElements::addBoundary()
{
  const StreamMesh& mesh = this->Given.mesh();
  const int size = cornersOf(mesh.cellType);
  std::map<std::vector<std::int64_t>, int> cells;
  for (std::int64_t cell = 0; cell < mesh.cells(); ++cell)
  {
    for (int k = 0; k < size; ++k)
    {
      std::vector<std::int64_t> corners(
        &mesh.corners[size * cell], &mesh.corners[size * cell] + size);
      corners.erase(corners.begin() + k);
      std::ranges::sort(corners);
      ++cells[corners];
    }
  }
  for (const auto& [corners, count] : cells)
  {
    if (count != 1)
    {
      continue;
    }
    const ElementProblem::Point a = this->Given.vertex(corners[0]);
    const ElementProblem::Point b = this->Given.vertex(corners[1]);
    const double area =
      size == 3 ? (b - a).norm() : (b - a).cross(this->Given.vertex(corners[2]) - a).norm() / 2;
    this->boundary.push_back({ corners, area });
    const int flux = this->Given.conditionOf(this->Given.FluxConditions, corners);
    const int robin = this->Given.conditionOf(this->Given.RobinConditions, corners);
    for (const std::int64_t v : corners)
    {
      const double share = area / static_cast<double>(corners.size());
      const ElementProblem::Point p = this->Given.vertex(v);
      if (flux >= 0)
      {
        this->rightSide.row(v) += share * this->Given.FluxConditions[flux].value(p).transpose();
      }
      if (robin >= 0)
      {
        const ElementProblem::Robin& given = this->Given.RobinConditions[robin];
        this->matrix.coeffRef(v, v) += share * given.coefficient(p);
        this->rightSide.row(v) += share * given.coefficient(p) * given.ambient(p).transpose();
      }
    }
  }
}

MatrixXd DirectElements::solve() const
{
  const Index vertices = this->matrix.rows();
  Eigen::SparseMatrix<double> system = this->matrix;
  MatrixXd b = this->rightSide;
  MatrixXd initial = MatrixXd::Zero(vertices, this->Given.Columns);
  bool known = false;
  for (Index v = 0; v < vertices; ++v)
  {
    const int condition = this->Given.dirichletOf(v);
    const ElementProblem::Point p = this->Given.vertex(v);
    if (condition >= 0)
    {
      // The row becomes u_v = value; other rows keep their entry in this column.
      for (Eigen::SparseMatrix<double>::InnerIterator entry(system, v); entry; ++entry)
      {
        system.coeffRef(v, entry.row()) = 0.0;
      }
      system.coeffRef(v, v) = 1.0;
      b.row(v) = this->Given.DirichletConditions[condition].value(p);
      known = true;
    }
    else if (this->Given.Initial)
    {
      initial.row(v) = this->Given.Initial(p);
    }
  }
  const bool singular = !known && (system * VectorXd::Ones(vertices)).cwiseAbs().maxCoeff() <
                                    1e-9 * system.diagonal().maxCoeff();
  if (singular)
  {
    b -= this->mass * b.colwise().sum() / this->mass.sum();
    system.coeffRef(0, 0) *= 2.0;
  }
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(system);
  MatrixXd u = factor.solve(b);
  if (singular)
  {
    u.rowwise() += (this->mass.transpose() * (initial - u) / this->mass.sum()).row(0);
  }
  return u;
}

} // namespace smg::testing
