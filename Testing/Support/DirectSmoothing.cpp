// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Support/DirectSmoothing.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

namespace smg::testing
{
namespace
{

/** The gradients of the basis functions of a cell, one a row, and its measure. */
struct Element
{
  Eigen::MatrixXd gradients;
  double measure;
};

Element elementOf(const StreamMesh& mesh, const Eigen::MatrixXd& points, std::int64_t cell)
{
  const int corners = cornersOf(mesh.cellType);
  Eigen::MatrixXd jacobian(3, corners - 1);
  const auto point = [&](int k) -> Eigen::Vector3d
  { return points.row(mesh.corners[static_cast<std::size_t>(corners * cell + k)]); };
  for (int k = 1; k < corners; ++k)
  {
    jacobian.col(k - 1) = point(k) - point(0);
  }
  const Eigen::MatrixXd metric = jacobian.transpose() * jacobian;
  Element element{ Eigen::MatrixXd(corners, 3),
    std::sqrt(metric.determinant()) / (corners == 3 ? 2.0 : 6.0) };
  element.gradients.bottomRows(corners - 1) = metric.inverse() * jacobian.transpose();
  element.gradients.row(0) = -element.gradients.bottomRows(corners - 1).colwise().sum();
  return element;
}

} // namespace

Eigen::MatrixXd pointsOf(const StreamMesh& mesh)
{
  Eigen::MatrixXd points(mesh.vertices(), 3);
  for (std::int64_t v = 0; v < mesh.vertices(); ++v)
  {
    points.row(v) = Eigen::RowVector3d(&mesh.positions[static_cast<std::size_t>(3 * v)]);
  }
  return points;
}

Eigen::VectorXd lumpedMass(const StreamMesh& mesh, const Eigen::MatrixXd& points)
{
  const int corners = cornersOf(mesh.cellType);
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(mesh.vertices());
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    const double share = elementOf(mesh, points, c).measure / corners;
    for (int k = 0; k < corners; ++k)
    {
      mass[mesh.corners[static_cast<std::size_t>(corners * c + k)]] += share;
    }
  }
  return mass;
}

Eigen::SparseMatrix<double> stiffness(const StreamMesh& mesh, const Eigen::MatrixXd& points)
{
  const int corners = cornersOf(mesh.cellType);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    const Element element = elementOf(mesh, points, c);
    const Eigen::MatrixXd local =
      element.measure * element.gradients * element.gradients.transpose();
    const std::int64_t* corner = &mesh.corners[static_cast<std::size_t>(corners * c)];
    for (int i = 0; i < corners; ++i)
    {
      for (int j = 0; j < corners; ++j)
      {
        entries.emplace_back(corner[i], corner[j], local(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(mesh.vertices(), mesh.vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double enclosedVolume(const StreamMesh& mesh, const Eigen::MatrixXd& points)
{
  double volume = 0.0;
  const auto point = [&](std::int64_t k) -> Eigen::Vector3d
  { return points.row(mesh.corners[static_cast<std::size_t>(k)]); };
  for (std::int64_t c = 0; c < mesh.cells(); ++c)
  {
    volume += point(3 * c).dot(point(3 * c + 1).cross(point(3 * c + 2))) / 6.0;
  }
  return volume;
}

Eigen::MatrixXd smoothDirectly(const Eigen::VectorXd& mass, const Eigen::SparseMatrix<double>& L,
  double t, const Eigen::MatrixXd& x, const std::vector<std::uint8_t>& held)
{
  // Rows of held vertices are those of the identity; their columns go to the right-hand side.
  const auto isHeld = [&](Eigen::Index v)
  { return !held.empty() && held[static_cast<std::size_t>(v)] != 0; };
  Eigen::MatrixXd b = mass.asDiagonal() * x;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < L.outerSize(); ++j)
  {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(L, j); entry; ++entry)
    {
      if (!isHeld(entry.row()) && isHeld(j))
      {
        b.row(entry.row()) -= t * entry.value() * x.row(j);
      }
      else if (!isHeld(entry.row()))
      {
        entries.emplace_back(entry.row(), j, t * entry.value());
      }
    }
    entries.emplace_back(j, j, isHeld(j) ? 1.0 : mass[j]);
  }
  for (Eigen::Index j = 0; j < L.outerSize(); ++j)
  {
    if (isHeld(j))
    {
      b.row(j) = x.row(j);
    }
  }
  Eigen::SparseMatrix<double> matrix(L.rows(), L.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  return factor.solve(b);
}

} // namespace smg::testing
