// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace smg::testing
{

/** The positions of a mesh, one row a vertex. */
Eigen::MatrixXd pointsOf(const StreamMesh& mesh);

/** Area or volume of the cells, lumped at the vertices, for the mesh with these positions. */
Eigen::VectorXd lumpedMass(const StreamMesh& mesh, const Eigen::MatrixXd& points);

/** The stiffness of linear finite elements with K = 1, from the inverses of the Jacobians. */
Eigen::SparseMatrix<double> stiffness(const StreamMesh& mesh, const Eigen::MatrixXd& points);

/** The volume that triangles with these positions enclose. */
double enclosedVolume(const StreamMesh& mesh, const Eigen::MatrixXd& points);

/** Solves (M + t L) y = M x directly; y = x at the vertices that are held (1). */
Eigen::MatrixXd smoothDirectly(const Eigen::VectorXd& mass, const Eigen::SparseMatrix<double>& L,
  double t, const Eigen::MatrixXd& x, const std::vector<std::uint8_t>& held);

} // namespace smg::testing
