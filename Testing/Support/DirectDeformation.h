// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Testing/Support/StreamMesh.h"
#include "smg/Handles.h"
#include "smg/Problem.h"

#include <Eigen/Core>

#include <vector>

namespace smg::testing
{

/** The deformation that Deform.h describes, by two direct solves and by other code than its own. */
struct DirectDeformation
{
  Eigen::MatrixXd fields;    ///< vertices x 4: the rotation vector and the logarithm of the scale
  Eigen::MatrixXd positions; ///< vertices x 3

  /** s R of the vertex. */
  Eigen::Matrix3d transformOf(Eigen::Index vertex) const;
};

/** Deforms directly. Needs a held vertex and below 2^31 vertices. */
DirectDeformation deformDirectly(
  const StreamMesh& mesh, Handles& handles, Weights weights = Weights::Clamped);

/** The largest distance between rows of `a` and `b`, divided by the diagonal of mesh's bounds. */
double deformationError(const StreamMesh& mesh, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/**
 * How well a deformation keeps details, L the Laplacian of the mesh at rest: of every free vertex
 * the angle in degrees between its Laplacian vector (L p)_i, transported by the direct solution's
 * s_i R_i, and the deformed mesh's (L x)_i. Ascending; without the vertices whose vectors are zero.
 */
std::vector<double> detailAngles(const StreamMesh& mesh, const VertexHandles& handles,
  const DirectDeformation& direct, const Eigen::MatrixXd& positions, Weights weights);

} // namespace smg::testing
