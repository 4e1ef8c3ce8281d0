// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Random/Shapes.h"

#include <Eigen/Dense>

#include <cmath>

namespace smg::testing
{

using Eigen::MatrixXd;
using Eigen::Vector3d;

Shapes::Shapes(const Case& given)
  : gradients(static_cast<std::size_t>(given.cells()))
  , measure(Eigen::VectorXd::Zero(given.cells()))
{
  const std::vector<std::uint8_t> flags = given.flags();
  const int size = cornersOf(given.type);
  for (std::int64_t c = 0; c < given.cells(); ++c)
  {
    const auto index = static_cast<std::size_t>(c);
    if (flags[index] != 0)
    {
      continue;
    }
    const auto point = [&](int k) -> Vector3d
    { return Vector3d::Map(&given.points[3 * static_cast<std::size_t>(given.cell(c)[k])]); };
    MatrixXd jacobian(3, size - 1);
    for (int k = 1; k < size; ++k)
    {
      jacobian.col(k - 1) = point(k) - point(0);
    }
    const MatrixXd others = jacobian.completeOrthogonalDecomposition().pseudoInverse();
    MatrixXd& all = this->gradients[index];
    all.resize(size, 3);
    all.bottomRows(size - 1) = others;
    all.row(0) = -others.colwise().sum();
    this->measure[c] = size == 3
                         ? jacobian.col(0).head<3>().cross(jacobian.col(1).head<3>()).norm() / 2
                         : std::abs(jacobian.determinant()) / 6;
  }
}

} // namespace smg::testing
