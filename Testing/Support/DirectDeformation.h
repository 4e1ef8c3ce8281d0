// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/Deform.h"
#include "smg/Problem.h"

#include <Eigen/Core>

#include <vector>

namespace smg::testing
{

/** The deformation of Deform.h by two direct solves, in an independent implementation. */
struct DirectDeformation
{
  Eigen::MatrixXd fields;    ///< vertices x 4: the rotation vector and the logarithm of the scale
  Eigen::MatrixXd positions; ///< vertices x 3

  /** s R at the vertex. */
  Eigen::Matrix3d transformOf(Eigen::Index vertex) const;
};

/** Deforms directly. Requires a held vertex and fewer than 2^31 vertices. */
DirectDeformation deformDirectly(
  const StreamMesh& mesh, Handles& handles, Weights weights = Weights::Clamped);

/** The largest distance between rows of `a` and `b`, divided by the diagonal of the bounds of the
 * mesh. */
double deformationError(const StreamMesh& mesh, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/**
 * A measure of detail preservation: for every free vertex the angle in degrees between its
 * Laplacian vector (L p)_i, transformed by s_i R_i of the direct solution, and (L x)_i of the
 * deformed mesh, with the Laplacian L of the mesh at rest. In ascending order, without vertices
 * whose vectors are zero.
 */
std::vector<double> detailAngles(const StreamMesh& mesh, const VertexHandles& handles,
  const DirectDeformation& direct, const Eigen::MatrixXd& positions, Weights weights);

} // namespace smg::testing
